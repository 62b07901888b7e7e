"""A calibration: measured values, the fit with its confidence band, residuals."""

from collections.abc import Sequence
from itertools import product
from textwrap import wrap
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ....model.registry import find_model
from ....units import display_unit, pretty_unit, unit_size
from ...calibration.measured import SLIDING
from ..palette import BLACK, BLUE, CELSIUS, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, label, new_figure, styled
from ..target import empty_figure, size_of

COLOURS = (BLUE, RED, GREEN, PURPLE, ORANGE)  # of as many loads, told apart
MARKS = ("o", "s", "^", "D", "v")  # of a second input
SAME = 0.02  # of the largest value: nearer ones are one level of an input
TORQUE = "friction_torque"
N_RESIDUALS = 2  # panels of residuals per output: over the inputs that vary most
CHARACTERS = 12.0  # of a heading, per inch


@styled
def calibration_figure(found: Any, *, residuals: bool = True) -> Figure:
    """Return for each measured output points and fit, and residuals over inputs that vary most.

    Next to a torque stands its coefficient of friction. Units are those of the file.
    """
    si = found.shown()
    shown = [_in_own_units(series, found, series) for series in si]
    drawn = [_inputs(series, found) for series in shown]
    beside = [_coefficient(series, found) if residuals else None for series in si]
    over_inputs = N_RESIDUALS if not any(beside) else 1
    counts = [min(len(over), over_inputs if residuals else 0) for over, _ in drawn]
    wide = max(1 + bool(f) + n for f, n in zip(beside, counts, strict=True))
    shape: Any = (11.0 if wide > 1 else 6.4, 1.2 + 3.0 * len(shown), len(shown), wide)
    given = empty_figure()
    told = fit_heading(found, shape[0] if given is None else size_of(given)[0])
    options: Any = {"across": 1.0, "choose": "residuals = False: of one output"}
    figure, panels = new_figure(*shape, head=1 + told.count("\n"), **options)
    rows = [panels[i : i + wide] for i in range(0, len(panels), wide)]
    for bare, series, (inputs, apart), friction, n, (left, *others) in zip(
        si, shown, drawn, beside, counts, rows, strict=True
    ):
        over, groups = inputs[0][0], _groups(series, apart, found)
        curves = _curves(found, bare, list(bare.inputs)[list(series.inputs).index(over)], groups)
        own = [c._replace(fit=_in_own_units(c.fit, found, bare)) for c in curves]
        _draw_fit(left, found, series, over, groups, own)
        if friction is not None:
            of_load = [
                c._replace(fit=o.fit._replace(**_values(_coefficient(c.fit, found))))
                for c, o in zip(curves, own, strict=True)
            ]
            friction = friction._replace(inputs=series.inputs)
            _draw_fit(others.pop(0), found, friction, over, groups, of_load)
        inputs = inputs[:n]
        for axis, (over, (unit, at)) in zip(others, inputs, strict=False):
            left_over = series.measured - series.computed
            for group in groups:
                _draw_points(axis, at, left_over, series.error, group, "")
            axis.axhline(0.0, color=BLACK, lw=0.9)
            label(axis, "Residuals", _words(over, unit), _words("measured - fitted", series.unit))
        for axis in others[len(inputs) :]:
            axis.set_visible(False)
    heading(figure, told, fontsize=10)
    return figure


Inputs = list[tuple[str, tuple[str, NDArray[np.float64]]]]


class Group(NamedTuple):
    """Points that look alike: those at one value of each input that is told apart."""

    words: str
    own: NDArray[np.bool_]
    colour: str = BLUE
    mark: str = "o"
    curve: tuple[int, ...] = ()
    """Groups with the same have one fitted curve."""


class Curve(NamedTuple):
    """A fitted curve [SI, or in the file's units], and the points that it leads through."""

    fit: Any
    own: NDArray[np.bool_]
    colour: str


def _inputs(series: Any, found: Any) -> tuple[Inputs, Inputs]:
    """Return the inputs to draw over, and up to two of a few values, which looks tell apart.

    Colours tell the first of these; it is one that the fit depends on, if there is any.
    """
    levels = {name: len(_levels(values)) for name, (_, values) in series.inputs.items()}
    inputs = sorted(series.inputs.items(), key=lambda item: -levels[item[0]])
    inputs = [item for item in inputs if np.ptp(item[1][1]) > 0.0] or inputs[:1]
    apart = [item for item in inputs[1:] if levels[item[0]] <= len(COLOURS)]
    several = [item for item in apart if levels[item[0]] > 1]
    several.sort(key=lambda item: item[0] in found.without)
    return [item for item in inputs if all(item is not a for a in apart)], several[:2]


def _levels(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the values of an input that its own noise does not tell apart."""
    ordered = np.unique(values)
    new = np.diff(ordered, prepend=-np.inf) > SAME * np.abs(ordered).max()
    found: NDArray[np.float64] = ordered[new]
    return found


def _groups(series: Any, apart: Inputs, found: Any) -> list[Group]:
    """Return the points at each value of the inputs that are told apart."""
    places, words = [], []
    for _, (unit, at) in apart:
        levels = _levels(at)
        place = np.searchsorted(levels, at, "right") - 1
        means = [float(at[place == k].mean()) for k in range(len(levels))]
        places.append(place)
        words.append([f"{_short(mean)} {unit}".strip() for mean in means])
    groups = []
    for which in product(*(range(len(texts)) for texts in words)):
        own = np.ones(len(series.measured), bool)
        for place, k in zip(places, which, strict=True):
            own &= place == k
        if own.any():
            text = ", ".join(texts[k] for texts, k in zip(words, which, strict=True))
            first, second = (*which, 0, 0)[:2]
            acts = [k for (n, _), k in zip(apart, which, strict=True) if n not in found.without]
            groups.append(Group(text, own, COLOURS[first], MARKS[second], tuple(acts)))
    return groups


def _curves(found: Any, series: Any, over: str, groups: Sequence[Group]) -> list[Curve]:
    """Return the fitted curves [SI] over an input that are quick to draw."""
    curves = []
    for key in dict.fromkeys(group.curve for group in groups):
        alike = [group for group in groups if group.curve == key]
        own = np.logical_or.reduce([group.own for group in alike])
        colours = {group.colour for group in alike}
        fit = found.curve_over(series.name, over, own)
        if fit is not None:
            is_one = len(colours) == 1 and len(groups) > 1
            curves.append(Curve(fit, own, colours.pop() if is_one else BLACK))
    return curves


def _values(series: Any) -> dict[str, Any]:
    return {name: getattr(series, name) for name in ("name", "unit", "computed", "half")}


def _short(value: float) -> str:
    """Return three digits, without an exponent: 1500."""
    return repr(float(f"{value:.3g}")).removesuffix(".0")


def _in_own_units(series: Any, found: Any, like: Any) -> Any:
    """Return an output and its inputs in the units of the file, else in those that a person reads.

    These are as large as the values of ``like`` need.

    A sliding speed stands for a speed where the file has it, and a speed for the law's slip speed.
    """
    face = find_model(found.points.plan.spec.key).face(found.params)
    inputs = {}
    for name, (unit, values) in series.inputs.items():
        size_of = like.inputs[name][1]
        if name == "speed" and SLIDING in found.written and face:
            name, unit, values = SLIDING, "m/s", values * face.radius
            size_of = size_of * face.radius
        elif name == "slip speed" and "speed" in found.written and face:
            name, unit, values = "speed", "rad/s", values / face.radius
            size_of = size_of / face.radius
        shown, size, zero = own_unit(found, name.replace(" ", "_"), unit, size_of)
        inputs[name] = shown, (values - zero) / size
    unit, size, zero = own_unit(found, series.name, series.unit, like.measured)
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
    groups: Sequence[Group],
    curves: Sequence[Curve],
) -> None:
    """Draw measured points and the fit with its band; in red what the points do not determine.

    The fit is a curve where that was quick to solve, else a mark at each point: no lines join
    them, as the next point may lie on another branch.
    """
    unit, at = series.inputs[over]
    for group in groups:
        words = group.words or "measured"
        _draw_points(axis, at, series.measured, series.error, group, words)
    name, lost = f"fit, {100 * found.confidence:g} % band", "fit, not determined"
    bare = np.ones(len(at), bool)
    for curve in curves:
        bare &= ~curve.own
        x, fit = curve.fit.inputs[over][1], curve.fit.computed
        known = _known(curve.fit)
        if known.any():
            axis.plot(x, np.where(known, fit, np.nan), color=curve.colour, zorder=2)
            low, high = (np.where(known, fit + k * curve.fit.half, np.nan) for k in (-1.0, 1.0))
            axis.fill_between(x, low, high, color=curve.colour, alpha=0.2, lw=0.0)
        if not known.all():
            axis.plot(x, np.where(known, np.nan, fit), "--", color=RED, label=lost, zorder=2)
            lost = ""
    if any(_known(curve.fit).any() for curve in curves):
        axis.plot([], [], color=curves[0].colour if len(curves) == 1 else GREY, label=name)
        name = ""
    known = _known(series)
    for group in groups:
        own = group.own & known & bare
        if own.any():
            alone = len(groups) == 1
            ink = (ORANGE, SKY) if alone else (group.colour, group.colour)
            look: Any = {"color": ink[0], "ecolor": ink[1], "marker": "_", "ms": 10.0, "ls": ""}
            look |= {"elinewidth": 4.0, "alpha": 0.9 if alone else 0.5}
            axis.errorbar(at[own], series.computed[own], series.half[own], label=name, **look)
            name = ""
    if (bare & ~known).any():
        axis.plot(at[bare & ~known], series.computed[bare & ~known], "x", color=RED, label=lost)
    label(axis, series.name.replace("_", " "), _words(over, unit), _words(series.name, series.unit))
    axis.legend(edgecolor=GREY)


def _known(series: Any) -> NDArray[np.bool_]:
    """Return where the points determine the fit."""
    most = 10.0 * np.abs(series.computed).max()
    return np.asarray(np.isfinite(series.half) & (series.half < most))


def _draw_points(
    axis: Axes,
    at: NDArray[np.float64],
    values: NDArray[np.float64],
    errors: NDArray[np.float64] | None,
    group: Group,
    words: str,
) -> None:
    """Draw the points of a group with their errors."""
    look: Any = {"ls": "", "marker": group.mark, "ms": 4.5, "elinewidth": 0.8, "zorder": 3}
    error = None if errors is None else errors[group.own]
    own = group.own
    axis.errorbar(at[own], values[own], error, color=group.colour, label=words, **look)


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
