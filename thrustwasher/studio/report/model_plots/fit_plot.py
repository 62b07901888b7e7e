"""A calibration: measured values, the fit with its confidence band, residuals."""

from collections.abc import Sequence
from textwrap import wrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ....model.registry import find_model
from ....units import display_unit, pretty_unit, unit_size
from ...calibration.measured import SLIDING
from ..palette import BLACK, BLUE, CELSIUS, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, label, new_figure, styled

COLOURS = (BLUE, RED, GREEN, PURPLE, ORANGE)  # of as many loads, told apart
SAME = 0.02  # of the largest value: nearer ones are one level of an input
TORQUE = "friction_torque"
N_RESIDUALS = 2  # panels of residuals per output: over the inputs that vary most
CHARACTERS = 12.0  # of a heading, per inch


@styled
def calibration_figure(found: Any, *, residuals: bool = True) -> Figure:
    """Return for each measured output points and fit, and residuals over inputs that vary most.

    Next to a torque stands its coefficient of friction. Units are those of the file.
    """
    shown = [_in_own_units(series, found) for series in found.shown()]
    drawn = [_inputs(series) for series in shown]
    beside = [_coefficient(series, found) if residuals else None for series in found.shown()]
    over_inputs = N_RESIDUALS if not any(beside) else 1
    counts = [min(len(over), over_inputs if residuals else 0) for over, _ in drawn]
    wide = max(1 + bool(f) + n for f, n in zip(beside, counts, strict=True))
    shape: Any = (11.0 if wide > 1 else 6.4, 1.2 + 3.0 * len(shown), len(shown), wide)
    told = fit_heading(found, shape[0])
    options: Any = {"across": 1.0, "choose": "residuals = False: of one output"}
    figure, panels = new_figure(*shape, head=1 + told.count("\n"), **options)
    rows = [panels[i : i + wide] for i in range(0, len(panels), wide)]
    for series, (inputs, apart), friction, n, (left, *others) in zip(
        shown, drawn, beside, counts, rows, strict=True
    ):
        groups = _groups(series, apart)
        _draw_fit(left, found, series, *inputs[0], groups)
        if friction is not None:
            _draw_fit(others.pop(0), found, friction, *inputs[0], groups)
        inputs = inputs[:n]
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
    heading(figure, told, fontsize=10)
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
    words = [f"{_short(float(at[place == k].mean()))} {unit}".strip() for k in range(len(levels))]
    return [(text, place == k) for k, text in enumerate(words)]


def _short(value: float) -> str:
    """Return three digits, without an exponent: 1500."""
    return repr(float(f"{value:.3g}")).removesuffix(".0")


def _in_own_units(series: Any, found: Any) -> Any:
    """Return an output and its inputs in the units of the file, else in those that a person reads.

    A sliding speed stands for a speed where the file has it, and a speed for the law's slip speed.
    """
    face = find_model(found.points.plan.spec.key).face(found.params)
    inputs = {}
    for name, (unit, values) in series.inputs.items():
        if name == "speed" and SLIDING in found.written and face:
            name, unit, values = SLIDING, "m/s", values * face.radius
        elif name == "slip speed" and "speed" in found.written and face:
            name, unit, values = "speed", "rad/s", values / face.radius
        shown, size, zero = own_unit(found, name, unit, values)
        inputs[name] = shown, (values - zero) / size
    unit, size, zero = own_unit(found, series.name, series.unit, series.measured)
    values = {
        "measured": (series.measured - zero) / size,
        "error": None if series.error is None else series.error / size,
        "computed": (series.computed - zero) / size,
        "half": series.half / size,
    }
    return series._replace(unit=unit, inputs=inputs, **values)


def own_unit(
    found: Any, name: str, unit: str, values: NDArray[np.float64]
) -> tuple[str, float, float]:
    """Return unit, size and zero [SI] in which a column is drawn."""
    written = found.written.get(name, "")
    if written and (pair := unit_size(written, unit)):
        return pretty_unit(written), *pair
    if unit == "K" and not np.any(values < CELSIUS - 100.0):
        return "°C", 1.0, CELSIUS
    return *display_unit(float(np.abs(values).max()), unit), 0.0


def _coefficient(series: Any, found: Any) -> Any:
    """Return a torque's points as coefficients of friction; None where they have no load."""
    face = find_model(found.points.plan.spec.key).face(found.params)
    load = series.inputs.get("load", ("", None))[1]
    if series.name != TORQUE or face is None or load is None or np.any(load <= 0.0):
        return None
    per = 1.0 / (load * face.count * face.radius)
    return series._replace(
        name="friction coefficient",
        unit="",
        measured=series.measured * per,
        error=None if series.error is None else series.error * per,
        computed=series.computed * per,
        half=series.half * per,
    )


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
        label(
            axis,
            series.name.replace("_", " "),
            _words(over, unit),
            _words(series.name, series.unit),
        )
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
    label(axis, series.name.replace("_", " "), _words(over, unit), _words(series.name, series.unit))
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
    return f"{name.replace('_', ' ')} [{unit or 1}]".strip()


def fit_heading(found: Any, width: float) -> str:
    """Return the constants that the points determine, and the number of those that are not.

    Lines are as long as a picture of this width [inch] takes.
    """
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
    length = int(CHARACTERS * width)
    return "\n".join(part for text in (first, second) for part in wrap(text, length))
