"""The charts and the page of where methods fail: made from the record alone."""

import json
import os
import random
import shlex
import subprocess
import sys
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

import chart_records
import pytest
from chart_records import MACHINE, QUANTITY, cell, group, sample

from lab.benchmarks.charts import disagreements
from lab.chart import main
from lab.charts.chart_cost import count_figure
from lab.charts.chart_page import command_lines, same_everywhere, stability_markdown
from lab.charts.chart_series import cases_of
from lab.charts.chart_text import beats, front
from lab.charts.work_precision import CHARTS, Sample
from lab.macro_steps import WAYS
from thrustwasher import cli
from thrustwasher.errors import ParameterError
from thrustwasher.model.registry import models_with_error_tables, spec_of

ROOT = Path(__file__).parents[2]


def run_of(way, step, error, **other):
    return sample(
        f"{way}, {step:g} ms",
        1.0 / step,
        error,
        family=way,
        value=f"{step:g} ms",
        n_cases=1,
        **other,
    )


STUDY = {
    "scene": "a shift",
    "quantities": [QUANTITY],
    "truth": {},
    "samples": [
        *(run_of("second order", h, 1e-2 * h * h) for h in (2.0, 1.0, 0.5)),
        *(
            run_of("chattering", h, 0.1, n_failed=1, failures={"shift": f"turns {h:g}0 times"})
            for h in (2.0, 1.0)
        ),
        run_of("not at all", 1.0, None, n_failed=1, failures={"shift": "does not lock"}),
    ],
}
GROUP = group(
    [cell(), cell("says", words="SINGULAR: no way")],
    [cell("LIES", "-20 %", "load off"), cell("slow", "9 sweeps")],
    hazards=("a", "b"),
    methods=("good", "bad"),
)
LIMIT = {"loop": "held", "formula": "H < 2 J/c", "predicted": 2.0, "measured": 2.002}
STABILITY = {
    "stability": [GROUP],
    "limits": [{**LIMIT, "deviation": 1e-3}],
    "machine": {**MACHINE, "load": 0.1},
    "package": {"version": "0", "commit": "abc", "dirty": False},
    "date": "today",
}
CORRECTION = {
    "part": "clutch: counted once",
    "figure": "friction",
    "unit": "1",
    "before": 0.1,
    "after": 0.05,
    "recorded": True,
}


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    lost = {"n_failed": 1, "failures": {"b": "OUTSIDE_VERIFIED"}}
    none = {"n_failed": 2, "failures": {"a < b": "SINGULAR", "b": "SINGULAR"}}
    samples = [
        sample("closed", 1e-6, 0.5),
        sample("field", 2e-4, 2e-3),
        sample("map", 2e-6, 1e-4, setup_s=0.2, build_s=1.0, **lost),
        sample("exact", 1e-3, 0.0),
        sample("old", None, None, family="2006", is_rival=True, **none),
    ]
    more = {"macro_steps": STUDY, "corrections": [CORRECTION]}
    path = tmp_path_factory.mktemp("chart") / "in.json"
    path.write_text(json.dumps(chart_records.record("washer", samples, [GROUP], **more)), "utf-8")
    return path


@pytest.fixture(scope="module")
def drawn(record):
    out = record.parent / "out"
    assert main(["--draw", str(record), "--out", str(out)]) == 0
    return out


def test_page_markdown_drawings_and_record_are_written(drawn, record):
    drawings = ("washer", "washer-count", "shift", "corrections")
    wanted = {"chart.json", "chart.html", "chart.md", *(f"chart-{d}.svg" for d in drawings)}
    assert {p.name for p in drawn.iterdir()} == wanted
    kept = json.loads((drawn / "chart.json").read_text())
    assert kept.pop("check") and kept == json.loads(record.read_text())
    for svg in drawn.glob("*.svg"):
        ET.parse(svg)


def test_who_won_what_failed_and_what_set_up_costs_is_said(drawn):
    text = (drawn / "chart.md").read_text()
    assert "nothing beats closed (1 µs, worst 50 %), map (2 µs, worst 0.01 %)" in text
    assert "old fails in 2 of 2 cases (a < b: SINGULAR; b: SINGULAR)." in text
    assert "| map | 1 s | 200 ms | 2 µs | 6056 |" in text  # (1.2 - 0.001)/(2e-4 - 2e-6)
    assert "| clutch: counted once | friction | 1 | 0.1* | 0.05 | 0.5 |" in text
    assert "sources changed since" in text


def test_orders_and_what_goes_wrong_without_a_word_are_said(drawn):
    text = (drawn / "chart.md").read_text()
    assert "second order: order friction_torque 2.0." in text
    assert "chattering: wrong in 2 of 2 (turns many times)." in text
    assert "not at all: wrong in 1 of 1 (does not lock)." in text
    assert "1 of 4 results are silently wrong" in text
    assert "| bad | a | LIES | -20 % | load off |" in text


def test_failures_are_drawn_not_dropped(drawn):
    svg = (drawn / "chart-washer.svg").read_text()
    assert "map: 1 of 2 fail" in svg and "old: 2 of 2 fail" in svg


def test_samples_of_one_cost_have_an_axis_that_is_wide_enough(record):
    survey = json.loads(record.read_text("utf-8"))["models"]["washer"]
    assert {s["count"] for s in survey["samples"]} == {3.0}
    (axes,) = count_figure("washer", survey).axes
    low, high = axes.get_xlim()
    assert low < 2.0 and 4.0 < high


def test_html_is_escaped_and_needs_nothing_else(drawn):
    page = (drawn / "chart.html").read_text()
    assert "a &lt; b" in page and "a < b (" not in page
    assert "http://" not in page.replace("http://www.w3.org", "")


def test_a_foreign_file_is_refused(tmp_path, capsys):
    other = tmp_path / "other.json"
    other.write_text('{"schema": 99}')
    assert main(["--draw", str(other), "--out", str(tmp_path)]) == 2
    assert "no chart.json" in capsys.readouterr().err


def test_cells_legend_limits_and_machine_are_there():
    page = stability_markdown(STABILITY)
    assert "- good: reported SINGULAR (b).\n" in page
    assert "- bad: **wrong** -20 % (a); slow 9 sweeps (b).\n" in page
    assert "1 of 4 results are silently wrong." in page
    assert "The 1 limits" in page and "by at most 0.1 %" in page
    assert "a cpu" in page and "commit abc" in page


def test_where_methods_fail_is_the_same_page_for_everyone(tmp_path):
    page = tmp_path / "page.md"
    assert main(["--only", "stability", "--out", str(page)]) == 0
    assert page.read_text("utf-8") == (ROOT / "docs" / "stability.md").read_text("utf-8")
    record = same_everywhere()
    verdicts = [c["verdict"] for g in record["stability"] for row in g["cells"] for c in row]
    assert {"ok", "LIES"} <= set(verdicts)
    assert all(abs(one["deviation"]) < 0.02 for one in record["limits"])


@pytest.mark.slow
def test_a_quick_run_measures_everything_and_draws_it(tmp_path):
    words = [sys.executable, "-m", "lab.benchmarks.chart_2006", "--quick", "--out", str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=1200, env=os.environ)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "" and "wrote" in done.stderr
    record = json.loads((tmp_path / "chart.json").read_text("utf-8"))
    assert set(record["models"]) == {"washer", "clutch", "gearmesh"}
    for survey in (*record["models"].values(), record["macro_steps"]):
        for one in survey["samples"]:
            assert set(one) == set(Sample.__dataclass_fields__)
    assert record["machine"]["threads"]["OMP_NUM_THREADS"] == "1"
    washer = {s["label"]: s for s in record["models"]["washer"]["samples"]}
    rival = washer["2006, 9 x 67, 0.0001"]
    for name, share in (("friction_torque", 0.05), ("temperature", 0.3)):
        assert washer["field"]["errors"][name]["worst"] < share * rival["errors"][name]["worst"]
    assert washer["field"]["n_failed"] == 0
    names = {p.name for p in tmp_path.iterdir()}
    assert {
        "chart.html",
        "chart.md",
        "chart-washer.svg",
        "chart-shift.svg",
        "chart-clutch.svg",
    } <= names


# The command behind each mark of the charts is one that runs, and solves the worst case.


def marks():
    """Yield model, study and sample of every mark that a chart can have, in every case."""
    for model in models_with_error_tables():
        cases = [vars(case) for case in cases_of(model)]
        for one in CHARTS[model].series(spec_of(model)):
            sample = {**vars(one), "errors": {}}
            for case in cases:
                yield model, {"cases": cases}, sample, case["name"]
    for way in WAYS:
        sample = {
            "family": way.name,
            "label": f"{way.name}, 2 ms",
            "knob": "macro step",
            "value": "2 ms",
            "is_rival": False,
        }
        yield "shift", {"scene": "a shift"}, sample, "shift"


def parsed(line):
    """Return what the command's own parser reads of a line; ParameterError if it refuses."""
    program, name, *words = shlex.split(line.removeprefix("command: "))
    assert program == "thrustwasher"
    parser, command = cli._Parser(name), cli._command(name)
    command.add_arguments(parser)
    return name, parser.parse_args(words)


@cache
def lines_of_marks():
    return {
        (model, tuple(command_lines(study, model, sample, worst)))
        for model, study, sample, worst in marks()
    }


def test_each_command_of_a_chart_is_understood():
    found = set()
    for model, (line, *_) in lines_of_marks():
        if line.startswith("command: "):
            name, arguments = parsed(line)
            found.add(name)
            if name == "shift":
                assert arguments.step and arguments.master and len(arguments.fidelity) == 2
        else:
            assert model == "shift" and "in [transmission]" in line  # a coupling has no option
    assert found == {"washer", "engage", "gearmesh", "shift"}
    with pytest.raises(ParameterError):
        parsed("command: thrustwasher gearmesh --load 40")


WASHER = "washer --load 700 --speed 545 --tilt 0.002 --oil-temperature 297.15 --branch contact"
MESH = "gearmesh --power 21600 --speed 180 --oil-temperature 299.85"
PACK = "engage --load 12000 --speed 350 --oil-temperature 297.15 --ramp 0.1 --duration 0.6"


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        (f"{MESH} --fidelity fine", "speed", 180.0),
        (f"{WASHER} --fidelity map", "branch", "contact"),
        (f"{WASHER} --grid 7x20", "branch", "contact"),
        (f'{PACK} --fidelity field --step "20 ms"', "duration", 0.6),
    ],
)
def test_a_command_solves_its_case(words, name, value, capsys):
    assert f"command: thrustwasher {words}" in {lines[0] for _, lines in lines_of_marks()}
    assert cli.main([*shlex.split(words), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[name] == value


# Who is on the front: ties, the reference's uncertainty, failures, and a second run.


def pareto_sample(label, cost, error, *, spread=0.0, floor=1e-6, failed=0):
    return {
        "label": label,
        "call_median": cost,
        "call_iqr": spread,
        "errors": {"torque": {"worst": error, "rms": None if error is None else 0.5 * error}},
        "ref_uncertainty": {"torque": floor},
        "n_failed": failed,
    }


def labels(samples):
    return [samples[i]["label"] for i in front(samples, "torque")]


def test_dearer_and_coarser_is_beaten():
    samples = [
        pareto_sample("a", 1.0, 1e-2),
        pareto_sample("b", 2.0, 1e-3),
        pareto_sample("c", 3.0, 2e-3),
    ]
    assert labels(samples) == ["a", "b"]


def test_faster_by_less_than_both_spreads_beats_nothing():
    quick, slow = (
        pareto_sample("a", 1.0, 1e-3, spread=0.06),
        pareto_sample("b", 1.1, 1e-3, spread=0.06),
    )
    assert not beats(quick, slow, "torque")
    assert labels([quick, slow]) == ["a", "b"]
    assert beats(pareto_sample("a", 1.0, 1e-3, spread=0.04), slow | {"call_iqr": 0.04}, "torque")


def test_errors_below_the_references_uncertainty_are_equal():
    samples = [pareto_sample("a", 1.0, 9e-5, floor=1e-4), pareto_sample("b", 2.0, 1e-5, floor=1e-4)]
    assert labels(samples) == ["a"]


def test_who_fails_beats_nobody_who_does_not():
    samples = [
        pareto_sample("a", 1.0, 1e-5, failed=1),
        pareto_sample("b", 2.0, 1e-2),
        pareto_sample("c", 3.0, 1e-3),
    ]
    assert labels(samples) == ["a", "b", "c"]
    assert beats(samples[0], pareto_sample("d", 9.0, 1e-2, failed=2), "torque")


def test_who_never_fails_but_errs_more_does_not_beat_a_map_with_an_edge():
    assert (
        labels([pareto_sample("closed", 1.0, 0.5), pareto_sample("map", 2.0, 1e-4, failed=1)])[-1]
        == "map"
    )


def test_what_has_no_answer_is_on_no_front():
    assert labels([pareto_sample("a", 1.0, None), pareto_sample("b", 2.0, 1e-2)]) == ["b"]


@pytest.fixture
def measured():
    """Return a function that measures the same twelve ways with noise of a clock."""
    source = random.Random(3)
    ways = [(10.0 ** source.uniform(-6, -2), 10.0 ** source.uniform(-5, -1)) for _ in range(12)]

    def once(seed):
        noise = random.Random(seed)
        return [
            pareto_sample(
                f"way {i}", cost * (1.0 + noise.uniform(-0.02, 0.02)), error, spread=0.02 * cost
            )
            for i, (cost, error) in enumerate(ways)
        ]

    return once


def test_two_runs_agree_on_every_member_outside_the_spread(measured):
    for seed in range(20):
        assert disagreements(measured(seed), measured(100 + seed), "torque") == []


def test_a_way_on_one_front_alone_is_a_disagreement(measured):
    one, two = measured(0), measured(1)
    assert disagreements([*one, pareto_sample("new", 1e-9, 1e-9)], two, "torque")


def test_a_tie_that_falls_the_other_way_is_none():
    one = [pareto_sample("a", 1.00, 1e-3, spread=0.05), pareto_sample("b", 1.09, 1e-3, spread=0.05)]
    two = [pareto_sample("a", 1.00, 1e-3, spread=0.05), pareto_sample("b", 1.12, 1e-3, spread=0.05)]
    assert labels(one) != labels(two)
    assert disagreements(one, two, "torque") == []
