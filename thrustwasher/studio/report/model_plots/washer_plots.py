"""The washer: maps over its annulus, and its load curve with the folds."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....units import format_quantity
from ..palette import BLACK, BLUE, CELSIUS, GREY, ORANGE, RED, SIGMA
from ..style import decade_ticks, heading, label, legend_below, new_figure, note_at_right, styled
from ..target import chosen

Array = np.ndarray[Any, Any]
LEAST_PRESSURE = 1.0  # [Pa] of asperities that touch
ARROWS = 5, 24  # of the oil's flow, along the radius and around
ANGLES = np.linspace(0.0, 2.0 * np.pi, 129)  # finer around than any grid but the finest
LOWEST_RATIO = 0.1  # film ratios below, even negative ones, leave the logarithmic axis
BRANCHES = {
    "film": (BLUE, "-", "film branch (stable)"),
    "unstable": (GREY, "--", "unstable: never stays here"),
    "contact": (RED, "-.", "contact branch (stable)"),
}
FOLDS = {"film_lost": ("v", "film lost"), "film_regained": ("^", "film regained")}


@styled
def field_figure(result: Any, point: Mapping[str, float], params: object = None) -> Figure:
    """Return six maps of a solved washer.

    Parameters
    ----------
    result : a washer result with ``fields()``
    point : load [N], speed [rad/s], tilt [rad], oil_temperature [K]
    params : not needed; taken for the sake of one call for all models
    """
    fields = result.fields()
    figure, axes = new_figure(9.6, 12.6, 3, 2, head=2, right=0.5)
    touching = np.where(fields.contact_pressure < LEAST_PRESSURE, 0.0, fields.contact_pressure)
    maps = (
        ("Film thickness", "µm", fields.film_thickness * 1e6, "cividis"),
        ("Film pressure", "MPa", fields.pressure / 1e6, "viridis"),
        ("Asperity pressure", "MPa", touching / 1e6, "viridis"),
        ("Liquid in the film", "%", fields.liquid_fraction * 100.0, "Blues"),
        ("Film temperature", "°C", fields.film_temperature - CELSIUS, "inferno"),
        ("Carrier temperature", "°C", fields.carrier_temperature - CELSIUS, "inferno"),
    )
    for axis, (title, unit, values, colours) in zip(axes, maps, strict=True):
        _draw_map(axis, fields, values, title, unit, colours)
    _draw_flow(axes[3], fields)
    _mark_film(axes[0], fields, result)
    if not np.any(touching):
        axes[2].text(0.5, 0.5, "no contact", transform=axes[2].transAxes, ha="center", va="center")
    _draw_rotation(axes[0], fields, point["speed"])
    lost = ", FILM LOST (distress)" if result.distress else ""
    torque = format_quantity(result.friction_torque, "N.m")
    heading(figure, f"{_where(point)}\ntorque {torque}, {result.branch} branch{lost}")
    return figure


def _draw_map(axis: Axes, fields: Any, values: Array, title: str, unit: str, cmap: str) -> None:
    """Draw one field over x, y in millimetres."""
    x, y = _plane(fields)
    low, high = float(np.min(values)), float(np.max(values))
    look: Any = {"shading": "gouraud", "cmap": cmap, "rasterized": True}
    most = high if high > low else low + 1.0
    shades = axis.pcolormesh(x, y, _around(fields, values), vmin=low, vmax=most, **look)
    bar = axis.figure.colorbar(shades, ax=axis, shrink=0.82, pad=0.02)
    bar.set_label(f"{title.lower()} [{unit}]")
    bar.outline.set_visible(False)
    for rim in (fields.radius[0], fields.radius[-1]):
        turn = np.linspace(0.0, 2.0 * np.pi, 181)
        axis.plot(1e3 * rim * np.cos(turn), 1e3 * rim * np.sin(turn), color="#666666", lw=0.7)
    label(axis, f"{title}, {low:.3g} to {high:.3g} {unit}", "x [mm]", "y [mm]")
    axis.set_aspect("equal")
    axis.grid(False)


def _mark_film(axis: Axes, fields: Any, result: Any) -> None:
    """Mark the nodes' thinnest place and the lines film ratio 1 and 3."""
    x, y = _plane(fields)
    gap = _around(fields, fields.film_thickness)
    thinnest = np.unravel_index(np.argmin(gap), gap.shape)
    axis.plot(x[thinnest], y[thinnest], "x", color=RED, ms=9, mew=2.2, clip_on=False)
    axis.set_xlabel("x [mm]    (cross: thinnest film)")
    sigma = result.film_thickness / result.film_ratio if result.film_ratio else 0.0
    ratio = gap / sigma if sigma > 0.0 else None
    levels = [] if ratio is None else [v for v in (1.0, 3.0) if ratio.min() < v < ratio.max()]
    if ratio is not None and levels:
        lines = axis.contour(x, y, ratio, levels=levels, colors="white", linewidths=1.2)
        axis.clabel(lines, fmt=lambda v: f"h/{SIGMA} = {v:g}", fontsize=8)


def _draw_flow(axis: Axes, fields: Any) -> None:
    """Draw where the liquid flows; the longest arrow is named."""
    rows = np.unique(np.linspace(0, len(fields.radius) - 1, ARROWS[0]).round().astype(int))
    turn = np.linspace(0.0, 2.0 * np.pi, ARROWS[1], endpoint=False)
    outward, around = (
        np.array([np.interp(turn, fields.angle, row, period=2.0 * np.pi) for row in values[rows]])
        for values in (fields.flow_outward, fields.flow_around)
    )
    radius, cos, sin = 1e3 * fields.radius[rows, None], np.cos(turn), np.sin(turn)
    longest = float(np.max(np.hypot(outward, around)))
    if not longest > 0.0:
        return
    u, v = outward * cos - around * sin, outward * sin + around * cos
    look: Any = {"color": RED, "angles": "xy", "scale_units": "xy", "width": 0.004}
    axis.quiver(radius * cos, radius * sin, u, v, scale=longest / (0.2 * radius.max()), **look)
    axis.set_xlabel(f"x [mm]    (longest arrow: {1e6 * longest:.4g} mm²/s)")


def _draw_rotation(axis: Axes, fields: Any, speed: float) -> None:
    """Show which way the washer turns."""
    if speed == 0.0:
        return
    radius = 0.5e3 * fields.radius[0]
    turn = np.radians(np.linspace(-150.0, 120.0, 60)) * np.sign(speed)
    axis.plot(radius * np.cos(turn), radius * np.sin(turn), color=BLACK, lw=1.2)
    axis.annotate(
        "",
        (radius * np.cos(turn[-1]), radius * np.sin(turn[-1])),
        (radius * np.cos(turn[-4]), radius * np.sin(turn[-4])),
        arrowprops={"arrowstyle": "-|>", "color": BLACK, "lw": 1.2},
    )
    axis.text(0.0, 0.0, "washer\nturns", ha="center", va="center", fontsize=7.5)


def _plane(fields: Any) -> tuple[Array, Array]:
    """Return x, y [mm] of the drawn points: the nodes' circles, finer around."""
    radius = 1e3 * fields.radius[:, None]
    return radius * np.cos(ANGLES), radius * np.sin(ANGLES)


def _around(fields: Any, values: Array) -> Array:
    """Return the field at the drawn points, interpolated around."""
    rows = (np.interp(ANGLES, fields.angle, row, period=2.0 * np.pi) for row in values)
    return np.array(list(rows))


@styled
def curve_figure(
    curve: Any, point: Mapping[str, float], outputs: str | Sequence[str] = ()
) -> Figure:
    """Return film ratio, torque, temperature and friction coefficient over the load.

    Parameters
    ----------
    curve : a load curve with ``points`` and ``folds``
    point : speed [rad/s], tilt [rad], oil_temperature [K]
    outputs : of these four those to draw, each in a panel; none: all
    """
    panels: Any = (
        ("film_ratio", "Film ratio: how much film is left", f"film ratio h/{SIGMA} [1]"),
        ("friction_torque", "Friction torque", "friction torque [N·m]"),
        ("temperature", "Mean temperature of carrier and washer", "temperature [°C]"),
        ("friction_coefficient", "Friction coefficient (Stribeck)", "friction coefficient [1]"),
    )
    names = chosen("outputs", outputs, [name for name, *_ in panels])
    panels = [panel for panel in panels if not names or panel[0] in names]
    rows, columns = (len(panels) + 1) // 2, min(len(panels), 2)
    shape: Any = (5.0 * columns, 0.6 + 3.5 * rows, rows, columns)
    figure, axes = new_figure(*shape, head=2, foot=4 // columns // 2, choose="outputs")
    for axis, (name, title, up) in zip(axes, panels, strict=False):
        zero = CELSIUS if name == "temperature" else 0.0
        _draw_branches(axis, curve.points, name, zero)
        _draw_folds(axis, curve.folds, curve.points, name, zero)
        label(axis, title, "load [N]", up)
        axis.set_xlim(left=0.0)
        if name == "film_ratio":
            _scale_film(axis, curve.points)
        elif name == "friction_coefficient":
            axis.set_yscale("log")
            decade_ticks(axis)
    for axis in axes[len(panels) :]:
        axis.set_visible(False)
    legend_below(figure, *_legend(axes[0]), columns=5)
    heading(figure, f"{_where(point)}\n{_seen(curve.folds)}")
    return figure


@styled
def history_figure(history: Any) -> Figure:
    """Return torque, film, temperatures and what drives them over time.

    Parameters
    ----------
    history : a washer's time history, arrays over ``time`` [s]
    """
    figure, (torque, film, heat, inputs) = new_figure(10.4, 7.2, 2, 2, head=1)
    t, across = history.time, "time [s]"
    torque.plot(t, history.friction_torque, color=RED)
    label(torque, "Friction torque", across, "friction torque [N·m]")

    film.plot(t, np.maximum(history.film_ratio, LOWEST_RATIO), color=BLUE)
    film.set_yscale("log")
    for ratio, words in ((3.0, "3: mixed"), (1.0, "1: boundary")):
        film.axhline(ratio, color=ORANGE, lw=0.9, ls=":")
        note_at_right(film, words, ratio, va="bottom", color=GREY)
    decade_ticks(film)
    label(film, "Film", across, f"film ratio h/{SIGMA} [1]")

    for name, words, colour, dashes in (
        ("temperature_max", "hottest spot", ORANGE, "--"),
        ("temperature", "mean of carrier and washer", RED, "-"),
        ("oil_temperature", "oil", BLUE, ":"),
    ):
        heat.plot(t, getattr(history, name) - CELSIUS, color=colour, ls=dashes, label=words)
    label(heat, "Temperatures", across, "temperature [°C]")
    heat.legend()

    inputs.plot(t, history.load, color=GREY, label="load [N]")
    inputs.plot(t, history.speed, color=BLACK, ls="--", label="speed [rad/s]")
    inputs.plot(t, 1e5 * history.tilt, color=ORANGE, ls=":", label="tilt [0.01 mrad]")
    label(inputs, "What drives it", across, "load, speed, tilt")
    inputs.legend()
    lost = t[history.distress]
    words = f"film lost at {format_quantity(float(lost[0]), 's')}" if len(lost) else "film kept"
    heading(figure, f"Thrust washer over time, {history.thermal_mode.replace('_', ' ')}: {words}")
    return figure


def _scale_film(axis: Axes, points: Sequence[Any]) -> None:
    """Make the film ratio's axis logarithmic, with the borders of the regimes."""
    axis.set_yscale("log")
    axis.set_ylim(bottom=LOWEST_RATIO)
    decade_ticks(axis)
    _say_what_is_cut(axis, points)
    for ratio, words in ((3.0, "3: asperities begin to touch"), (1.0, "1: boundary lubrication")):
        axis.axhline(ratio, color=ORANGE, lw=0.9, ls=":")
        note_at_right(axis, words, ratio, color="#7A5400")


def _say_what_is_cut(axis: Axes, points: Sequence[Any]) -> None:
    """Say how far the film ratio goes on below the axis, if it does."""
    lowest = min(p.film_ratio for p in points)
    if lowest < LOWEST_RATIO:
        words = f"not drawn: ratios below {LOWEST_RATIO:g},\nhere down to {lowest:.2g}"
        place: Any = {"xycoords": "axes fraction", "textcoords": "offset points"}
        axis.annotate(words, (0.0, 0.0), (4, 4), fontsize=8, color=RED, **place)


def _draw_branches(axis: Axes, points: Sequence[object], name: str, zero: float) -> None:
    """Draw each branch in its own line style, joined to the next one."""
    for branch, part in _runs(points):
        colour, dashes, words = BRANCHES[branch]
        loads, values = [p.load for p in part], [getattr(p, name) - zero for p in part]
        axis.plot(loads, values, color=colour, ls=dashes, label=words)


def _runs(points: Sequence[Any]) -> Iterator[tuple[str, Sequence[Any]]]:
    """Yield the points of each branch; each part begins with the last point of the one before."""
    cuts = [i for i, (a, b) in enumerate(pairwise(points), 1) if a.branch != b.branch]
    for first, last in pairwise([0, *cuts, len(points)]):
        yield points[first].branch, points[max(first - 1, 0) : last]


def _draw_folds(
    axis: Axes, folds: Sequence[Any], points: Sequence[Any], name: str, zero: float
) -> None:
    """Mark where the film is lost and regained."""
    for fold in folds:
        value = getattr(fold, name, None)
        if value is None:  # read off the traced curve, at the point nearest in film ratio
            near = min(points, key=lambda p: abs(p.film_ratio - fold.film_ratio))
            value = getattr(near, name)
        marker, words = FOLDS[fold.kind]
        axis.plot([fold.load], [value - zero], marker, color=BLACK, ms=8, label=words, zorder=5)


def _legend(axis: Axes) -> tuple[list[Any], list[str]]:
    """Return each label once."""
    entries = dict(zip(*reversed(axis.get_legend_handles_labels()), strict=True))
    return list(entries.values()), list(entries)


def _where(point: Mapping[str, float]) -> str:
    """Return the operating point in words."""
    units = {"load": "N", "speed": "rad/s", "tilt": "rad", "oil_temperature": "K"}
    words = (f"{n} {format_quantity(point[n], u)}" for n, u in units.items() if n in point)
    return f"Thrust washer: {', '.join(words)}".replace("_temperature", "")


def _seen(folds: Sequence[Any]) -> str:
    """Return the folds in words."""
    found = [f"{FOLDS[f.kind][1]} at {format_quantity(f.load, 'N')}" for f in folds]
    return ", ".join(found) or "one solution at every load: no sudden loss of the film"
