"""Maps over the washer's annulus: film thickness, pressures, temperature."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..units import format_quantity
from .style import BLACK, RED, SIGMA, heading, label, new_figure, styled

Array = np.ndarray[Any, Any]
CELSIUS = 273.15
ANGLES = np.linspace(0.0, 2.0 * np.pi, 129)  # finer around than any grid but the finest


@styled
def field_figure(result: Any, point: Mapping[str, float], words: str = "") -> Figure:
    """Return four maps of a solved washer.

    Parameters
    ----------
    result : a washer result with ``fields()``
    point : load [N], speed [rad/s], tilt [rad], oil_temperature [K]
    words : str
        Put before the operating point in the title.
    """
    fields = result.fields()
    figure, axes = new_figure(9.6, 8.6, 2, 2, head=2, right=0.5)
    maps = (
        ("Film thickness", "µm", fields.film_thickness * 1e6, "cividis"),
        ("Film pressure", "MPa", fields.pressure / 1e6, "viridis"),
        ("Asperity pressure", "MPa", fields.contact_pressure / 1e6, "viridis"),
        ("Film temperature", "°C", fields.film_temperature - CELSIUS, "inferno"),
    )
    for axis, (title, unit, values, colours) in zip(axes, maps, strict=True):
        _draw_map(axis, fields, values, title, unit, colours)
    _mark_film(axes[0], fields, result)
    if not np.any(fields.contact_pressure > 0.0):
        axes[2].text(0.5, 0.5, "no contact", transform=axes[2].transAxes, ha="center", va="center")
    _draw_rotation(axes[0], fields, point["speed"])
    heading(figure, _heading(result, point, words), fontsize=10.5)
    return figure


def _draw_map(axis: Axes, fields: Any, values: Array, title: str, unit: str, cmap: str) -> None:
    """Draw one field over x, y in millimetres."""
    x, y = _plane(fields)
    low, high = float(np.min(values)), float(np.max(values))
    shades = axis.pcolormesh(
        x, y, _around(fields, values), shading="gouraud", cmap=cmap, rasterized=True,
        vmin=low, vmax=high if high > low else low + 1.0,
    )  # fmt: skip
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


def _draw_rotation(axis: Axes, fields: Any, speed: float) -> None:
    """Show which way the washer turns."""
    if speed == 0.0:
        return
    radius = 0.5e3 * fields.radius[0]
    turn = np.radians(np.linspace(-150.0, 120.0, 60)) * np.sign(speed)
    axis.plot(radius * np.cos(turn), radius * np.sin(turn), color=BLACK, lw=1.2)
    axis.annotate("", (radius * np.cos(turn[-1]), radius * np.sin(turn[-1])),
                  (radius * np.cos(turn[-4]), radius * np.sin(turn[-4])),
                  arrowprops={"arrowstyle": "-|>", "color": BLACK, "lw": 1.2})  # fmt: skip
    axis.text(0.0, 0.0, "washer\nturns", ha="center", va="center", fontsize=7.5)


def _heading(result: Any, point: Mapping[str, float], words: str) -> str:
    """Return two lines: the operating point, the answer."""
    rpm = point["speed"] * 30.0 / np.pi
    where = (
        f"{words or 'Thrust washer'}: load {format_quantity(point['load'], 'N')}, "
        f"speed {point['speed']:.4g} rad/s ({rpm:.4g} rpm), "
        f"tilt {format_quantity(point['tilt'], 'rad')}, "
        f"oil {format_quantity(point['oil_temperature'], 'K')}"
    )
    answer = (
        f"torque {format_quantity(result.friction_torque, 'N.m')}, "
        f"film ratio {result.film_ratio:.3g}, mean film temperature "
        f"{format_quantity(result.temperature, 'K', digits=3)}, {result.branch} branch"
        + (", FILM LOST (distress)" if result.distress else "")
    )
    return f"{where}\n{answer}"


def _plane(fields: Any) -> tuple[Array, Array]:
    """Return x, y [mm] of the drawn points: the nodes' circles, finer around."""
    radius = 1e3 * fields.radius[:, None]
    return radius * np.cos(ANGLES), radius * np.sin(ANGLES)


def _around(fields: Any, values: Array) -> Array:
    """Return the field at the drawn points, interpolated around."""
    rows = (np.interp(ANGLES, fields.angle, row, period=2.0 * np.pi) for row in values)
    return np.array(list(rows))
