"""Plots of the models: what they show is what was solved, and nothing is dropped unsaid."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from curves import traced

from thrustwasher import GearMeshParams, LossesParams, calibrate, solve_gearmesh, solve_losses
from thrustwasher.clutch.solve import ClutchParams, boundary_friction, solve_clutch
from thrustwasher.studio.report.model_plots.clutch_plot import clutch_figure
from thrustwasher.studio.report.model_plots.fit_plot import calibration_figure
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


def test_every_panel_of_a_fit_names_what_it_is_over():
    slip = np.linspace(2.0, 160.0, 30)
    columns = {"speed": slip, "load": slip * 0 + 1e3, "friction": 0.1 + 0.02 * np.exp(-slip / 20.0)}
    axes = calibration_figure(calibrate(ClutchParams(), **columns)).axes
    assert [axis.get_xlabel() for axis in axes] == ["slip speed [m/s]", "slip speed [m/s]", ""]
    columns["load"] = np.linspace(1e3, 5e3, 30)
    axes = calibration_figure(calibrate(ClutchParams(), **columns)).axes
    assert axes[2].get_xlabel() == "load [N]" and axes[0].get_legend() is not None


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
