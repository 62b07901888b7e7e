"""Results show themselves: plain data, a table for notebooks, a picture, columns of pandas."""

import inspect
import json
import sys
from dataclasses import replace
from functools import cache
from html import unescape
from xml.etree import ElementTree

import needed
import numpy as np
import pytest
from matplotlib.figure import Figure
from scene_runs import instances

import thrustwasher as tw
from thrustwasher.cli import main
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.shift import cosimulate, load_scene, run_sequence
from thrustwasher.shift.steady_points import efficiency_map
from thrustwasher.shown import Card, Line, Shown, Tabled, Words, column_lines, plain

AT = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
TIME = np.linspace(0.0, 0.3, 31)


def calibration():
    slip = np.linspace(2.0, 160.0, 20)
    pack = tw.ClutchParams(friction_law="wang", friction_temperature_slope=0.0)
    at = {"load": 6e3, "interface_temperature": 373.15}
    friction = [tw.solve_clutch(pack, **at, speed=w).friction_coefficient for w in slip]
    scatter = 1e-3 * np.random.default_rng(1).standard_normal(len(slip))
    return tw.calibrate(tw.ClutchParams(), speed=slip, load=6e3, friction=friction + scatter)


def area(width=2.0, height=1.0):
    return {"area": width * height}


def optimum():
    vary, limits = {"roughness": "0.3 um:1 um"}, ["film_ratio>=18"]
    return tw.optimise("washer", vary=vary, minimise="friction_torque", limits=limits, at=AT)


def shift():
    scene = load_scene("msl").with_options(step=2e-3)
    return cosimulate(scene, instances(scene))


def sequence(tmp_path_factory):
    file = tmp_path_factory.mktemp("scene") / "one.toml"
    table = '[sequence]\nshifts = [[0.0, "up"]]\nwindow = 1.3\n'
    file.write_text(f'base = "planetary"\nstop_time = 1.4\n{table}')
    scene = load_scene(file)
    return run_sequence(scene, instances(scene))


MADE = {  # result -> how it comes about, a figure with its unit, words of its meaning
    "WasherResult": (lambda: tw.solve_washer(tw.WasherParams(), **AT), "0.25841 N·m", "friction"),
    "TrainResult": (
        lambda: tw.solve_train(tw.TrainParams(), torque=150.0, speed=500.0),
        "2.4288 N·m",
        "all losses as a torque",
    ),
    "ClutchResult": (
        lambda: tw.solve_clutch(tw.ClutchParams(), load=5e3, speed=3.0),
        "171.57 N·m",
        "if this slip lasted for ever",
    ),
    "GearMeshResult": (
        lambda: tw.solve_gearmesh(tw.GearMeshParams(), power=7500.0, speed=150.0),
        "N·m",
        "mesh loss as a torque on the pinion",
    ),
    "LossesResult": (
        lambda: tw.solve_losses(tw.LossesParams(), input_speed=200.0),
        "W",
        "power that the oil pump takes up",
    ),
    "LoadCurve": (
        lambda: tw.load_curve(tw.WasherParams(), speed=545.0, tilt=0.002),
        "957.9 N",
        "load of this fold",
    ),
    "Engagement": (
        lambda: tw.engage_clutch(
            tw.ClutchParams(), time=TIME, load=6e3 * np.minimum(TIME / 0.1, 1.0), speed=100.0
        ),
        "0 N .. 6 kN",
        "heat made by friction",
    ),
    "WasherHistory": (
        lambda: tw.follow_washer(
            tw.WasherParams(thermal_mode="transient"), time=[0.0, 0.1, 0.2], **AT
        ),
        "300 N",
        "friction torque on the washer",
    ),
    "SweepTable": (
        lambda: tw.run_sweep("washer", {"load": "300:1200:300", "speed": (436.0, 545.0)}),
        "300 N .. 1.2 kN",
        "axial load on the washer",
    ),
    "ScatterResult": (
        lambda: tw.propagate(area, scatter={"width": "10 %", "height": "5 %"}, runs=64),
        "1.59 .. 2.37",
        "decided most by width",
    ),
    "Optimum": (optimum, "0.2583 N·m", "was 0.2584 N·m"),
    "Calibration": (calibration, " +- 0.028 m/s", "slip speed below which"),
    "ShiftResult": (shift, "2.111 s", "clutch locks"),
    "SequenceResult": (sequence, "kJ", "s after it began"),
    "EfficiencyMap": (
        lambda: efficiency_map(load_scene("planetary"), [100.0, 200.0], [200.0]),
        "100 N·m .. 200 N·m",
        "tooth friction of all meshes",
    ),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    @cache
    def result(name):
        make = MADE[name][0]
        return make(tmp_path_factory) if inspect.signature(make).parameters else make()

    return result


def cells(page):
    """Return the rows of a table; a page that is not well-formed fails here."""
    rows = ElementTree.fromstring(f"<div>{page}</div>").iter("tr")
    return [["".join(cell.itertext()) for cell in row] for row in rows]


each = pytest.mark.parametrize("name", MADE)


def test_every_public_result_is_tried():
    public = {getattr(tw, name) for name in tw.__all__}
    results = {kind.__name__ for kind in public if isinstance(kind, type)}
    shown = {n for n in results if issubclass(getattr(tw, n, object), Shown)}
    assert shown == set(MADE) - {"EfficiencyMap"}
    ends = ("Result", "Curve", "History", "Table", "Optimum", "Calibration", "Engagement")
    assert {n for n in results if n.endswith(ends)} == shown


@each
@pytest.mark.slow
def test_plain_data_is_what_json_holds(name, made):
    found = made(name).to_dict()
    again = json.loads(json.dumps(found, allow_nan=False))
    assert again.keys() == found.keys() and not [n for n in again if n.startswith("_")]
    assert json.dumps(made(name).as_dict()) == json.dumps(found)


@each
@pytest.mark.slow
def test_a_notebook_shows_figure_value_and_meaning(name, made):
    page, (_, value, words) = made(name)._repr_html_(), MADE[name]
    heads, *rows = cells(page)
    assert heads == ["figure", "value", "meaning"] and {len(row) for row in rows} == {3}
    assert [row for row in rows if value in row[1]]
    assert [row for row in rows if words in row[2]]
    assert "<script" not in page and "nan" not in page


@each
@pytest.mark.slow
def test_its_picture_is_a_figure_that_a_notebook_shows(name, made):
    figure = made(name).plot()
    assert isinstance(figure, Figure) and figure.get_axes()
    assert figure._repr_png_().startswith(b"\x89PNG")


@each
@pytest.mark.slow
def test_what_has_columns_gives_them_to_pandas(name, made):
    result = made(name)
    if not isinstance(result, Tabled):
        assert not hasattr(result, "to_pandas")
        return
    needed.package("pandas")
    frame, columns = result.to_pandas(), result._columns()
    assert list(frame) == list(columns) and len(frame) > 0
    for column, values in columns.items():
        assert frame[column].tolist() == pytest.approx(list(values), nan_ok=True)
    assert set(frame.attrs["units"]) <= set(frame)


def test_the_columns_have_units(made):
    needed.package("pandas")
    units = made("LoadCurve").to_pandas().attrs["units"]
    assert units["load"] == "N" and units["temperature"] == "K" and units["film_ratio"] == "1"
    assert made("ShiftResult").to_pandas().attrs["units"]["clutch.temperature"] == "K"


@pytest.mark.parametrize("name", ["LoadCurve", "ShiftResult", "Calibration", "ScatterResult"])
def test_without_pandas_it_is_said_what_to_install(name, made, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(EnvironmentProblem, match=r"to_pandas needs .*: pip install pandas"):
        made(name).to_pandas()


def test_the_table_says_what_the_command_prints(made, capsys):
    assert main(["washer", "--load", "300", "--speed", "953", "--tilt", "0.002"]) == 0
    told = capsys.readouterr().out
    page = made("WasherResult")._repr_html_()
    for name, value, words in cells(page)[1:]:
        line = next(row for row in told.splitlines() if row.split()[:1] == [name])
        assert value in line and line.endswith(words)
    assert told.splitlines()[0] in unescape(page)


def test_text_is_escaped_and_warnings_stand_below():
    class Evil(Shown):
        def _card(self):
            lines = [Line("<b>", "1 < 2", "a & b")]
            return Card("<script>alert(1)</script>", lines, ["<i>"], ["5 < 6"])

    page = Evil()._repr_html_()
    assert cells(page)[1] == ["<b>", "1 < 2", "a & b"]
    assert "<script" not in page and "<i>" not in page
    assert "<strong>Warning:</strong> 5 &lt; 6" in page


def test_warnings_of_a_result_are_shown(made):
    hot = tw.solve_washer(tw.WasherParams(), load=1200.0, speed=545.0, tilt=0.002)
    assert hot.warnings
    page = unescape(hot._repr_html_())
    assert all(text in page for text in hot.warnings)


def test_inputs_that_are_left_out_have_no_line(made):
    for name in ("WasherHistory", "SweepTable"):
        assert "far_face_temperature" not in made(name)._repr_html_()


def test_what_cannot_be_drawn_is_named():
    looked_up = tw.solve_washer(tw.WasherParams(), **AT, fidelity="map")
    with pytest.raises(tw.ParameterError, match="fidelity = 'map' has no fields; allowed: 'field'"):
        looked_up.plot()
    point = tw.run_sweep("washer", {"load": (300.0,)})
    with pytest.raises(tw.ParameterError, match="nothing varies in this table"):
        point.plot()


def test_a_sweep_of_words_and_numbers_is_drawn():
    axes = {"load": "100:500:200", "speed": (100.0, 500.0), "gear_far_face": ("oil", "bulk")}
    table = tw.run_sweep("washer", axes)
    figure = table.plot()
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert len(texts) == 4 and "speed 100 rad/s, gear far face oil" in texts
    assert figure.get_axes()[0].get_xlabel() == "load [N]"


def test_columns_are_told_by_their_ranges():
    columns = {
        "load": np.array([5.0, np.nan, 20.0]),
        "lost": np.array([True, False, True]),
        "regime": ["film", "", "mixed"],
        "none": np.array([np.nan, np.nan]),
    }
    lines = list(column_lines(columns, {"load": Words("N", "axial load")}))
    assert [line.value for line in lines] == ["5 N .. 20 N", "yes at 2 of 3", "film, mixed", "none"]
    assert lines[0].words == "axial load"


def test_plain_data_has_no_types_of_its_own():
    found = plain({1: np.float64(2.0), "n": np.int64(3), "b": np.bool_(True), "x": float("inf")})
    assert found == {"1": 2.0, "n": 3, "b": True, "x": None}
    assert plain([tw.Status.OK, np.arange(2), ("a",)]) == ["OK", [0, 1], ("a",)]


def test_a_study_stands_beside_the_figures_of_its_shift(made):
    shift = replace(made("ShiftResult"), scatter=made("ScatterResult"))
    assert shift.to_dict()["scatter"]["runs"] == 64
    assert "scatter" not in made("ShiftResult").to_dict()
