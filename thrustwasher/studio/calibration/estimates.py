"""A calibration as it comes out: numbers, sentences, plain data."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.registry import find_model
from ...model.solutions import words_at_points
from ...numerics.jit import Array
from ...shown import Card, Line, Tabled, Words
from ...storage.digests import finite
from ...units import display_unit
from ..evaluators.evaluator import Remark, texts
from .identifiability import Information, counted
from .least_squares import FitProblem
from .measured import Measured, output_units
from .row_groups import points_at

NARROW = 1e-8  # relative width below which the ends of an interval would need too many digits
DENSE = 100  # places of a curve over the range of its points, and as many more among their ranks
STEADY = 0.02  # of the largest value: an input that changes more gives no curve over another one
CURVED = 0.2  # of the width: ends of the two intervals further apart are worth a word


@dataclass(frozen=True, slots=True)
class Estimate:
    """One fitted number with its uncertainty, SI units."""

    name: str
    unit: str
    value: float
    standard_error: float  # infinite where the points do not tell it
    interval: tuple[float, float]
    """Linearised, within the allowed range; that whole range if not identifiable."""
    profile_interval: tuple[float, float] | None
    """From the rise of the sum of squares, the other constants refitted; None if not computed."""
    identifiable: bool
    at_bound: str  # "lower", "upper" or "" (inside the allowed range)
    reason: str
    """Why it is not identifiable, or what stops it at a bound; "" if there is nothing to say."""


class Series(NamedTuple):
    """Measured and computed values of one output, to be drawn."""

    name: str
    unit: str
    inputs: Mapping[str, tuple[str, Array]]  # unit and values
    measured: Array
    error: Array | None
    computed: Array
    half: Array  # half width of the confidence band; infinite where the points do not tell it


@dataclass(frozen=True, eq=False, kw_only=True)
class Calibration(Tabled):
    """Parameters fitted to measurements; ``str()`` of it is a summary in sentences."""

    without: ClassVar[tuple[str, ...]] = ()
    """Inputs that what is fitted does not depend on."""
    params: Any  # the part with the fitted values, to solve and for FMUs
    points: Measured
    fitted: Array  # (n,) computed outputs, in the order of ``points.value``
    estimates: tuple[Estimate, ...]  # in the order of ``fit``
    derived: tuple[Estimate, ...] = ()  # follow from the constants; often told where they are not
    correlation: Array  # (constants, constants); NaN where a constant is not told
    confounded: tuple[str, ...]
    """Combinations of constants that the points cannot tell apart, a sentence each."""
    singular_values: tuple[float, ...]
    """Of the scaled derivatives over the scatter, falling; 0: nothing is known of a direction."""
    residuals: Array  # (n,) measured less fitted value [SI unit of its output]
    rms: float
    """Of the residuals [SI]; it has a unit where one output is fitted, ``rms_of`` tells each."""
    degrees_of_freedom: int
    reduced_chi_square: float | None  # None without given errors
    confidence: float
    remarks: tuple[Remark, ...] = ()
    """Warnings of points that the fit cannot follow, the gravest first, none of a sound fit; notes
    on what else the points tell."""
    written: Mapping[str, str] = field(default_factory=dict, repr=False)
    """Units of columns as a file had them: its picture has them too."""
    _problem: FitProblem = field(repr=False)
    _best: Array = field(repr=False)
    _learned: Information = field(repr=False)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What of ``remarks`` is a warning, in words."""
        return texts(self.remarks, "warning")

    @property
    def taken(self) -> str:
        """The inputs that the points do not have, and where their values come from."""
        return str(self.points.plan.taken) if self._problem.terms.fidelity else ""

    def __getitem__(self, name: str) -> Estimate:
        """Return the estimate of one constant."""
        return next(e for e in (*self.estimates, *self.derived) if e.name == name)

    def residuals_of(self, output: str) -> Array:
        """Return measured less fitted values of one output [SI]."""
        return self.residuals[self.points.of(output)]

    def rms_of(self, output: str) -> float:
        """Return the root mean square of an output's residuals [SI]."""
        return float(np.sqrt(np.mean(self.residuals_of(output) ** 2)))

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        points = self.points
        same = ("degrees_of_freedom", "reduced_chi_square", "confidence")
        return {
            "model": points.plan.spec.key,
            "fidelity": points.plan.fidelity,
            "taken": self.taken,
            "warnings": list(self.warnings),
            "fitted": {e.name: e.value for e in self.estimates},
            "estimates": [finite(asdict(e)) for e in self.estimates],
            "correlation": finite(self.correlation.tolist()),
            "residual_correlation": self._learned.correlation,
            "confounded": list(self.confounded),
            "singular_values": list(self.singular_values),
            "residuals": self.residuals.tolist(),
            "rms": {name: self.rms_of(name) for name in points.names},
            **{name: getattr(self, name) for name in same},
            "point": (points.row + 1).tolist(),
            "output": list(points.output),
            "measured": points.value.tolist(),
            "computed": self.fitted.tolist(),
            "error": None if points.error is None else points.error.tolist(),
        }

    def _columns(self) -> dict[str, Any]:
        """Return a row for each measured value, with the inputs of its point."""
        points = self.points
        inputs = {s.name: points.input(s.name) for s in points.plan.spec.inputs}
        values = {"measured": points.value, "computed": self.fitted, "residual": self.residuals}
        error = {} if points.error is None else {"error": points.error}
        return {"point": points.row + 1, **inputs, "output": list(points.output), **values, **error}

    def _words(self) -> dict[str, Words]:
        return words_at_points(find_model(self.points.plan.spec.key))

    def _card(self) -> Card:
        known, notes = self._words(), [_size_text(self), *texts(self.remarks, "note")]
        lines = [
            Line(e.name, _value_text(e), _told(e, known.get(e.name, Words()).help, self.confidence))
            for e in (*self.estimates, *self.derived)
        ]
        return Card(f"calibration of the {self.points.plan.spec.key}", lines, notes, self.warnings)

    def shown(self) -> list[Series]:
        """Return the outputs to be drawn over their inputs."""
        points, found = self.points, []
        slopes = self._problem.slopes_of_curve(self._best)
        half = np.array([self._learned.half_width_of(row) for row in slopes])
        for name, unit in output_units(points.plan.spec).items():
            if name in points.names:
                at, known = points.of(name), points.error
                error = None if known is None else known[at]
                inputs = {n: (u, x[at]) for n, (u, x) in self._drawn_over(name).items()}
                values = (points.value[at], error, self.fitted[at], half[at])
                found.append(Series(name, unit, inputs, *values))
        return found

    def curve_over(self, output: str, over: str, own: NDArray[np.bool_]) -> Series | None:
        """Return an output close enough for a curve over one input, the others at their means.

        ``own``: which of the output's values it leads through. None where they lie on no one
        curve, or where solving more points takes long.
        """
        points, plan = self.points, self.points.plan
        rows = plan.inputs[points.row[points.of(output)][own]]
        names = [s.name for s in plan.spec.inputs]
        if not find_model(plan.spec.key).quick or len(plan.params) > 1 or over not in names:
            return None
        place = names.index(over)
        others = np.delete(rows, place, axis=1)
        if np.any(np.ptp(others, axis=0) > STEADY * np.abs(others).max(axis=0)):
            return None
        inputs = closer(rows, place)
        return self._curve(output, over, inputs[:, place], inputs, own)

    def _curve(
        self, output: str, over: str, places: Array, inputs: Array, own: NDArray[np.bool_]
    ) -> Series | None:
        """Return an output with its band at inputs (n, inputs); None where one has no solution."""
        points, problem = self.points, self._problem
        dense = points_at(points, inputs, (output,))
        none = np.zeros(len(places))
        problem = replace(problem, measured=none, weight=none + 1.0, kept={}, **self._law_at(dense))
        computed = problem.curve(self._best)
        if not np.isfinite(computed).all():
            return None
        half = [self._learned.half_width_of(row) for row in problem.slopes_of_curve(self._best)]
        known, at = self._drawn_over(output).items(), points.of(output)
        shown = {n: (u, np.full(len(places), x[at][own].mean())) for n, (u, x) in known}
        shown[over] = shown[over][0], places
        unit = output_units(points.plan.spec)[output]
        return Series(output, unit, shown, none, None, computed, np.array(half))

    def _law_at(self, points: Measured) -> dict[str, Any]:
        """Return what computes the outputs at other points, and their derivatives."""
        return {"computed": points.values, "exact_slopes": points.slopes}

    def _drawn_over(self, output: str) -> Mapping[str, tuple[str, Array]]:
        """Return unit and values (n,) of what an output is drawn over."""
        return self.points.drawn_over(output)

    def __str__(self) -> str:
        """Return the calibration in sentences and one table."""
        terms, lines = self._problem.terms, [f"WARNING. {text}" for text in self.warnings]
        reasons = dict.fromkeys(e.reason for e in self.estimates if e.reason)
        lines.append(_size_text(self))
        if self.taken:
            lines.append(f"{self.taken[0].upper()}{self.taken[1:]}.")
        for text in self.confounded:
            if " apart" in text and text not in " ".join(reasons):
                lines.append(f"Together: {text}.")
        if self.reduced_chi_square is not None:
            lines.append(_chi_text(self, self.reduced_chi_square))
        lines += [_row(e, self.confidence) for e in self.estimates]
        if self.derived:
            lines += ["Follow from these:", *(_row(e, self.confidence) for e in self.derived)]
        for reason in reasons:
            names = [e.name for e in self.estimates if e.reason == reason]
            lines.append(f"{', '.join(names)}: {reason}.")
        lines += [*filter(None, map(_curved, self.estimates)), *texts(self.remarks, "note")]
        errors = terms.error_name if self._problem.known_errors else "the points' scatter"
        doubt = f"; they suppose a {terms.law} that can follow the points" if self.warnings else ""
        return "\n".join(
            [*lines, f"Intervals: linearised covariance with {errors}{doubt}.", *_widened(self)]
        )


def closer(rows: Array, place: int) -> Array:
    """Return rows over the range of one column, closer where its values are; means of the rest."""
    values = rows[:, place]
    even = np.linspace(values.min(), values.max(), DENSE)
    places = np.union1d(even, np.quantile(values, np.linspace(0.0, 1.0, DENSE)))
    found = np.tile(rows.mean(axis=0), (len(places), 1))
    found[:, place] = places
    return found


def remarks(warnings: Iterable[str], notes: Iterable[str] = ()) -> tuple[Remark, ...]:
    """Return warnings, then notes."""
    return (*(Remark("warning", w) for w in warnings), *(Remark("note", n) for n in notes))


def _widened(found: Calibration) -> list[str]:
    """Say by what factor the intervals are wider as residuals follow each other."""
    learned = found._learned
    if not learned.correlation:
        return []
    n, factor = len(found.residuals), learned.widened
    return [
        f"Neighbouring residuals have a correlation of {learned.correlation:.2f}: the intervals "
        f"are {factor:.2g} times as wide, as if {n / factor**2:.0f} of {n} values counted."
    ]


def _size_text(found: Calibration) -> str:
    """Say how many constants were fitted to what, and how well."""
    points, units = found.points, output_units(found.points.plan.spec)
    parts = ", ".join(f"{points.output.count(name)} {name}" for name in points.names)
    terms = found._problem.terms
    level = f", fidelity level {terms.fidelity}" if terms.fidelity else ""
    rms = (f"{found.rms_of(n):.3g} {units[n]}".removesuffix(" 1") for n in points.names)
    return (
        f"{counted(len(found.estimates), 'constant')} fitted to "
        f"{counted(len(points.value), terms.counted_as)} ({parts}){points.pieces_text}"
        f"{level}, rms residual {', '.join(rms)}, "
        f"{counted(found.degrees_of_freedom, 'degree')} of freedom."
    )


def _value_text(e: Estimate) -> str:
    """Return value and standard error in the unit that a person reads."""
    unit, size = display_unit(e.value, e.unit)
    error = f" +- {e.standard_error / size:.2g}" if e.identifiable else ""
    return f"{e.value / size:.5g}{error} {unit}".removesuffix(" 1")


def _told(e: Estimate, help: str, confidence: float) -> str:
    """Return what an estimate is, and what the points tell of it."""
    unit, size = display_unit(e.value, e.unit)
    low, high = (end / size for end in e.interval)
    interval = f"{100 * confidence:g} %: {spanned(low, high)} {unit}".removesuffix(" 1")
    return "; ".join(filter(None, (help, interval if e.identifiable else "", e.reason)))


def spanned(low: float, high: float) -> str:
    """Return an interval with enough digits to show its width; "a +- b" if it is very narrow."""
    width, size = high - low, max(abs(low), abs(high))
    if not width > NARROW * size:
        return f"{0.5 * (low + high):.10g} +- {0.5 * width:.2g}"
    digits = max(4, 2 - math.floor(math.log10(width / size)))
    return f"{low:.{digits}g} .. {high:.{digits}g}"


def _row(e: Estimate, confidence: float) -> str:
    unit = "" if e.unit == "1" else f" {e.unit}"
    row = f"  {e.name:18} {e.value:<10.5g}{unit:4}  "
    if not e.identifiable:
        return (
            row
            + (f"at its {e.at_bound} bound; " * bool(e.at_bound))
            + "not determined by these points"
        )
    share = f"{100 * confidence:g} %: {spanned(*e.interval)}{unit}"
    return f"{row}+- {e.standard_error:<9.2g}  {share}"


def _chi_text(found: Calibration, reduced: float) -> str:
    """Say whether the given errors explain the residuals."""
    from scipy.stats import chi2

    chance = float(chi2.sf(reduced * found.degrees_of_freedom, found.degrees_of_freedom))
    terms = found._problem.terms
    name = terms.error_name
    text = f"Reduced chi-square {reduced:.3g}: the residuals are "
    if chance < 0.01:
        return (
            f"{text}larger than {name} allows; the {terms.law} does not fit, or the "
            "errors are too small and so are the intervals."
        )
    if chance > 0.99:
        return f"{text}smaller than {name} says; it may be too large."
    return f"{text}as large as {name} says."


def _curved(e: Estimate) -> str:
    width, ends = e.interval[1] - e.interval[0], e.profile_interval or e.interval
    if all(abs(a - b) <= CURVED * width for a, b in zip(e.interval, ends, strict=True)):
        return ""
    return f"{e.name}: the profile interval {spanned(*ends)} differs; trust it more."
