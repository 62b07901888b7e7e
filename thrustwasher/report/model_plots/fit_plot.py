"""A calibration: measured points, the fitted law with its confidence band, residuals."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ...clutch.calibration.identifiability import counted
from ...units import format_quantity
from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import SECOND, TOP, heading, label, new_figure, second_scale, styled

Array = NDArray[np.float64]

SAMPLES = 301
LOOKS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "D"), (RED, "^"), (PURPLE, "v"), (GREY, "P"))
MOST_BANDS = len(LOOKS)  # loads told apart by colour and marker


@styled
def calibration_figure(found: Any, columns: Mapping[str, Sequence[float]]) -> Figure:
    """Return points and fitted curve over slip speed, residuals over slip speed and over load.

    Parameters
    ----------
    found : a calibration
    columns : speed [rad/s], load [N], friction, and friction_error if known
    """
    radius = found.params.friction_radius
    speed = np.abs(np.asarray(columns["speed"])) * radius
    load, error = np.asarray(columns["load"], float), columns.get("friction_error")
    figure, (top, middle, right) = _panels()
    groups = _groups(load)
    for (name, chosen), (colour, marker) in zip(groups.items(), LOOKS, strict=False):
        spread = None if error is None else np.asarray(error)[chosen]
        look: Any = {"color": colour, "marker": marker, "ls": "", "ms": 4.5, "alpha": 0.85}
        top.errorbar(
            speed[chosen], found.friction[chosen], spread, label=name,
            elinewidth=0.8, zorder=3, **look,
        )  # fmt: skip
        middle.plot(speed[chosen], found.residuals[chosen], **look)
        right.plot(load[chosen], found.residuals[chosen], **look)
    friction = found.friction
    ends = float(friction.min()), float(friction.max())
    _draw_curve(top, found, 1.05 * float(speed.max()) or 1.0, *ends)
    for axis in (middle, right):
        axis.axhline(0.0, color=BLACK, lw=0.9)
        axis.axhspan(-found.rms, found.rms, color=GREY, alpha=0.18, lw=0.0)
    label(top, "Friction: points and fitted law", "slip speed [m/s]", "friction coefficient [1]",
          above=SECOND)  # fmt: skip
    label(middle, "Residuals over slip speed", "slip speed [m/s]", "measured - fitted [1]")
    label(right, "Residuals over load", "load [N]", "")
    top.legend(loc="upper right", ncols=2)
    middle.set_xlim(top.get_xlim())
    heading(figure, _heading(found), fontsize=10)
    return figure


def _panels() -> tuple[Figure, list[Axes]]:
    """Return one wide panel above two."""
    figure, (top, spare, left, right) = new_figure(
        9.6, 7.0, 2, 2, head=2, top=TOP + SECOND, height_ratios=(1.7, 1.0)
    )
    place, end = top.get_position(), spare.get_position().x1
    top.set_position((place.x0, place.y0, end - place.x0, place.height))
    spare.remove()
    right.sharey(left)
    return figure, [top, left, right]


def _groups(load: Array) -> dict[str, Array]:
    """Return the points by load; many loads are gathered in a few ranges."""
    loads = np.unique(load)
    if len(loads) <= MOST_BANDS:
        return {format_quantity(float(x), "N"): load == x for x in loads}
    edges = np.unique(np.quantile(load, np.linspace(0.0, 1.0, MOST_BANDS)))
    groups = {}
    for i, (low, high) in enumerate(pairwise(edges)):
        inside = (load >= low) & ((load <= high) if i == len(edges) - 2 else (load < high))
        groups[f"{format_quantity(low, 'N')} .. {format_quantity(high, 'N')}"] = inside
    return groups


def _draw_curve(axis: Axes, found: Any, fastest: float, lowest: float, highest: float) -> None:
    """Draw the fitted law and, where the points tell it, its confidence band."""
    across = np.linspace(0.0, fastest, SAMPLES)
    curve, half = found.band(across)
    known = np.isfinite(half) & (half < 10.0 * max(float(curve.max()), 1e-9))
    axis.plot(across, curve, color=BLACK, lw=1.5, zorder=4, label="fitted law")
    name = f"{100 * found.confidence:g} % band"
    axis.fill_between(
        across, curve - half, curve + half, where=known, color=SKY, alpha=0.55, lw=0.0, label=name
    )
    if not known.all():
        axis.plot(
            across[~known], curve[~known], ".", color=RED, ms=3.5, zorder=5,
            label="not told by the points",
        )  # fmt: skip
    axis.set_ylim(min(0.0, lowest), 1.18 * max(highest, float(curve.max())))
    axis.set_xlim(0.0, fastest)
    second_scale(axis, 30.0 / (np.pi * found.params.friction_radius), "slip [rpm]")


def _heading(found: Any) -> str:
    """Return the constants that are told, and the number of those that are not."""
    told = [e for e in found.estimates if e.identifiable]
    words = [
        f"{e.name} {e.value:.3g} ± {e.standard_error:.1g}" + (f" {e.unit}" if e.unit != "1" else "")
        for e in told
    ]
    lost = [e.name for e in found.estimates if not e.identifiable]
    first = ", ".join(words) or "no constant is told by these points"
    second = f"rms residual {found.rms:.2g}, {counted(len(found.residuals), 'point')}"
    if lost and told:
        second += f"; not told: {', '.join(lost)}"
    if found.warnings:
        second += "; WARNING: the law cannot follow these points"
    return f"{first}\n{second}"
