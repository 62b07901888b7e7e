"""``thrustwasher scatter``: one object or a table, files, and one line for what is wrong."""

import csv
import json
import signal

import pytest
from children import started, stopped

from thrustwasher import load_part
from thrustwasher.cli import main
from thrustwasher.studio.scatter.propagate import JOURNAL

PART = """
model = "gearmesh"
name = "Mine"

[box]
load = "12 N.m"

[scatter]
load = "5 %"
oil_temperature = "4 K"
"""


@pytest.fixture
def part(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(PART)
    return path


def said(capsys, *words):
    """Return status, standard output and error of the command."""
    status = main(["scatter", *map(str, words)])
    return status, *capsys.readouterr()


@pytest.mark.slow
def test_json_is_the_object_that_the_contract_has(part, tmp_path, capsys):
    words = part, "--runs", "64", "--seed", "3", "--json", "--out", tmp_path / "out"
    status, out, err = said(capsys, *words)
    record = json.loads(out)
    assert status == 0 and "Traceback" not in err
    assert (record["runs"], record["solves"], record["failed"]) == (64, 64 * 4, 0)
    (warning,) = record["warnings"]
    assert record["reached"] == "below" and "gradient is more than 20 % off" in warning
    torque = record["figures"]["friction_torque"]
    assert list(torque["quantiles"]) == ["0.05", "0.5", "0.95"]
    for level, value in torque["quantiles"].items():
        low, high = torque["confidence"][level]
        assert low <= value <= high
    assert {"nominal", "mean", "standard_deviation"} <= torque.keys()
    assert torque["linear_deviation"] == pytest.approx(torque["standard_deviation"], rel=0.2)
    assert torque["indices"].keys() == {"load", "oil_temperature"}
    assert {"first", "total", "confidence"} <= torque["indices"]["load"].keys()
    assert all(isinstance(p, float) for p in record["probabilities"].values())


@pytest.mark.slow
def test_the_washers_film_is_lost_with_a_probability(tmp_path, capsys):
    words = "washer", "--runs", "16", "--no-indices", "--json", "--out", tmp_path / "out"
    status, out, _ = said(capsys, *words)
    record = json.loads(out)
    assert status == 0 and 0.0 <= record["probabilities"]["film_lost"] <= 1.0
    assert record["solves"] == 16 and record["figures"]["film_ratio"]["indices"] == {}


@pytest.mark.slow
def test_the_folder_has_page_tables_and_the_nearest_runs_as_parts(part, tmp_path, capsys):
    folder = tmp_path / "new" / "out"
    status, out, err = said(capsys, part, "--runs", "64", "--files", "--out", folder)
    assert status == 0 and "friction_torque" in out and f"Report: {folder}" in out
    assert "scatter: 256 runs" in err
    with (folder / "sample.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 64 and {row["status"] for row in rows} == {"OK"}
    assert "<html" in (folder / "scatter.html").read_text("utf-8")[:200]
    near = load_part(folder / "friction_torque-95.toml")
    assert near.solve().friction_torque == pytest.approx(
        float(
            next(r for r in rows if float(r["load [N.m]"]) == near.starts["load"])[
                "friction_torque [N.m]"
            ]
        )
    )
    assert not (folder / JOURNAL).exists()


@pytest.mark.slow
def test_an_earlier_study_leaves_no_files_among_the_new_and_the_users_stay(part, tmp_path, capsys):
    folder = tmp_path / "out"
    words = "--runs", "8", "--no-indices", "--files", "--out", folder
    assert said(capsys, part, *words)[0] == 0
    earlier = folder / "friction_torque-95.toml"
    own = {"mine-95.toml": earlier.read_text(), "friction_torque-5.toml": "x", "series.csv": "x"}
    for name, text in own.items():
        (folder / name).write_text(text)
    (folder / "sub-50.toml").mkdir()
    assert said(capsys, part, *words, "--outputs", "friction_power")[0] == 0
    assert {p.name for p in folder.iterdir()} == {
        *own,
        *(f"friction_power-{level}.toml" for level in ("05", "50", "95")),
        *("scatter.html", "sample.csv", "figures.csv", "sub-50.toml"),
    }


@pytest.mark.slow
def test_a_target_that_its_own_study_would_replace_is_refused(part, tmp_path, capsys):
    folder = tmp_path / "out"
    words = "--runs", "8", "--no-indices", "--files", "--out", folder
    assert said(capsys, part, *words)[0] == 0
    status, _, err = said(capsys, folder / "friction_torque-95.toml", *words)
    assert status == 2 and "which the study would replace; choose another folder" in err


@pytest.mark.slow
def test_inputs_and_parameters_are_set_as_elsewhere(part, tmp_path, capsys):
    words = "--runs", "8", "--no-indices", "--json", "--out", tmp_path / "out"
    usual, set_ = (
        json.loads(said(capsys, part, *words, *more)[1])["figures"]["friction_torque"]["nominal"]
        for more in ((), ("--load", "24 N.m", "--set", "sigma_rms=1e-6"))
    )
    assert set_ > 1.5 * usual


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["nothing.toml"], "cannot be read"),
        (["gearmsh"], "did you mean 'gearmesh'"),
        *(
            (["gearmesh", "--runs", n], f"--runs {n}: allowed: a whole number 8 .. 131072")
            for n in ("many", "4", "-4", "8.5", "131073", "999999999", "1" * 21)
        ),
        *(
            (["gearmesh", "--seed", n], f"--seed {n}: allowed: a whole number 0 .. 4294967295")
            for n in ("-1", "4294967296", "1" * 21)
        ),
        (["gearmesh", "--reached", "above"], "--reached: has no effect with a gearmesh"),
        (["clutch", "--reached", "above"], "--reached: has no effect with a clutch"),
        (["planetary", "--reached", "above"], "--reached: has no effect with a scene"),
        (["washer", "--indices", "all"], "--indices: has no effect with a part"),
        (["gearmesh", "--indices", "all", "--no-indices"], "allowed: one of them"),
        (["gearmesh", "--load", "much"], "load"),
        (["gearmesh", "--out", ""], "--out '': the name of a folder is required"),
        (["gearmesh", "--outputs", "torqe"], "outputs: 'torqe'"),
        (["gearmesh", "--fidelity", "finest"], "finest"),
        (["gearmesh", "--tilt", "0.1"], "tilt"),
        (["gearmesh", "--workers", "2", "--cluster", "tcp://x:1"], "one of them"),
        (["planetary", "--load", "3"], "--load: has no effect with a scene"),
        (["planetary", "--preset", "paper"], "--preset: has no effect with a scene"),
    ],
)
def test_wrong_words_are_answered_in_one_line(words, says, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, err = said(capsys, *words)
    assert (status, out) == (2, "") and says in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("", "nothing scatters: add [scatter]"),
        ('[scatter]\nlod = "5 %"', "did you mean 'load'"),
        ('[scatter]\nload = "-5 %"', "above 0"),
        ("[scatter]\nload = { uniform = [3, 1] }", "low < high"),
    ],
)
def test_a_part_file_that_cannot_be_studied_is_told_why(line, says, tmp_path, capsys):
    path = tmp_path / "mine.toml"
    path.write_text(f'model = "gearmesh"\nname = "Mine"\n{line}\n')
    status, _, err = said(capsys, path, "--out", tmp_path / "out")
    assert status == 2 and says in err and err.count("\n") == 1


def test_a_folder_that_is_a_file_is_told(part, tmp_path, capsys):
    status, _, err = said(capsys, part, "--out", part)
    assert status == 2 and "is a file, a folder is required" in err


def test_a_study_without_any_solution_has_an_exit_status_of_its_own(part, tmp_path, capsys):
    path = tmp_path / "hot.toml"
    text = '[scatter]\nouter_radius = { uniform = ["3 mm", "4 mm"] }\n'
    path.write_text(f'model = "washer"\nname = "Hot"\n{text}')
    folder = tmp_path / "out"
    status, out, err = said(capsys, path, "--runs", "8", "--out", folder)
    assert (status, out) == (3, "") and "none of the 8 base runs has a solution, mostly: " in err
    assert len((folder / "sample.csv").read_text().splitlines()) == 9


@pytest.mark.slow
def test_a_page_that_cannot_be_written_loses_no_run(part, tmp_path, capsys):
    folder = tmp_path / "out"
    (folder / "scatter.html").mkdir(parents=True)
    words = part, "--runs", "8", "--no-indices", "--out", folder
    status, out, err = said(capsys, *words)
    assert f"{folder / 'scatter.html'}: is a folder, and a file of this name" in err
    assert (status, out) == (2, "") and f"{JOURNAL} keeps 8 of 8 runs; to go on: " in err
    (folder / "scatter.html").rmdir()
    status, _, err = said(capsys, *words)
    assert status == 0 and "scatter: 8 runs, 8 of them done before" in err
    assert not (folder / JOURNAL).exists()


@pytest.mark.slow
def test_a_stopped_command_goes_on_with_the_same_numbers(part, tmp_path):
    """Ctrl-C while it runs: one line, a journal, then the same tables as without."""
    words = ["scatter", part, "--runs", "2048"]
    stop = "thrustwasher.storage.journal.Journal.put", "len(calls) == 2", signal.SIGINT
    code, lines = stopped([*words, "--out", tmp_path / "out"], tmp_path, *stop)
    kept, last = lines[-2:]
    assert code == 130 and last == "thrustwasher scatter: stopped"
    assert f"{tmp_path / 'out' / JOURNAL} keeps " in kept and "of 8192 runs" in kept
    assert [p.name for p in (tmp_path / "out").iterdir()] == [JOURNAL]
    for folder in ("out", "whole"):
        done = started([*words, "--out", tmp_path / folder], tmp_path)
        said_of_it = done.communicate()[1]
        assert done.returncode == 0
        assert ("done before" in said_of_it) == (folder == "out")
    for name in ("sample.csv", "figures.csv"):
        one, other = ((tmp_path / f / name).read_bytes() for f in ("out", "whole"))
        assert one == other
