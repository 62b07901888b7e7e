"""A calibration: measured values, the fit with its confidence band, residuals."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ....units import display_unit
from ..palette import BLACK, BLUE, GREY, ORANGE, RED, SKY
from ..style import heading, label, new_figure, styled

N_RESIDUALS = 2  # panels of residuals per output: over the inputs that vary most


@styled
def calibration_figure(found: Any) -> Figure:
    """Return for each measured output points and fit, and residuals over inputs that vary most."""
    shown = [_readable(series) for series in found.shown()]
    figure, panels = new_figure(11.0, 1.2 + 3.0 * len(shown), len(shown), 1 + N_RESIDUALS, head=2)
    rows = [panels[i : i + 1 + N_RESIDUALS] for i in range(0, len(panels), 1 + N_RESIDUALS)]
    for series, (left, *others) in zip(shown, rows, strict=True):
        inputs = sorted(series.inputs.items(), key=lambda item: -len(np.unique(item[1][1])))
        inputs = [item for item in inputs if np.ptp(item[1][1]) > 0.0] or inputs[:1]
        _draw_fit(left, found, series, *inputs[0])
        for axis, (over, (unit, at)) in zip(others, inputs, strict=False):
            look: Any = {"color": BLUE, "marker": "o", "ls": "", "ms": 4.0, "alpha": 0.85}
            axis.errorbar(
                at, series.measured - series.computed, series.error, elinewidth=0.8, **look
            )
            axis.axhline(0.0, color=BLACK, lw=0.9)
            label(axis, "Residuals", _words(over, unit), _words("measured - fitted", series.unit))
        for axis in others[len(inputs) :]:
            axis.set_visible(False)
    heading(figure, fit_heading(found), fontsize=10)
    return figure


def _readable(series: Any) -> Any:
    """Return an output in the unit that a person reads."""
    unit, factor = display_unit(float(np.abs(series.measured).max()), series.unit)
    columns = ("measured", "error", "computed", "half")
    values = {name: getattr(series, name) for name in columns}
    shown = {name: None if x is None else x / factor for name, x in values.items()}
    return series._replace(unit=unit, **shown)


def _draw_fit(
    axis: Axes, found: Any, series: Any, over: str, values: tuple[str, NDArray[np.float64]]
) -> None:
    """Draw measured points and the fit with its band; in red what the points do not determine."""
    unit, at = values
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
