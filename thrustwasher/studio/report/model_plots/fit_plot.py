"""A calibration: measured values, the fit with its confidence band, residuals."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ....units import display_unit, format_quantity
from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, label, new_figure, styled

COLOURS = (BLUE, RED, GREEN, PURPLE, ORANGE)  # of as many loads, told apart
SAME = 0.02  # of the largest value: nearer ones are one level of an input
N_RESIDUALS = 2  # panels of residuals per output: over the inputs that vary most


@styled
def calibration_figure(found: Any) -> Figure:
    """Return for each measured output points and fit, and residuals over inputs that vary most."""
    shown = [_readable(series) for series in found.shown()]
    drawn = [_inputs(series) for series in shown]
    wide = 1 + max(min(len(over), N_RESIDUALS) for over, _ in drawn)
    figure, panels = new_figure(11.0, 1.2 + 3.0 * len(shown), len(shown), wide, head=2)
    rows = [panels[i : i + wide] for i in range(0, len(panels), wide)]
    for series, (inputs, apart), (left, *others) in zip(shown, drawn, rows, strict=True):
        groups = _groups(series, apart)
        _draw_fit(left, found, series, *inputs[0], groups)
        for axis, (over, (unit, at)) in zip(others, inputs, strict=False):
            left_over = series.measured - series.computed
            for colour, (_, own) in zip(COLOURS, groups, strict=False):
                look: Any = {"color": colour, "marker": "o", "ls": "", "ms": 4.0, "alpha": 0.85}
                error = None if series.error is None else series.error[own]
                axis.errorbar(at[own], left_over[own], error, elinewidth=0.8, **look)
            axis.axhline(0.0, color=BLACK, lw=0.9)
            label(axis, "Residuals", _words(over, unit), _words("measured - fitted", series.unit))
        for axis in others[len(inputs) :]:
            axis.set_visible(False)
    heading(figure, fit_heading(found), fontsize=10)
    return figure


Inputs = list[tuple[str, tuple[str, NDArray[np.float64]]]]


def _inputs(series: Any) -> tuple[Inputs, Inputs]:
    """Return the inputs to draw over, and those of a few values, which colours tell apart."""
    inputs = sorted(series.inputs.items(), key=lambda item: -len(_levels(item[1][1])))
    inputs = [item for item in inputs if np.ptp(item[1][1]) > 0.0] or inputs[:1]
    apart = [item for item in inputs[1:] if len(_levels(item[1][1])) <= len(COLOURS)]
    return [item for item in inputs if item not in apart], apart[:1]


def _levels(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the values of an input that its own noise does not tell apart."""
    ordered = np.unique(values)
    new = np.diff(ordered, prepend=-np.inf) > SAME * np.abs(ordered).max()
    found: NDArray[np.float64] = ordered[new]
    return found


def _groups(series: Any, apart: Inputs) -> list[tuple[str, NDArray[np.bool_]]]:
    """Return words and rows of the points at each value of the input that is told apart."""
    if not apart:
        return [("", np.ones(len(series.measured), bool))]
    _, (unit, at) = apart[0]
    levels = _levels(at)
    place = np.searchsorted(levels, at, "right") - 1
    words = [
        format_quantity(float(at[place == k].mean()), unit, digits=3) for k in range(len(levels))
    ]
    return [(text, place == k) for k, text in enumerate(words)]


def _readable(series: Any) -> Any:
    """Return an output in the unit that a person reads."""
    unit, factor = display_unit(float(np.abs(series.measured).max()), series.unit)
    columns = ("measured", "error", "computed", "half")
    values = {name: getattr(series, name) for name in columns}
    shown = {name: None if x is None else x / factor for name, x in values.items()}
    return series._replace(unit=unit, **shown)


def _draw_fit(
    axis: Axes,
    found: Any,
    series: Any,
    over: str,
    values: tuple[str, NDArray[np.float64]],
    groups: Sequence[tuple[str, NDArray[np.bool_]]],
) -> None:
    """Draw measured points and the fit with its band; in red what the points do not determine."""
    unit, at = values
    if len(groups) > 1:
        _draw_groups(axis, series, at, groups)
        label(axis, series.name.replace("_", " "), _words(over, unit), _words("", series.unit))
        axis.legend(edgecolor=GREY)
        return
    bars: Any = {"ls": "", "elinewidth": 0.8, "color": BLUE, "marker": "o", "ms": 4.5, "zorder": 3}
    axis.errorbar(at, series.measured, series.error, label="measured", **bars)
    known = np.isfinite(series.half) & (series.half < 10.0 * np.abs(series.computed).max())
    band: Any = {"color": ORANGE, "marker": "_", "ms": 8.0, "ecolor": SKY, "elinewidth": 4.0}
    computed, half = series.computed[known], series.half[known]
    name = f"fit, {100 * found.confidence:g} % band"
    axis.errorbar(at[known], computed, half, label=name, ls="", alpha=0.9, **band)
    if not known.all():
        axis.plot(at[~known], series.computed[~known], "x", color=RED, label="fit, not determined")
    label(axis, series.name.replace("_", " "), _words(over, unit), _words("", series.unit))
    axis.legend(edgecolor=GREY)


def _draw_groups(
    axis: Axes,
    series: Any,
    at: NDArray[np.float64],
    groups: Sequence[tuple[str, NDArray[np.bool_]]],
) -> None:
    """Draw the points of each group, and the fitted curve through them with its band."""
    for colour, (words, own) in zip(COLOURS, groups, strict=False):
        order = np.flatnonzero(own)[np.argsort(at[own])]
        x, fit, half = at[order], series.computed[order], series.half[order]
        error = None if series.error is None else series.error[order]
        look: Any = {"ls": "", "marker": "o", "ms": 4.5, "elinewidth": 0.8, "color": colour}
        axis.errorbar(x, series.measured[order], error, label=words, zorder=3, **look)
        axis.plot(x, fit, color=colour)
        known = np.isfinite(half) & (half < 10.0 * np.abs(series.computed).max())
        if known.all():
            axis.fill_between(x, fit - half, fit + half, color=colour, alpha=0.2, lw=0.0)


def _words(name: str, unit: str) -> str:
    return f"{name.replace('_', ' ')} [{unit}]".strip()


def fit_heading(found: Any) -> str:
    """Return the constants that the points determine, and the number of those that are not."""
    known = [e for e in found.estimates if e.identifiable]
    values = (f"{e.name} {e.value:.3g} ± {e.standard_error:.1g} {e.unit}" for e in known)
    words = [text.removesuffix(" 1") for text in values]
    lost = [e.name for e in found.estimates if not e.identifiable]
    first = ", ".join(words) or "no constant is determined by these points"
    second = f"{len(found.residuals)} measured values"
    if lost and known:
        second += f"; not determined: {', '.join(lost)}"
    if found.warnings:
        second += "; WARNING: the law cannot follow these points"
    return f"{first}\n{second}"
