"""Designs that a search has tried: the front between two figures, or how one figure fell."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ...units import display_unit, pretty_unit
from ..palette import BLACK, GREY, ORANGE
from ..style import heading, label, new_figure, styled


@styled
def optimum_figure(found: Any) -> Figure:
    """Return the picture of an ``Optimum``."""
    figure, (axis,) = new_figure(7.2, 4.6, 1, 1, head=1)
    goals = found.problem.goals
    scales, names = [], []
    for i, goal in enumerate(goals):
        sizes = np.abs(found.tried[np.isfinite(found.tried[:, i]), i])
        words, size = display_unit(float(sizes.max()), goal.figure.unit)
        unit = pretty_unit(words)
        scales.append(size)
        names.append(f"{goal.figure.name} [{unit}]" if unit not in ("", "1") else goal.figure.name)
    if found.front:
        _front(axis, found, scales)
        label(axis, "", names[0], names[1])
    else:
        _course(axis, found, scales[0])
        label(axis, "", "designs tried", names[0])
    wanted = " and ".join(g.words for g in goals)
    heading(figure, f"{found.target}: {wanted}")
    return figure


def _front(axis: Any, found: Any, scales: Any) -> None:
    names = [g.figure.name for g in found.problem.goals]
    front = np.array([[d.figures[n] for n in names] for d in found.front]) / scales
    best = np.array([found.best.figures[n] for n in names]) / scales
    tried = found.tried / scales
    axis.plot(*tried.T, ".", color=GREY, markersize=3, alpha=0.5, label="tried")
    axis.plot(*front.T, "o-", color=ORANGE, label="front")
    axis.plot(*best, "s", color=BLACK, label="best.toml")
    axis.plot(*tried[0], "x", color=BLACK, label="as it was")
    ends = np.vstack((front, tried[:1]))
    for set_range, values in zip((axis.set_xlim, axis.set_ylim), ends.T, strict=True):
        if np.isfinite(values).all() and np.ptp(values) > 0.0:
            low, high = values.min(), values.max()
            set_range(low - 0.1 * (high - low), high + 0.25 * (high - low))
    axis.legend(loc="upper right")


def _course(axis: Any, found: Any, scale: float) -> None:
    goal = found.problem.goals[0]
    tried = found.tried[:, 0] / scale
    axis.plot(np.arange(1, len(tried) + 1), tried, ".", color=GREY, label="tried")
    axis.axhline(found.best.figures[goal.figure.name] / scale, color=ORANGE, label="best.toml")
    axis.plot(1, tried[0], "x", color=BLACK, label="as it was")
    axis.legend(loc="best")
