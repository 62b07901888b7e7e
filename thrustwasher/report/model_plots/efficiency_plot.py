"""Efficiency over torque and speed, and the losses by source along both."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ...units import format_quantity
from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, RPM, SKY
from ..style import heading, label, new_figure, styled

SOURCES = {
    "pump_loss": ("oil pump", BLUE),
    "churning_loss": ("churning", SKY),
    "rolling_loss": ("bearings", GREEN),
    "seal_loss": ("seals", PURPLE),
    "pack_loss": ("open pack", GREY),
    "mesh_loss": ("teeth", RED),
    "thrust_bearing_loss": ("thrust bearings", BLACK),
    "washer_loss": ("washers", ORANGE),
}


@styled
def efficiency_figure(found: Any) -> Figure:
    """Return the map, and losses stacked over torque and over speed at the middle of the other."""
    c = found.columns
    torque, speed = np.unique(c["torque"]), np.unique(c["speed"])
    order = np.lexsort((c["torque"], c["speed"]))
    grid = {name: c[name][order].reshape(len(speed), len(torque)) for name in c}
    figure, axes = new_figure(12.4, 4.3, 1, 3, head=1)
    percent, rpm = 100.0 * grid["efficiency"], RPM * speed
    if min(percent.shape) > 1 and np.isfinite(percent).sum() > 2:
        lines = axes[0].contour(rpm, torque, percent.T, levels=_levels(percent), colors=BLACK)
        axes[0].clabel(lines, fmt="%g")
        _hatch(axes[0], rpm, torque, grid["warnings"])
    else:
        along = (torque, "torque [N m]") if len(torque) > 1 else (rpm, "speed [rpm]")
        axes[0].plot(along[0], percent.ravel(), "o-", color=BLACK)
        bad = grid["warnings"].ravel() > 0.0
        axes[0].plot(along[0][bad], percent.ravel()[bad], "x", color=RED)
        axes[0].set_xlabel(along[1])
    flat = min(percent.shape) > 1
    label(
        axes[0],
        f"Efficiency [%]{_warned(flat) if (c['warnings'] > 0.0).any() else ''}",
        "speed [rpm]" if flat else "",
        "torque [N m]" if flat else "efficiency [%]",
    )
    j, i = len(speed) // 2, len(torque) // 2
    for axis, x, rows, words, at in (
        (axes[1], torque, {n: grid[n][j] for n in SOURCES}, "torque [N m]", f"{rpm[j]:.0f} rpm"),
        (axes[2], rpm, {n: grid[n][:, i] for n in SOURCES}, "speed [rpm]", f"{torque[i]:.4g} N m"),
    ):
        there = [n for n in SOURCES if np.any(c[n] > 0.0)]
        names, colours = ([SOURCES[n][k] for n in there] for k in range(2))
        heats = [rows[n] for n in there]
        if len(x) > 1:
            axis.stackplot(x, heats, labels=names, colors=colours, alpha=0.6)
            axis.set(xlim=(x[0], x[-1]), ylim=(0.0, None))
        else:
            axis.bar(names, [float(heat[0]) for heat in heats], color=colours)
            axis.tick_params(axis="x", rotation=60)
        label(axis, f"Losses at {at}", words if len(x) > 1 else "", "loss [W]")
    with_room = axes[2] if len(speed) > 1 else axes[1]
    if max(len(torque), len(speed)) > 1:
        with_room.legend(loc="upper left", reverse=True)
    oil = format_quantity(found.scene.oil_temperature, "K")
    heading(figure, f"{found.scene.title}, {found.gear} gear, oil {oil}")
    return figure


def _warned(flat: bool) -> str:
    return f", {'hatched' if flat else 'crossed'}: warnings"


def _hatch(axis: Any, rpm: Any, torque: Any, warnings: Any) -> None:
    """Hatch around each point that has warnings, half way to its neighbours."""
    if not (warnings > 0.0).any():
        return
    x, y = (np.concatenate([[v[0]], 0.5 * (v[1:] + v[:-1]), [v[-1]]]) for v in (rpm, torque))
    look: dict[str, Any] = {"fill": False, "hatch": "///", "edgecolor": RED, "linewidth": 0.0}
    for j, i in np.argwhere(warnings > 0.0):
        axis.add_patch(Rectangle((x[j], y[i]), x[j + 1] - x[j], y[i + 1] - y[i], **look))


def _levels(percent: Any) -> list[float]:
    """Return percents worth a line: closer to one another where efficiency is high."""
    known = percent[np.isfinite(percent)]
    wanted = [20, 40, 60, 70, 80, 85, 90, 92, 94, 95, 96, *np.arange(96.5, 100.0, 0.25)]
    return [x for x in wanted if known.min() < x < known.max()] or [float(np.median(known))]
