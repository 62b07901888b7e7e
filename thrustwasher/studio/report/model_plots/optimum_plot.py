"""Designs that a search has tried: the front between two figures, or how one figure fell."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ....units import display_unit, pretty_unit
from ..palette import BLACK, GREY, ORANGE
from ..style import heading, label, new_figure, styled

ZERO = 273.15  # K


@styled
def optimum_figure(found: Any) -> Figure:
    """Return the picture of an ``Optimum``."""
    figure, (axis,) = new_figure(7.2, 4.6, 1, 1, head=1)
    goals = found.problem.goals
    scales, zeros, names = np.ones(len(goals)), np.zeros(len(goals)), []
    for i, goal in enumerate(goals):
        name, unit = goal.figure.name, goal.figure.unit
        if unit == "K" and not goal.figure.relative:
            zeros[i], unit = ZERO, "°C"
        else:
            sizes = np.abs(found.tried[np.isfinite(found.tried[:, i]), i])
            words, scales[i] = display_unit(float(sizes.max()), unit)
            unit = pretty_unit(words)
        names.append(f"{name} [{unit}]" if unit not in ("", "1") else name)
    if found.front:
        _front(axis, found, scales, zeros)
        label(axis, "", names[0], names[1])
    else:
        _profile(axis, found, scales[0], zeros[0])
        label(axis, "", "designs tried", names[0])
    wanted = " and ".join(g.words for g in goals)
    heading(figure, f"{found.target}: {wanted}")
    return figure


def _front(axis: Any, found: Any, scales: Any, zeros: Any) -> None:
    names = [g.figure.name for g in found.problem.goals]
    front = np.array([[d.figures[n] for n in names] for d in found.front])
    front = (front - zeros) / scales
    best = (np.array([found.best.figures[n] for n in names]) - zeros) / scales
    tried = (found.tried - zeros) / scales
    for where, look in _tried(found):
        axis.plot(*tried[where].T, "o", markersize=3.5, **look)
    axis.plot(*front.T, "o-", color=ORANGE, label="front")
    axis.plot(*best, "s", color=BLACK, label="best.toml")
    axis.plot(*tried[0], "x", color=BLACK, label="before the search")
    ends = np.vstack((front, tried[:1]))
    for set_range, values in zip((axis.set_xlim, axis.set_ylim), ends.T, strict=True):
        if np.isfinite(values).all() and np.ptp(values) > 0.0:
            low, high = values.min(), values.max()
            set_range(low - 0.1 * (high - low), high + 0.25 * (high - low))
    axis.legend(loc="best")


def _tried(found: Any) -> Iterator[tuple[Any, dict[str, Any]]]:
    """Give the designs inside all limits, filled, and those outside of one, hollow."""
    inside = found.feasible
    if inside is None or not found.problem.limits:
        yield np.ones(len(found.tried), bool), {"color": GREY, "alpha": 0.6, "label": "tried"}
        return
    hollow = {"markerfacecolor": "none", "markeredgewidth": 0.8}
    if inside.any():
        yield inside, {"color": GREY, "label": "tried, feasible"}
    if not inside.all():
        yield ~inside, {"color": GREY, "label": "tried, outside a limit", **hollow}


def _profile(axis: Any, found: Any, scale: float, zero: float) -> None:
    goal = found.problem.goals[0]
    tried = (found.tried[:, 0] - zero) / scale
    number = np.arange(1, len(tried) + 1)
    for where, look in _tried(found):
        axis.plot(number[where], tried[where], "o", markersize=4, **look)
    best = (found.best.figures[goal.figure.name] - zero) / scale
    axis.axhline(best, color=ORANGE, label="best.toml")
    axis.plot(1, tried[0], "x", color=BLACK, label="before the search")
    axis.legend(loc="best")
