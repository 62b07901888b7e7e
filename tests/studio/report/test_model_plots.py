"""Plots of the models: what they show is what was solved, and nothing is dropped unsaid."""

import inspect
import json
import sys
from dataclasses import replace
from functools import cache
from html import unescape
from types import SimpleNamespace
from xml.etree import ElementTree

import needed
import numpy as np
import pytest
from curves import traced
from matplotlib.figure import Figure
from scene_runs import instances

import thrustwasher as tw
from thrustwasher import GearMeshParams, LossesParams, solve_gearmesh, solve_losses
from thrustwasher.cli import main
from thrustwasher.clutch.solve import ClutchParams, boundary_friction, solve_clutch
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.shift import cosimulate, load_scene, run_sequence
from thrustwasher.shift.steady_points import efficiency_map
from thrustwasher.shown import Card, Line, Shown, Tabled, Words, column_lines, plain
from thrustwasher.studio.report.model_plots.clutch_plot import clutch_figure
from thrustwasher.studio.report.model_plots.contours import numbered_contours
from thrustwasher.studio.report.model_plots.gearmesh_plot import gearmesh_figure, over_teeth
from thrustwasher.studio.report.model_plots.losses_plot import losses_figure
from thrustwasher.studio.report.model_plots.optimum_plot import optimum_figure
from thrustwasher.studio.report.model_plots.washer_plots import curve_figure

PACK = ClutchParams.preset(  # data of the asperities: with shear of the oil on top
    "paper", inner_radius=0.064, outer_radius=0.085, faces=8, friction_data="boundary"
)
POINT = {"load": 5898.0, "speed": -50.0, "oil_temperature": 297.15}
SLIPS = [0.0, 10.0, 20.0, 60.0]
MESH_POINT = {"power": 7500.0, "speed": 180.0, "oil_temperature": 299.85}
WASHER_POINT = {"load": 300.0, "speed": 953.0, "tilt": 2e-3, "oil_temperature": 297.15}


def drawn(fidelity="stribeck"):
    sweep = [solve_clutch(PACK, load=5898.0, speed=w, fidelity=fidelity) for w in SLIPS]
    here = solve_clutch(PACK, fidelity=fidelity, **POINT)
    ploughing = boundary_friction(0.1, 0.0, PACK.plough_weight)
    figure = clutch_figure(SLIPS, sweep, here, POINT, ploughing if fidelity != "closed" else None)
    return figure, sweep, here


def panel(figure, title):
    return next(a for a in figure.axes if a.get_title(loc="left") == title)


def test_shares_of_ploughing_and_adhesion_add_up_to_the_curve():
    figure, sweep, _ = drawn()
    for title, values in (
        ("Friction coefficient", [r.friction_coefficient for r in sweep]),
        ("Torque of the pack", [r.torque_capacity for r in sweep]),
    ):
        ploughing, adhesion = panel(figure, title).collections[:2]
        top = adhesion.get_paths()[0].vertices[:, 1].max()
        assert top == pytest.approx(values[0], rel=1e-12)
        height = ploughing.get_paths()[0].vertices[:, 1].max()
        share = boundary_friction(0.1, 0.0, PACK.plough_weight) / sweep[0].friction_coefficient
        assert height == pytest.approx(share * values[0], rel=1e-12)


def test_the_static_torque_and_the_point_are_marked():
    figure, sweep, here = drawn()
    axis = panel(figure, "Torque of the pack")
    assert any("389.2" in text.get_text() for text in axis.texts)
    marks = [line.get_xydata()[0] for line in axis.lines if line.get_marker() == "o"]
    assert marks[0] == pytest.approx((50.0, -here.friction_torque))
    assert sweep[0].torque_capacity == pytest.approx(389.2, abs=0.05)


def test_a_constant_coefficient_has_no_shares_and_no_shear_ratio():
    figure, *_ = drawn("closed")
    titles = {a.get_title(loc="left") for a in figure.axes}
    assert "Shear ratio" not in titles
    assert not panel(figure, "Friction coefficient").collections


def test_the_sweep_over_teeth_begins_at_the_least_number_and_is_one_of_single_solves():
    many = GearMeshParams(gear_ratio=5.0, pinion_teeth=80, sigma_rms=1.2e-6)
    teeth, sweeps = over_teeth(many, MESH_POINT, "field")
    assert (teeth[0], teeth[-1]) == (16, 80) and list(sweeps) == ["rough", "fine", "given"]
    assert all(r is not None for row in sweeps.values() for r in row)
    alone = solve_gearmesh(GearMeshParams(gear_ratio=5.0), **MESH_POINT)
    assert sweeps["rough"][teeth.index(20)].asperity_temperature == alone.asperity_temperature


def test_the_plot_draws_safety_and_loss_where_the_paper_has_no_data():
    params = GearMeshParams(gear_ratio=5.0, permissible_film_ratio=0.5)
    figure = gearmesh_figure(solve_gearmesh(params, **MESH_POINT), MESH_POINT, params)
    labels = [text for axes in figure.axes for text in axes.get_legend_handles_labels()[1]]
    assert {"pitting", "scuffing, rough ground", "micropitting, fine ground"} <= set(labels)
    assert not any("AISI" in text for text in labels)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles[1:] == ["Safety of the teeth", "Loss"]


def test_the_plot_draws_temperatures_and_both_steels():
    params = GearMeshParams.preset("paper", gear_ratio=5.0)
    _, sweeps = over_teeth(params, MESH_POINT, "field")
    figure = gearmesh_figure(solve_gearmesh(params, **MESH_POINT), MESH_POINT, params)
    labels = [text for axes in figure.axes for text in axes.get_legend_handles_labels()[1]]
    assert {"surface $T_s$", "asperities, rough ground", "AISI 4340, fine ground"} <= set(labels)
    rough = next(line for line in figure.axes[0].lines if "rough" in str(line.get_label()))
    expected = [r.asperity_temperature - 273.15 for r in sweeps["rough"]]
    assert list(rough.get_ydata()) == pytest.approx(expected)
    factors = figure.axes[2]
    shown = {text.get_text() for text in factors.get_legend().get_texts()}
    drawn = [line for line in factors.lines if np.any(np.isfinite(line.get_ydata()))]
    assert shown == {line.get_label() for line in drawn if "AISI" in line.get_label()}


def test_branches_of_the_curve_differ_in_more_than_colour():
    axis = curve_figure(traced(), WASHER_POINT).axes[0]
    styles = {line.get_label(): line.get_linestyle() for line in axis.lines}
    branches = [s for words, s in styles.items() if "stable" in words]
    assert len(branches) == len(set(branches)) == 3
    assert {"film lost", "film regained"} <= set(styles)


def test_a_curve_that_leaves_its_panel_says_so():
    curve = traced()
    thin = replace(curve.points[-1], film_ratio=-0.05)
    for points, said in ((curve.points, False), ((*curve.points, thin), True)):
        axis = curve_figure(replace(curve, points=points), WASHER_POINT).axes[0]
        assert any("down to -0.05" in text.get_text() for text in axis.texts) == said


def test_the_heat_of_a_driveline_is_stacked_to_its_sum():
    point = {"input_speed": 200.0, "output_speed": 80.0, "drum_speed": 0.0, "planet_speed": -200.0}
    point |= {"tooth_force": 2e3, "oil_temperature": 353.15}
    here = solve_losses(LossesParams(), **point)
    figure = losses_figure(here, point, LossesParams())
    for title, x in (("Over speed", 1.0), ("Over the oil", 80.0)):
        corners = panel(figure, title).collections[-1].get_paths()[0].vertices
        assert corners[np.isclose(corners[:, 0], x), 1].max() == pytest.approx(here.oil_heat, 1e-9)


def optimum(goals, limits=("film_ratio >= 18",)):
    """Return what the picture of a search reads: four designs, one of them outside a limit."""
    known = {"friction_torque": "N.m", "temperature_max": "K"}
    figures = [SimpleNamespace(name=n, unit=known[n], relative=False) for n in goals]
    wanted = [SimpleNamespace(figure=f, words=f"minimum {f.name}") for f in figures]
    tried = np.array([[0.24, 312.0], [0.25, 313.0], [0.26, 311.0], [0.27, 310.0]])
    designs = [SimpleNamespace(figures=dict(zip(known, row, strict=True))) for row in tried]
    return SimpleNamespace(
        target="washer",
        problem=SimpleNamespace(goals=wanted, limits=list(limits)),
        tried=tried[:, : len(goals)],
        feasible=np.array([True, True, False, True]),
        front=designs[:2] if len(goals) == 2 else (),
        best=designs[0],
    )


@pytest.mark.parametrize("goals", [["friction_torque", "temperature_max"], ["friction_torque"]])
def test_designs_outside_a_limit_are_hollow_and_the_legend_says_so(goals):
    (axis,) = optimum_figure(optimum(goals)).axes
    lines = {line.get_label(): line for line in axis.get_lines()}
    inside, outside = lines["tried, feasible"], lines["tried, outside a limit"]
    assert outside.get_markerfacecolor() == "none" != inside.get_markerfacecolor()
    assert len(outside.get_xdata()) == 1 and len(inside.get_xdata()) == 3
    names = [text.get_text() for text in axis.get_legend().get_texts()]
    assert {"tried, feasible", "tried, outside a limit", "best.toml"} <= set(names)
    if len(goals) == 2:
        assert axis.get_ylabel() == "temperature_max [°C]"
        assert outside.get_ydata()[0] == pytest.approx(311.0 - 273.15)


def test_without_limits_all_designs_look_alike():
    (axis,) = optimum_figure(optimum(["friction_torque"], limits=())).axes
    assert "tried" in [line.get_label() for line in axis.get_lines()]


# Results show themselves: plain data, a table for notebooks, a picture, columns of pandas.

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


def results_optimum():
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
    "Optimum": (results_optimum, "0.2583 N·m", "was 0.2584 N·m"),
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
    part = Figure(figsize=(14.0, 15.0)).subfigures()
    assert made(name).plot(fig=part) is part and len(part.axes) == len(figure.axes)


@each
@pytest.mark.slow
def test_what_has_columns_gives_them_to_pandas(name, made):
    result = made(name)
    if not isinstance(result, Tabled):
        return
    needed.package("pandas")
    frame, columns = result.to_pandas(), result._columns()
    units, index = frame.attrs["units"], frame.index.name
    assert index == ("time" if "time" in columns else None)
    frame = frame.reset_index() if index else frame
    assert list(frame) == list(columns) and len(frame) > 0
    for column, values in columns.items():
        assert frame[column].tolist() == pytest.approx(list(values), nan_ok=True)
    assert set(units) <= set(frame)


def test_a_point_is_a_series_of_its_numbers(made):
    needed.package("pandas")
    result = made("ClutchResult")
    series = result.to_pandas()
    assert series.name == "clutch" and series.dtype == float
    assert series["friction_torque"] == result.friction_torque and "regime" not in series
    assert {"load", "speed", "oil_temperature"} <= {*series.index}
    assert series.attrs["units"].keys() == {*series.index}
    assert series.attrs["units"]["friction_torque"] == "N.m"
    assert series.attrs["status"] == result.status.name


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


def test_the_text_of_a_part_and_of_a_scene_is_short():
    part, scene = tw.load_part("examples/ev-reducer.toml"), load_scene("planetary")
    assert repr(part).startswith("PartFile: EvReducer, a train, handbook")
    assert "rotor.bearing_1_diameter = 60 mm" in repr(part) and len(repr(part)) < 1500
    assert "step 0.001 s" in repr(scene) and "clutch (field)" in repr(scene)
    assert len(repr(scene)) < 1500


def test_the_text_of_a_result_at_a_point_is_short():
    train = repr(tw.solve_train(tw.TrainParams(), torque=150.0, speed=500.0))
    assert train.startswith("TrainResult: gear train, 2 meshes at torque 150 N·m")
    assert "efficiency  0.98" in train and "more results" in train and len(train) < 1500
    mesh = repr(tw.solve_gearmesh(tw.GearMeshParams(), power=7500.0, speed=180.0))
    assert "OK, warnings: " in mesh and "mean_friction  0.0192" in mesh and len(mesh) < 1500


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


def test_lines_of_equal_value_have_no_kinks_from_the_grid():
    """On 7 x 7 points of x y the line of 2 lies within 0.2 %, with straight pieces 0.9 %."""
    axis, at = Figure().add_subplot(), np.linspace(1.0, 2.0, 7)
    assert numbered_contours(axis, at, at, np.outer(at, at) ** 4, [16.0], "black") == [16.0]
    x, y = axis.collections[-1].get_paths()[0].vertices.T
    assert x * y == pytest.approx(2.0, rel=2e-3) and len(x) > 24
