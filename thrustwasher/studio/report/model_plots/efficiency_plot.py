"""Efficiency over torque and speed, and the losses by source along both."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, RPM, SKY
from ..style import heading, label, new_figure, styled
from .contours import numbered_contours

MOST_LINES = 8  # of a map: more stand too close for their numbers
SOURCES = {
    "pump_loss": ("oil pump", BLUE),
    "churning_loss": ("churning", SKY),
    "rolling_loss": ("bearings", GREEN),
    "bearing_loss": ("bearings", GREEN),
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
    if "oil_temperature" in c:
        first = c["oil_temperature"] == c["oil_temperature"][0]
        c = {name: column[first] for name, column in c.items()}
    there = [name for name in SOURCES if np.any(c.get(name, np.zeros(1)) > 0.0)]
    torque, speed = np.unique(c["torque"]), np.unique(c["speed"])
    order = np.lexsort((c["torque"], c["speed"]))
    grid = {name: c[name][order].reshape(len(speed), len(torque)) for name in c}
    figure, axes = new_figure(12.4, 4.3, 1, 3, head=1, right=0.35)
    percent, rpm = 100.0 * grid["efficiency"], np.round(RPM * speed, 6)  # whole ends have ticks
    running = grid["warnings"][np.isfinite(percent)]
    everywhere = running.min() if len(running) else 0.0  # of which a picture shows nothing
    further = grid["warnings"] > everywhere
    if min(percent.shape) > 1 and np.isfinite(percent).sum() > 2:
        numbered_contours(axes[0], rpm, torque, percent.T, _levels(percent), BLACK)
        _quadrants(axes[0], rpm, torque, percent)
        _hatch(axes[0], rpm, torque, further)
    else:
        along = (torque, "torque [N m]") if len(torque) > 1 else (rpm, "speed [rpm]")
        axes[0].plot(along[0], percent.ravel(), "o-", color=BLACK)
        bad = further.ravel()
        axes[0].plot(along[0][bad], percent.ravel()[bad], "x", color=RED)
        axes[0].set_xlabel(along[1])
    flat = min(percent.shape) > 1
    grey = ", grey: none" if flat and min(rpm[0], torque[0]) < 0.0 else ""
    label(
        axes[0],
        f"Efficiency [%]{grey}{_warned(flat, everywhere > 0.0, further.any())}",
        "speed [rpm]" if flat else "",
        "torque [N m]" if flat else "efficiency [%]",
    )
    j, i = _middle(speed), _middle(torque)
    for axis, x, rows, words, at in (
        (axes[1], torque, {n: grid[n][j] for n in there}, "torque [N m]", f"{rpm[j]:.0f} rpm"),
        (axes[2], rpm, {n: grid[n][:, i] for n in there}, "speed [rpm]", f"{torque[i]:.4g} N m"),
    ):
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
        both = with_room.get_xlim()[0] < 0.0 < with_room.get_xlim()[1]
        with_room.legend(loc="upper center" if both else "upper left", reverse=True)
    heading(figure, found.heading)
    return figure


def _middle(values: Any) -> int:
    """Return the place of a middle value, of those above 0 where there are both signs."""
    first = int(np.argmax(values > 0.0)) if values[0] < 0.0 < values[-1] else 0
    return first + (len(values) - first) // 2


def _quadrants(axis: Any, rpm: Any, torque: Any, percent: Any) -> None:
    """Draw the axes of a map of several quadrants, and grey where no power comes out."""
    for draw, ends in ((axis.axhline, torque), (axis.axvline, rpm)):
        if ends[0] < 0.0 < ends[-1]:
            draw(0.0, color=GREY, linewidth=0.8)
    if min(rpm[0], torque[0]) < 0.0:
        _fill(axis, rpm, torque, ~np.isfinite(percent), {"color": GREY, "alpha": 0.3, "lw": 0.0})


def _warned(flat: bool, everywhere: bool, further: bool) -> str:
    """Say which points have warnings; those marked have more than every point has."""
    if further:
        return f", {'hatched' if flat else 'crossed'}: warnings"
    return ", warnings at all points" if everywhere else ""


def _hatch(axis: Any, rpm: Any, torque: Any, where: Any) -> None:
    """Hatch around some points, half way to their neighbours."""
    look: dict[str, Any] = {"fill": False, "hatch": "///", "edgecolor": RED, "linewidth": 0.0}
    _fill(axis, rpm, torque, where, look)


def _fill(axis: Any, rpm: Any, torque: Any, where: Any, look: dict[str, Any]) -> None:
    """Draw a rectangle around each point of some, half way to its neighbours."""
    x, y = (np.concatenate([[v[0]], 0.5 * (v[1:] + v[:-1]), [v[-1]]]) for v in (rpm, torque))
    for j, i in np.argwhere(where):
        axis.add_patch(Rectangle((x[j], y[i]), x[j + 1] - x[j], y[i + 1] - y[i], **look))


def _levels(percent: Any) -> list[float]:
    """Return percents worth a line: closer to one another where efficiency is high."""
    known = percent[np.isfinite(percent)]
    wanted = [20, 40, 60, 70, 80, 85, 90, 92, 94, 95, 96, *np.arange(96.5, 100.0, 0.25)]
    found = [x for x in wanted if known.min() < x < known.max()] or [float(np.median(known))]
    return found[:: -(len(found) // MOST_LINES + 1)][::-1]
