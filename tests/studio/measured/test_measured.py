"""Measured against computed: a data set made of the model agrees, a shifted one is fitted back."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binomtest

from thrustwasher import GearMeshParams, ParameterError, SolveError, solve_gearmesh
from thrustwasher.cli import main
from thrustwasher.studio.evaluators.make import gearbox
from thrustwasher.studio.measured.collection_page import collection_page
from thrustwasher.studio.measured.comparison import compare
from thrustwasher.studio.measured.data_set_file import load_data_set

TEXTS = ("title", "source", "measured", "conditions", "rights", "read", "reason")
HEAD = "power [kW], speed [rad/s], friction_torque, friction_torque_error, origin"
PART = """model = "gearmesh"
name = "Mine"
[parameters]
film_heat = "loss"
[scatter]
viscosity_scale = "10 %"
"""
POWERS = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0)


def data_set(tmp_path, lines, head=HEAD, extra='fit = ["viscosity_scale"]\n', **changed):
    texts = {key: f"{key} of it" for key in TEXTS} | changed
    text = "".join(f'{k} = "{x}"\n' for k, x in texts.items() if x)
    (tmp_path / "rig.toml").write_text(text + 'part = "part.toml"\n' + extra, "utf-8")
    (tmp_path / "part.toml").write_text(PART, "utf-8")
    (tmp_path / "points.csv").write_text("\n".join([head, *lines]), "utf-8")
    return tmp_path


def lines(thicker=1.0, error=0.02):
    usual = GearMeshParams().viscosity_scale
    params = GearMeshParams(film_heat="loss", viscosity_scale=thicker * usual)
    for kw in POWERS:
        found = solve_gearmesh(params, power=1e3 * kw, speed=180.0).friction_torque
        yield f"{kw}, 180, {found!r}, {error * found!r}, table"


def test_what_the_model_gave_has_no_deviation_and_is_inside(tmp_path):
    found = compare(load_data_set(data_set(tmp_path, lines())))
    assert np.abs(found.deviations).max() < 1e-12 and found.inside.all()
    told = found.to_dict()
    assert told["points"] == 6 and told["inside_band"] == 1.0 and told["fitted"] == {}
    low, high = told["inside_band_interval"]
    ends = binomtest(6, 6).proportion_ci()
    assert (low, high) == (ends.low, ends.high)


def test_a_parameter_that_is_off_is_found_from_every_second_point(tmp_path):
    made, usual = (
        load_data_set(data_set(tmp_path, lines(thicker=1.4))),
        GearMeshParams().viscosity_scale,
    )
    blind, fitted = compare(made), compare(made, fit=1)
    assert np.abs(blind.deviations).min() > 1e-3
    assert fitted.fitted["viscosity_scale"] == pytest.approx(1.4 * usual, rel=1e-3)
    assert fitted.judged.tolist() == [False, True] * 3
    assert np.abs(fitted.deviations).max() < 1e-5


def test_the_band_holds_the_scatter_and_the_reading_error(tmp_path):
    scatter = compare(load_data_set(data_set(tmp_path, lines(error=1e-9))))
    both = compare(load_data_set(data_set(tmp_path, lines(error=0.2))))
    assert ((scatter.low < scatter.computed) & (scatter.computed < scatter.high)).all()
    wide = (both.high - both.low) / both.computed
    assert (wide > (scatter.high - scatter.low) / scatter.computed).all()
    assert wide == pytest.approx(2.0 * 1.645 * 0.2, rel=0.2)


def test_deviations_keep_their_signs_everywhere(tmp_path):
    thick = tmp_path / "thick"  # the model's oil is thinner than what was measured
    thick.mkdir()
    found = compare(load_data_set(data_set(thick, lines(thicker=1.4))), draws=8)
    told, d = found.to_dict(), found.deviations
    assert told["mean_deviation"] == pytest.approx(np.mean(d)) and abs(np.mean(d)) > 1e-3
    assert abs(told["largest_deviation"]) == np.abs(d).max()
    assert told["largest_deviation"] in d.tolist()
    page = collection_page([found], [], tmp_path / "none.toml")
    assert f"| {100.0 * np.mean(d):+.1f} % | {100.0 * told['largest_deviation']:+.1f} %" in page


def test_only_what_was_measured_blind_on_the_same_machine_is_called_measured(tmp_path):
    kinds = {"measured": True, "other machine": False, "calculated": False, "used": False}
    for kind, ours in kinds.items():
        folder = tmp_path / kind.replace(" ", "-")
        folder.mkdir()
        made = load_data_set(data_set(folder, lines(), extra=f'kind = "{kind}"\n'))
        page = collection_page([compare(made, draws=8)], [], tmp_path / "none.toml")
        measured = page.partition("## Measured")[2].partition("## Compared")[0]
        assert ("1 data set, 6 points" in measured) == ours and (made.name in measured) == ours


def test_the_shelf_says_what_each_rig_is():
    names = [path.name for path in Path("examples/measured").iterdir() if path.is_dir()]
    found = {name: load_data_set(f"examples/measured/{name}").kind for name in names}
    assert "not said" not in found.values()
    assert found["vw-transaxle"] == found["oh-58a"] == "other machine"
    assert found["jackson-green-2006"] == "calculated" and found["wang-2012"] == "used"


GOOD = "2.0, 180, 0.5, 0.01, table"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"lines": ["2.0, 180, x, 0.01, table"]}, "line 2: friction_torque = 'x', a number"),
        ({"lines": ["2.0, 180, 0.5, 0.01, guess"]}, "origin 'guess', allowed: table, figure"),
        ({"lines": ["2.0, 180, 0.5, 0.01, fit"]}, "1 points are of a published fit"),
        ({"lines": []}, "no line of numbers"),
        ({"lines": ["2.0, 1e6, 0.5, 0.01, table"]}, "speed = 1e6|speed = 1000000"),
        ({"head": HEAD.replace("speed", "spede")}, "column 'spede' is not known; did you"),
        ({"head": HEAD.replace("friction_torque,", "load_factor,")}, "column 'load_factor'"),
        ({"source": ""}, "source = None, a text is required"),
        ({"extra": "vary = 'tilt'\n"}, "vary = 'tilt', allowed: an input that is a column"),
        ({"extra": "sorce = 'x'\n"}, "there is no 'sorce' here"),
        ({"extra": 'kind = "seen"\n'}, "kind = 'seen', allowed: measured, other machine"),
        ({"extra": 'scene = "planetary"\n'}, "part or scene, allowed: the name of one"),
    ],
)
def test_what_is_wrong_in_a_rig_is_named(tmp_path, change, words):
    given = {"lines": [GOOD]} | change
    with pytest.raises(ParameterError, match=words):
        load_data_set(data_set(tmp_path, **given))


def test_the_command_says_the_figures_and_writes_them(tmp_path, capsys):
    (tmp_path / "data_set").mkdir()
    folder, out = data_set(tmp_path / "data_set", lines()), tmp_path / "out"
    assert main(["compare", str(folder), "--json", "--draws", "8", "--out", str(out)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert {"points", "mean_deviation", "largest_deviation", "inside_band"} <= told.keys()
    assert json.loads((out / "comparison.json").read_text("utf-8"))["points"] == 6
    assert (out / "comparison.png").stat().st_size > 5_000
    page = tmp_path / "page.md"
    assert main(["compare", str(tmp_path), "--page", str(page), "--draws", "8"]) == 0
    text = page.read_text("utf-8")
    assert "6 of 6" in text and "after a fit of viscosity_scale" in text


def test_a_report_has_several_results_of_a_point(tmp_path):
    """A line with two measured columns is two points, each with its own error."""
    r = solve_gearmesh(GearMeshParams(film_heat="loss"), power=4e3, speed=180.0)
    head = HEAD.replace("origin", "contact_ratio, origin")
    line = f"4.0, 180, {r.friction_torque!r}, 0.01, {1.1 * r.contact_ratio!r}, table"
    made = load_data_set(data_set(tmp_path, [line], head))
    assert made.outputs == ("friction_torque", "contact_ratio") and made.units == ("N.m", "1")
    assert made.error.tolist() == [0.01, 0.0] and made.origin == ("table", "table")
    found = compare(made, draws=8)
    assert found.deviations == pytest.approx([0.0, 1.0 / 1.1 - 1.0], rel=1e-9, abs=1e-12)
    assert found.to_dict()["points"] == 2 and "2 results" in made.output


def in_a_gear(tmp_path, points):
    """Return a measured data set of the planetary gearbox in first gear."""
    data_set(tmp_path, points, "torque, speed, oil_temperature, efficiency, origin", extra="")
    rig = (tmp_path / "rig.toml").read_text("utf-8")
    (tmp_path / "rig.toml").write_text(rig.replace('part = "part.toml"', 'scene = "planetary"'))
    return load_data_set(tmp_path)


def test_a_gearbox_is_compared_point_by_point_and_a_point_without_a_solution_says_why(tmp_path):
    at = [{"torque": x, "speed": 200.0, "oil_temperature": t} for x, t in ((90, 330), (50, 360))]
    (ninety,), (fifty,) = gearbox("planetary").evaluate(at, ["efficiency"]).values.tolist()
    points = [f"90, 200, 330, {ninety!r}, table", f"50, 200, 360, {fifty!r}, table"]
    found = compare(in_a_gear(tmp_path, points), draws=2)
    assert found.deviations.tolist() == [0.0, 0.0] and found.data_set.target_name.endswith("gear")
    made = in_a_gear(tmp_path, [points[0], "9e4, 200, 330, 0.9, table"])
    with pytest.raises(SolveError, match="point 2 has no solution here: torque = 90000"):
        compare(made, draws=2)
    with pytest.raises(ParameterError, match="torque = 900000"):
        in_a_gear(tmp_path, ["9e5, 200, 330, 0.9, table"])


@pytest.mark.parametrize("name", ["wind-stage-3", "gearpie-c14", "gearpie-c40"])
def test_reports_of_others_are_met_but_for_what_their_rigs_explain(name):
    made = load_data_set(Path(__file__).parents[3] / "examples" / "measured" / name)
    off = dict(zip(made.outputs, compare(made, draws=2).deviations, strict=True))
    assert abs(off.pop("friction_power")) < 0.16
    assert max(map(abs, off.values())) < 0.03


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nix"], "measured data set 'nix': there is no such folder"),
        (["tests"], "measured data set 'tests': there is no rig.toml in it"),
        (["tests", "--fit", "x"], "--fit x: allowed: a whole number 0 .. 100"),
        (["tests", "--draws", "1"], "--draws 1: allowed: a whole number 2 .. 4096"),
    ],
)
def test_wrong_input_is_said_in_a_line(words, said, capsys):
    assert main(["compare", *words]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1


@pytest.mark.parametrize("name", ["fzg-c-mod", "wang-2012"])
def test_rigs_of_the_shelf_can_be_compared(name):
    found = compare(load_data_set(f"examples/measured/{name}"), draws=8)
    assert np.abs(found.deviations).max() < 0.02
