"""Pictures of fits: curves where points are quick to solve, marks else; no line joins branches."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from thrustwasher import calibrate
from thrustwasher.clutch.solve import ClutchParams, solve_clutch
from thrustwasher.model.registry import find_model
from thrustwasher.studio.report.model_plots.fit_plot import calibration_figure, fit_heading


def test_every_panel_of_a_fit_names_what_it_is_over():
    slip = np.linspace(2.0, 160.0, 30)
    columns = {"speed": slip, "load": slip * 0 + 1e3, "friction": 0.1 + 0.02 * np.exp(-slip / 20.0)}
    axes = calibration_figure(calibrate(ClutchParams(), **columns)).axes
    assert [axis.get_xlabel() for axis in axes] == ["slip speed [m/s]", "slip speed [m/s]"]
    columns["load"] = np.linspace(1e3, 5e3, 30)
    axes = calibration_figure(calibrate(ClutchParams(), **columns)).axes
    assert axes[2].get_xlabel() == "load [kN]" and axes[0].get_legend() is not None


def test_loads_are_told_apart_and_take_no_panel_of_their_own():
    """Each load, which the rig holds within a percent, has its points and its fitted curve."""
    slip = np.tile(np.geomspace(0.3, 20.0, 8), 2)
    load = np.repeat([1500.0, 3000.0], 8) * (1.0 + 0.002 * np.cos(np.arange(16.0)))
    torque = [
        solve_clutch(ClutchParams(), load=n, speed=w).friction_torque
        for n, w in zip(load, slip, strict=True)
    ]
    data = {"load": load, "speed": slip, "friction_torque": torque}
    found = calibrate("clutch", data, fit=["friction_scale"])
    left, coefficient, residuals = calibration_figure(found).axes
    assert set(left.get_legend_handles_labels()[1]) == {"1.5 kN", "3 kN", "fit, 95 % band"}
    for curve, level in zip(curves_in(left), (1500.0, 3000.0), strict=True):
        x, y = curve.get_data()
        assert len(x) > 10 * 8 and (x[0], x[-1]) == pytest.approx((0.3, 20.0))
        pack, at = found.params, {"load": level, "speed": float(x[50])}
        assert y[50] == pytest.approx(solve_clutch(pack, **at).friction_torque, rel=1e-3)
    assert "speed" in residuals.get_xlabel()
    arm = ClutchParams().faces * ClutchParams().friction_radius
    points = coefficient.containers[0].lines[0].get_ydata()
    assert points == pytest.approx(np.array(torque[:8]) / (load[:8] * arm), rel=1e-12)
    (alone,) = calibration_figure(found, residuals=False).axes
    assert alone.get_ylabel() == "friction torque [N·m]"


def curves_in(axis):
    return [line for line in axis.lines if line.get_linestyle() == "-" and len(line.get_xdata())]


def law_test(temperatures):
    """Return friction of two loads at each oil temperature [K], which changes it by 0.2 %/K."""
    slip, n = np.geomspace(0.5, 150.0, 9), len(temperatures)
    load = np.tile(np.repeat([1500.0, 3000.0], 9), n)
    oil, speed = np.repeat(temperatures, 18), np.tile(slip, 2 * n)
    friction = (0.11 + 0.025 * np.exp(-speed / 25.0)) * np.exp(-2e-3 * (oil - 353.15))
    friction += 2e-4 * np.random.default_rng(3).standard_normal(18 * n)
    return {"speed": speed, "load": load, "friction": friction, "oil_temperature": oil}


def test_a_law_of_friction_is_drawn_as_its_curve_with_its_band():
    """One for all loads, which do not act in it; the points of each have a colour."""
    found = calibrate("clutch", law_test([353.15]))
    axis, residuals = calibration_figure(found).axes
    (curve,) = curves_in(axis)
    x, y = curve.get_data()
    law, half = found.band(x)
    warmed = np.exp(found.params.friction_temperature_slope * (353.15 - 373.15))
    assert len(x) > 10 * 9 and y == pytest.approx(law * warmed, rel=1e-12)
    (band,) = [c for c in axis.collections if not hasattr(c, "get_segments")]
    corners = band.get_paths()[0].vertices
    assert np.isfinite(half).all() and len(corners) > 2 * len(x)
    for end in (y - half * warmed, y + half * warmed):
        assert np.isclose(corners[:, 1, None], end, rtol=1e-9).any(axis=0).all()
    assert [len(points.lines[0].get_xdata()) for points in axis.containers] == [9, 9]
    assert residuals.get_xlabel() == "slip speed [m/s]"


def test_a_law_has_a_curve_for_each_temperature_that_changes_it():
    warm = [313.15, 353.15, 393.15]
    fit = ["plough_weight", "shear_floor", "decay_speed", "friction_temperature_slope"]
    axis, *_ = calibration_figure(calibrate("clutch", law_test(warm), fit=fit)).axes
    curves = curves_in(axis)
    assert len(curves) == 3 and len({curve.get_color() for curve in curves}) == 3
    drops = [curve.get_ydata()[-1] / curves[0].get_ydata()[-1] for curve in curves]
    assert drops == pytest.approx(np.exp(-2e-3 * np.array([0.0, 40.0, 80.0])), rel=0.01)
    assert "80 °C, 3 kN" in axis.get_legend_handles_labels()[1]


def test_where_the_band_is_not_finite_the_curve_is_red_and_has_none():
    slip, pack = np.geomspace(0.5, 150.0, 3), ClutchParams(friction_law="wang")
    friction = [0.13, 0.125, 0.11]  # fewer than constants: nothing tells their scatter
    found = calibrate(pack, {"speed": slip, "load": 1e3, "friction": friction})
    axis, *_ = calibration_figure(found).axes
    assert not np.isfinite(found.band(1.0)[1]).any() and not curves_in(axis)
    (curve,) = axis.lines[1:]
    assert len(curve.get_xdata()) > 100 and curve.get_label() == "fit, not determined"
    assert not [c for c in axis.collections if not hasattr(c, "get_segments")]


def test_no_line_joins_fitted_points_that_may_lie_on_other_branches(monkeypatch):
    """A washer's points; it is stood in for by a clutch of which no more points are solved."""
    monkeypatch.setattr(type(find_model("clutch")), "quick", False)
    slip, load = np.tile(np.geomspace(0.3, 20.0, 8), 2), np.repeat([1500.0, 3000.0], 8)
    data = {"load": load, "speed": slip, "friction_torque": 0.02 * load}
    for axis in calibration_figure(calibrate("clutch", data, fit=["friction_scale"])).axes[:2]:
        assert not curves_in(axis)
        assert [len(c.lines[0].get_xdata()) for c in axis.containers] == [8, 8, 8, 8]
    assert [find_model(key).quick for key in ("washer", "gearmesh")] == [False, True]


def test_a_fit_over_inputs_that_all_vary_has_no_curve():
    slip, load = np.geomspace(0.3, 20.0, 12), np.linspace(1e3, 4e3, 12)
    data = {"load": load, "speed": slip, "friction_torque": 0.02 * load}
    axis, *_ = calibration_figure(calibrate("clutch", data, fit=["friction_scale"])).axes
    assert not curves_in(axis) and len(axis.containers) == 2


def test_a_fit_is_drawn_in_the_units_of_its_file(tmp_path):
    slip, pack = np.geomspace(0.3, 20.0, 8), ClutchParams()
    torque = [solve_clutch(pack, load=3e3, speed=w).friction_torque for w in slip]
    speeds = {
        "speed [rpm]": slip * 30.0 / np.pi,
        "sliding_speed [mm/s]": slip * pack.friction_radius,
    }
    speeds["sliding_speed [mm/s]"] *= 1e3
    for head, speed in speeds.items():
        rows = [f"{w},{t / 1e3},3" for w, t in zip(speed, torque, strict=True)]
        file = tmp_path / "test.csv"
        file.write_text("\n".join([f"{head},friction_torque [kNm],load [kN]", *rows]))
        left, *_ = calibration_figure(calibrate(pack, file, fit=["friction_scale"])).axes
        assert left.get_xlabel() == head.replace("_", " ")
        assert left.get_ylabel() == "friction torque [kNm]"
        (x, y) = left.containers[0].lines[0].get_data()
        assert x == pytest.approx(speed) and y == pytest.approx(np.array(torque) / 1e3)


@pytest.mark.parametrize("width", [6.4, 11.0])
def test_a_heading_of_many_fitted_values_stays_in_its_picture(width):
    value = {"value": 5.13e4, "standard_error": 3e3, "unit": "Pa", "identifiable": True}
    many = [SimpleNamespace(name=f"kiss_pressure_{i}", **value) for i in range(6)]
    found = SimpleNamespace(estimates=many, residuals=[0.0], warnings=())
    figure = Figure(figsize=(width, 4.0))
    text = figure.suptitle(fit_heading(found, width), fontsize=10)
    box = text.get_window_extent()
    assert 0.0 <= box.x0 and box.x1 <= figure.bbox.x1
    assert all(estimate.name in text.get_text() for estimate in many)
