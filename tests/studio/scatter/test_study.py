"""A study gives the same numbers however it is run, loses nothing, and says what is wrong."""

import csv
import json
import math
import subprocess
import sys

import needed
import numpy as np
import pytest
from stand_ins import NORMAL, Swing, linear, never, picky
from stopping import Stop, stopping_after

from thrustwasher import ParameterError, SolveError, propagate
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.studio.scatter.design import Design, make_design
from thrustwasher.studio.scatter.evaluation import Runs
from thrustwasher.studio.scatter.propagate import JOURNAL, study_of
from thrustwasher.studio.scatter.target import target_of


def result_of(target, **more):
    study, warnings = study_of(target_of(target, target.scatter), **more)
    numbers, codes = study.run(None, workers=1)
    return Runs(study, numbers, codes).result(reached="below", seed=1, warnings=warnings)


def same(a, b):
    """Tell if two results are equal to the bit."""
    one, other = ({**r.as_dict(), "wall_time": 0.0} for r in (a, b))
    return json.dumps(one) == json.dumps(other) and all(
        np.array_equal(a.sample[name], b.sample[name], equal_nan=name != "status")
        for name in a.sample
        if name != "status"
    )


# The design


def test_base_points_are_the_same_with_and_without_indices():
    with_groups, without = make_design(64, 3, [(0,), (1, 2)], 7), make_design(64, 3, [], 7)
    assert np.array_equal(with_groups.a, without.a)
    assert (with_groups.n_rows, without.n_rows) == (256, 64)


def test_rows_are_a_b_and_exchanges_of_each_base_point_in_turn():
    a, b = np.full((8, 3), 0.25), np.full((8, 3), 0.75)
    design = Design(a=a, b=b, groups=((0,), (1, 2)))
    rows = np.concatenate([u for _, u in design.batches()])
    assert rows[:4].tolist() == [[0.25] * 3, [0.75] * 3, [0.75, 0.25, 0.25], [0.25, 0.75, 0.75]]
    assert len(rows) == 32 and np.array_equal(rows[4:8], rows[:4])


def test_batches_are_whole_base_points_and_cover_all_rows():
    design = make_design(256, 5, [(i,) for i in range(5)], 1)
    firsts, parts = zip(*design.batches(), strict=True)
    assert {len(part) % 7 for part in parts} == {0}
    assert list(firsts) == np.cumsum([0, *map(len, parts)])[:-1].tolist()
    assert sum(map(len, parts)) == design.n_rows


def test_scrambles_are_independent_and_each_is_even():
    points = make_design(1024, 2, [], 1).a.reshape(8, 128, 2)
    for own in points:
        assert np.bincount((own[:, 0] * 128).astype(int), minlength=128).tolist() == [1] * 128
    assert len({own[0, 0] for own in points}) == 8
    assert (points > 0.0).all() and (points < 1.0).all()


def test_the_seed_decides_the_numbers():
    runs = [propagate(linear, scatter=NORMAL, runs=16, seed=s, workers=1) for s in (1, 1, 2)]
    assert same(runs[0], runs[1]) and not same(runs[0], runs[2])


# Workers, stops


def test_two_workers_give_the_numbers_of_one():
    one, two = (propagate(linear, scatter=NORMAL, runs=128, workers=n) for n in (1, 2))
    assert same(one, two)


def test_a_stopped_study_goes_on_and_ends_as_if_never_stopped(tmp_path):
    table = {**NORMAL, "correlation": [["a", "b", 0.5]]}
    whole = propagate(linear, scatter=table, runs=128, out=tmp_path / "whole", workers=1)
    out, seen = tmp_path / "stopped", []
    with pytest.raises(Stop):
        propagate(linear, scatter=table, runs=128, out=out, progress=stopping_after(200))
    assert [p.name for p in out.iterdir()] == [JOURNAL]
    again = propagate(
        linear, scatter=table, runs=128, out=out, progress=lambda done, _: seen.append(done)
    )
    assert seen[0] >= 200 and seen[-1] == 128 * 4
    assert same(whole, again)
    for name in ("sample.csv", "figures.csv"):
        assert (out / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert not (out / JOURNAL).exists()


def test_what_fails_while_files_are_written_loses_no_run(tmp_path):
    usual = {"scatter": NORMAL, "runs": 32, "out": tmp_path, "workers": 1}
    (tmp_path / "figures.csv").mkdir()
    with pytest.raises(ParameterError, match=r"figures\.csv: is a folder, and a file of this name"):
        propagate(linear, **usual)
    assert [p.name for p in tmp_path.iterdir() if p.name != JOURNAL] == ["figures.csv"]
    assert (tmp_path / JOURNAL).exists()
    (tmp_path / "figures.csv").rmdir()

    def finish(result):
        assert (tmp_path / "figures.csv").exists() and (tmp_path / JOURNAL).exists()
        raise Stop

    seen = []
    usual["progress"] = lambda done, _: seen.append(done)
    with pytest.raises(Stop):
        propagate(linear, **usual, finish=finish)
    propagate(linear, **usual)
    assert seen == [32 * 5, 32 * 5]
    assert not (tmp_path / JOURNAL).exists()


KILLED = """
import os, signal, sys
from thrustwasher import propagate
finish = lambda _: os.kill(os.getpid(), signal.SIGTERM)
signal.signal(signal.SIGTERM, signal.SIG_DFL)
propagate("gearmesh", runs=8, workers=1, out=sys.argv[1], finish=finish)
"""


@pytest.mark.slow
def test_a_process_that_is_killed_while_files_are_written_loses_no_run(tmp_path):
    assert subprocess.run([sys.executable, "-c", KILLED, tmp_path]).returncode != 0
    seen = []
    propagate(
        "gearmesh", runs=8, out=tmp_path, progress=lambda done, total: seen.append((done, total))
    )
    assert len(seen) == 1 and seen[0][0] == seen[0][1]


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"runs": 64}, "runs"),
        ({"seed": 2}, "seed"),
        ({"indices": False}, "indices"),
        ({"scatter": {**NORMAL, "a": {"normal": 3.1}}}, "scatter"),
        ({"outputs": ["sum"]}, "figures"),
    ],
)
def test_the_journal_of_another_study_is_refused_and_stays(tmp_path, changed, says):
    usual = {"scatter": NORMAL, "runs": 32, "out": tmp_path, "workers": 1}
    with pytest.raises(Stop):
        propagate(linear, **usual, progress=stopping_after(60))
    before = (tmp_path / JOURNAL).read_bytes()
    with pytest.raises(ParameterError, match=rf"another scatter \(other .*{says}"):
        propagate(linear, **{**usual, **changed})
    assert (tmp_path / JOURNAL).read_bytes() == before


@pytest.mark.slow
def test_a_cluster_gives_the_numbers_of_one_process():
    distributed = needed.package("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None
    ) as cluster:
        found = propagate("gearmesh", runs=16, cluster=cluster.scheduler_address)
    assert same(found, propagate("gearmesh", runs=16, workers=1))


def test_a_function_within_another_is_studied_here_but_not_sent():
    def local(a=10.0):
        return a

    assert propagate(local, scatter={"a": "1 %"}, runs=8).runs == 8
    with pytest.raises(ParameterError, match=r"cannot be sent to other processes"):
        propagate(local, scatter={"a": "1 %"}, runs=8, workers=2)


# Failures


def test_failed_runs_are_counted_named_and_widen_what_they_may(tmp_path):
    sound = propagate(linear, scatter=NORMAL, runs=256, workers=1)
    result = propagate(picky, scatter=NORMAL, runs=256, workers=1)
    band = result.figures["value"]
    n = result.sample["status"].count("no solution")
    assert 30 < n < 50 and result.failed == {"no solution": result.as_dict()["failed"]}
    assert band.confidence[0.95][1] == math.inf and band.confidence[0.05][0] == -math.inf
    assert result.as_dict()["figures"]["value"]["confidence"]["0.95"][1] is None
    result.write(tmp_path)
    with (tmp_path / "figures.csv").open(newline="") as stream:
        (row,) = csv.DictReader(stream)
    assert row["0.05 low"] == row["0.95 high"] == "" and float(row["0.5 low"])
    usual = sound.figures["sum"].confidence[0.5]
    assert band.confidence[0.5][1] - band.confidence[0.5][0] > usual[1] - usual[0] + 0.5
    assert band.left_out > n and any(f"leave out {band.left_out} of" in w for w in result.warnings)


def test_if_all_runs_fail_the_reason_is_told_and_the_sample_stays(tmp_path):
    with pytest.raises(SolveError, match=r"none of the 16 base runs .* mostly: no solution"):
        propagate(
            lambda a: never(a) if a != 10.0 else 0.0,
            scatter={"a": {"normal": 1.0, "nominal": 10.0}},
            runs=16,
            out=tmp_path,
        )
    assert not (tmp_path / JOURNAL).exists()
    lines = (tmp_path / "sample.csv").read_text().splitlines()
    assert len(lines) == 17 and lines[0] == "a,value,status" and lines[1].endswith(",,no solution")


def test_a_figure_that_some_runs_lack_is_told():
    result = result_of(Swing(), runs=128)
    lasting = result.figures["lasting"]
    assert 10 < lasting.absent < 30 and lasting.confidence[0.05][0] == -math.inf
    assert f"{lasting.absent} of 128 base runs have no lasting" in " ".join(result.warnings)
    assert result.failed == {} and result.figures["peak"].absent == 0


# What a target may have next to figures


def test_costly_figures_have_bands_at_once_and_indices_on_request():
    usual, whole = (result_of(Swing(), runs=256, indices=i) for i in (True, "all"))
    assert usual.figures["dear"].indices == {} and usual.solves == 256 * 4
    assert usual.figures["dear"].quantiles == whole.figures["dear"].quantiles
    assert whole.solves == 256 * 5
    assert whole.figures["dear"].indices["d"].total == pytest.approx(0.5, abs=0.1)
    assert usual.figures["peak"].indices["d"].total == 0.0


def test_a_signal_has_bands_and_indices_over_time():
    series = result_of(Swing(), runs=512).series["signal"]
    assert series.nominal == pytest.approx(20.0 + 10.0 * np.sin(series.time))
    assert series.quantiles[0.5] == pytest.approx(series.nominal, abs=0.3)
    assert series.indices["a"][0] == 0.0 and series.indices["b"][0] == pytest.approx(1.0, abs=0.1)
    assert series.indices["a"][2] == pytest.approx(0.2, abs=0.05)


def test_a_figure_beyond_its_usual_range_has_a_probability():
    result = result_of(Swing(), runs=1024)
    outside, high = result.figures["peak"].outside, result.probabilities["high"]
    assert {type(x) for p in result.probabilities.values() for x in (p.low, p.high)} == {float}
    assert high.low < 0.0899 < high.high and outside.value > high.value
    assert result.figures["dear"].outside is None and result.figures["peak"].error == 0.01


def test_the_nearest_run_to_a_quantile_is_one_of_the_sample():
    result = result_of(Swing(), runs=128)
    near = result.nearest["peak"][0.95]
    assert near["a"] + near["b"] == pytest.approx(result.figures["peak"].quantiles[0.95], abs=0.5)
    assert near["a"] in result.sample["a"]


# What leaves


def test_json_has_the_keys_of_the_contract_and_no_nan():
    record = result_of(Swing(limit=23.0), runs=64).as_dict()
    json.dumps(record, allow_nan=False)
    assert {"runs", "solves", "failed", "reached", "figures", "probabilities"} < record.keys()
    peak = record["figures"]["peak"]
    assert list(peak["quantiles"]) == list(peak["confidence"]) == ["0.05", "0.5", "0.95"]
    assert {"nominal", "mean", "standard_deviation"} < peak.keys()
    assert {"first", "total", "confidence"} < peak["indices"]["a"].keys()
    assert isinstance(record["probabilities"]["high"], float) and record["failed"] > 0
    assert record["runs"] == 64 and record["solves"] == 64 * 4


def test_tables_have_units_and_all_base_runs(tmp_path):
    result_of(Swing(), runs=64).write(tmp_path)
    sample, figures, series = (
        (tmp_path / f"{n}.csv").read_text().splitlines() for n in ("sample", "figures", "series")
    )
    assert sample[0] == "a,b,d,peak [N m],lasting [s],dear,high,status" and len(sample) == 65
    assert len(figures) == 4 and figures[1].startswith("peak,N m,30.0,")
    assert series[0].startswith("time [s],signal nominal,signal 0.05,") and len(series) == 6


def test_a_data_frame_needs_pandas(monkeypatch):
    result = result_of(Swing(), runs=8)
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(EnvironmentProblem, match="pip install pandas"):
        result.frame()


# Wrong input


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ({"runs": 7}, r"runs = 7, allowed: a whole number 8 \.\. 131072"),
        ({"runs": 10**9}, r"runs = 1000000000, allowed"),
        ({"runs": 64.5}, r"runs = 64\.5, allowed"),
        ({"seed": -1}, r"seed = -1, allowed"),
        ({"indices": "some"}, r"indices = 'some', allowed"),
        ({"reached": "left"}, r"reached = 'left', allowed: below or above"),
        ({"workers": 0}, r"workers = 0, allowed"),
        ({"workers": 2, "cluster": "tcp://x:1"}, r"workers and cluster: allowed: one"),
        ({"outputs": ["sun"]}, r"outputs: 'sun', allowed: sum"),
        ({"at": {"load": 1.0}}, r"at: is of a part's inputs"),
        ({"scatter": {}}, r"nothing scatters"),
        ({"scatter": {"a": {"normal": -1.0}}}, r"a: .*standard deviation above 0"),
        ({"scatter": {**NORMAL, "correlation": [["a", "b", 0.9], ["b", "c", 0.9]]}}, "definite"),
        ({"scatter": {"z": {"normal": 1.0}}}, r"z: nominal is missing"),
    ],
)
def test_wrong_input_is_one_line_that_says_what_is_allowed(more, says):
    with pytest.raises(ParameterError, match=says) as caught:
        propagate(linear, **{"scatter": NORMAL, "runs": 8, **more})
    assert "\n" not in str(caught.value)


def test_an_unknown_target_gets_its_neighbour():
    with pytest.raises(ParameterError, match=r"did you mean 'planetary'"):
        propagate("planetry")


def test_out_must_be_a_folder(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(ParameterError, match=r"is a file, a folder is required"):
        propagate(linear, scatter=NORMAL, runs=8, out=tmp_path / "file")
    with pytest.raises(ParameterError, match=r"out = '': the name of a folder is required"):
        propagate(linear, scatter=NORMAL, runs=8, out="")


def test_runs_are_rounded_up_and_that_is_told():
    result = propagate(linear, scatter=NORMAL, runs=100, indices=False, workers=1)
    assert result.runs == 128 and "runs = 100: rounded up to 128" in result.warnings[0]


def test_results_that_no_memory_holds_are_refused(monkeypatch):
    monkeypatch.setattr("thrustwasher.studio.scatter.study.MOST_NUMBERS", 1000)
    with pytest.raises(ParameterError, match=r"runs = 1024: .* fewer runs"):
        propagate(linear, scatter=NORMAL)


def test_a_function_that_returns_words_is_refused():
    with pytest.raises(ParameterError, match="no number"):
        propagate(lambda a: "much", scatter={"a": {"normal": 1.0, "nominal": 2.0}})


def test_a_choice_scatters_too():
    result = propagate(
        lambda law, x=1.0: x * {"thick": 2.0, "thin": 1.0}[law],
        scatter={"law": {"either": ["thick", "thin"], "weights": [3.0, 1.0]}, "x": "1 %"},
        runs=64,
    )
    assert result.sample["law"].count("thin") == 16
    assert result.figures["value"].indices["law"].total > 0.9
