"""The washer's load curve: all solutions at one speed, with the folds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..units import format_quantity
from .style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    RED,
    SIGMA,
    decade_ticks,
    heading,
    label,
    legend_below,
    new_figure,
    styled,
)  # fmt: skip

CELSIUS = 273.15
LOWEST_RATIO = 0.1  # film ratios below, even negative ones, leave the logarithmic axis
BRANCHES = {
    "film": (BLUE, "-", "film branch (stable)"),
    "unstable": (GREY, "--", "unstable: never stays here"),
    "contact": (RED, "-.", "contact branch (stable)"),
}
FOLDS = {"film_lost": ("v", "film lost"), "film_regained": ("^", "film regained")}


@styled
def curve_figure(curve: Any, point: Mapping[str, float]) -> Figure:
    """Return film ratio, torque, temperature and friction coefficient over the load.

    Parameters
    ----------
    curve : a load curve with ``points`` and ``folds``
    point : speed [rad/s], tilt [rad], oil_temperature [K]
    """
    figure, axes = new_figure(10.0, 7.6, 2, 2, head=2, foot=1)
    panels = (
        ("film_ratio", "Film ratio: how much film is left", f"film ratio h/{SIGMA} [1]", 0.0),
        ("friction_torque", "Friction torque", "friction torque [N·m]", 0.0),
        ("temperature", "Mean film temperature", "temperature [°C]", CELSIUS),
        (
            "friction_coefficient",
            "Friction coefficient (Stribeck)",
            "friction coefficient [1]",
            0.0,
        ),
    )
    for axis, (name, title, up, zero) in zip(axes, panels, strict=True):
        _draw_branches(axis, curve.points, name, zero)
        _draw_folds(axis, curve.folds, curve.points, name, zero)
        label(axis, title, "load [N]", up)
        axis.set_xlim(left=0.0)
    axes[0].set_yscale("log")
    axes[0].set_ylim(bottom=LOWEST_RATIO)
    axes[3].set_yscale("log")
    decade_ticks(axes[0])
    decade_ticks(axes[3])
    _say_what_is_cut(axes[0], curve.points)
    for ratio, words in ((3.0, "3: asperities begin to touch"), (1.0, "1: boundary lubrication")):
        axes[0].axhline(ratio, color=ORANGE, lw=0.9, ls=":")
        axes[0].annotate(
            words, (1.0, ratio), (-2, 2), xycoords=axes[0].get_yaxis_transform(),
            textcoords="offset points", ha="right", fontsize=8, color="#7A5400",
        )  # fmt: skip
    legend_below(figure, *_legend(axes[0]), columns=5)
    heading(figure, _heading(curve.folds, point))
    return figure


def _say_what_is_cut(axis: Axes, points: Sequence[Any]) -> None:
    """Say how far the film ratio goes on below the axis, if it does."""
    lowest = min(p.film_ratio for p in points)
    if lowest < LOWEST_RATIO:
        axis.annotate(
            f"not drawn: ratios below {LOWEST_RATIO:g},\nhere down to {lowest:.2g}", (0.0, 0.0),
            (4, 4), xycoords="axes fraction", textcoords="offset points", fontsize=8, color=RED,
        )  # fmt: skip


def _draw_branches(axis: Axes, points: Sequence[Any], name: str, zero: float) -> None:
    """Draw each branch in its own line style, joined to the next one."""
    for branch, part in _runs(points):
        colour, dashes, words = BRANCHES[branch]
        axis.plot(
            [p.load for p in part],
            [getattr(p, name) - zero for p in part],
            color=colour, ls=dashes, label=words,
        )  # fmt: skip


def _runs(points: Sequence[Any]) -> Iterator[tuple[str, Sequence[Any]]]:
    """Yield stretches of one branch; each begins with the last point of the one before."""
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


def _heading(folds: Sequence[Any], point: Mapping[str, float]) -> str:
    """Return what is seen, in words."""
    where = (
        f"Thrust washer at {point['speed']:.4g} rad/s, tilt {format_quantity(point['tilt'], 'rad')}"
        f", oil {format_quantity(point['oil_temperature'], 'K')}"
    )
    if not folds:
        return f"{where}\none solution at every load: no sudden loss of the film"
    words = [f"{FOLDS[f.kind][1]} at {format_quantity(f.load, 'N')}" for f in folds]
    return f"{where}\n{', '.join(words)}"
