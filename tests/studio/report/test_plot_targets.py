"""Results draw on axes and in figures of the caller; points of a sweep are never joined."""

from functools import cache

import matplotlib as mpl
import numpy as np
import pytest
from curves import traced
from matplotlib.figure import Figure

import thrustwasher as tw

WARM = {"at": {"oil_temperature": 353.15}, "workers": 1}


@cache
def grid():
    return tw.run_sweep("clutch", {"speed": "1:9:2", "load": (2e3, 4e3)}, **WARM)


@cache
def points(n=40):
    columns = {"speed": 10.0, "load": 5e3, "friction_scale": 1.5}
    random = np.random.default_rng(1)
    given = {name: most * (0.1 + 0.9 * random.random(n)) for name, most in columns.items()}
    return tw.run_sweep("clutch", points=given, **WARM)


def test_one_panel_is_drawn_on_the_callers_axes_in_the_callers_style():
    figure, before = Figure(), dict(mpl.rcParams)
    axes = figure.subplots()
    look = axes.title.get_fontsize(), axes.spines["top"].get_visible()
    for load, colour in ((2e3, "red"), (4e3, "blue")):
        table = tw.run_sweep("clutch", {"speed": "1:9:2"}, at={"load": load}, workers=1)
        got = table.plot(axes, outputs="friction_torque", color=colour, label=f"{load:g} N")
        assert got is axes
    assert [(line.get_color(), line.get_label()) for line in axes.lines] == [
        ("red", "2000 N"),
        ("blue", "4000 N"),
    ]
    assert axes.get_xlabel() == "speed [rad/s]" and figure.axes == [axes]
    assert look == (axes.title.get_fontsize(), axes.spines["top"].get_visible())
    assert dict(mpl.rcParams) == before


@pytest.mark.parametrize("layout", [None, "constrained"])
def test_several_panels_are_drawn_in_the_callers_figure_or_part_of_it(layout):
    figure = Figure(figsize=(14.0, 6.0), layout=layout)
    left, right = figure.subfigures(1, 2)
    assert grid().plot(fig=left) is left and points().plot(fig=right) is right
    figure.draw_without_rendering()
    assert len(left.axes) == 4 and figure.axes == [*left.axes, *right.axes]
    for part in (left, right):
        for axes in part.axes:
            box = axes.get_tightbbox()
            assert part.bbox.x0 - 1.0 <= box.x0 and box.x1 <= part.bbox.x1 + 1.0


def refused(call):
    with pytest.raises(tw.ParameterError) as problem:
        call()
    return str(problem.value)


def test_a_wrong_target_is_named_with_what_is_allowed():
    figure = Figure()
    axes = figure.subplots()
    table = grid()
    told = refused(lambda: table.plot(axes))
    assert "4 panels" in told and "fig = .." in told and "outputs = .. with one name" in told
    assert "given by fig" in refused(lambda: table.plot(figure))
    assert "given by ax" in refused(lambda: table.plot(fig=axes))
    assert "polar axes" in refused(
        lambda: table.plot(Figure().subplots(subplot_kw={"polar": True}))
    )
    assert "fig has 1 axes" in refused(lambda: table.plot(fig=figure))
    assert "one of them" in refused(lambda: table.plot(axes, fig=figure))
    assert "2 x 1 inch" in refused(lambda: table.plot(fig=Figure(figsize=(2, 1))))
    assert "'friction_torque'?" in refused(lambda: table.plot(outputs="friction_torqe"))
    one = tw.solve_clutch(tw.ClutchParams(), load=5e3, speed=3.0)
    assert "colour=..): no such option" in refused(lambda: one.plot(colour="red"))


def test_after_a_wrong_target_pictures_have_figures_of_their_own():
    with pytest.raises(tw.ParameterError):
        grid().plot(Figure().subplots())
    assert len(grid().plot().axes) == 4


def test_a_load_curve_draws_the_output_that_is_asked_for():
    axes = Figure().subplots()
    assert traced().plot(axes, outputs="friction_coefficient") is axes
    assert axes.get_yscale() == "log" and axes.get_ylabel() == "friction coefficient [1]"


def test_random_points_are_a_matrix_of_points_that_no_line_joins():
    figure = points().plot()
    inputs = [axes.get_xlabel() for axes in figure.axes]
    assert len(figure.axes) == 9 and inputs[6:] == ["speed [rad/s]", "load [kN]", "friction scale"]
    for axes in figure.axes:
        assert {line.get_linestyle() for line in axes.lines} == {"None"}
        assert sum(len(line.get_xdata()) for line in axes.lines) == 40
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["OK: 38", "HOT: 2"]


def test_one_number_that_goes_up_and_down_is_points_too():
    speeds = [3.0, 1.0, 9.0, 4.0]
    table = tw.run_sweep("clutch", points={"speed": speeds}, at={"load": 4e3}, workers=1)
    axes = Figure().subplots()
    table.plot(axes, outputs="friction_torque")
    (line,) = axes.lines
    assert line.get_linestyle() == "None" and list(line.get_xdata()) == speeds


def test_points_that_failed_stand_at_the_lower_edge_in_the_colour_of_their_status():
    given = {"load": [300.0, 900.0, 40.0, 600.0], "speed": [900.0, 400.0, 600.0, 700.0]}
    table = tw.run_sweep("washer", points=given, at={"tilt": 0.002}, workers=1)
    table.columns["status"][1], table.columns["friction_torque"][1] = "NO_CONVERGENCE", np.nan
    object.__setattr__(table, "counts", {"OK": 3, "NO_CONVERGENCE": 1})
    figure = table.plot(outputs="friction_torque")
    sound, lost = figure.axes[0].lines[0], figure.axes[0].lines[-1]
    assert len(sound.get_xdata()) == 3 and lost.get_marker() == "x"
    assert list(lost.get_xdata()) == [900.0] and lost.get_color() != sound.get_color()
    assert lost.get_transform() == figure.axes[0].get_xaxis_transform()
    names = [t.get_text() for t in figure.legends[0].get_texts()]
    assert names == ["OK: 3", "NO CONVERGENCE: 1"]
