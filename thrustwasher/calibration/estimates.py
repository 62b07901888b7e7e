"""A calibration as it comes out: numbers, sentences, plain data."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ..numerics.jit import Array
from ..storage.digests import finite
from .identifiability import Information, counted
from .least_squares import Problem

NARROW = 1e-8  # relative width below which the ends of an interval would need too many digits
CURVED = 0.2  # of the width: ends of the two intervals further apart are worth a word


@dataclass(frozen=True, slots=True)
class Estimate:
    """One fitted number with its uncertainty, SI units."""

    name: str
    unit: str
    value: float
    standard_error: float
    """Infinite where the points do not tell it."""
    interval: tuple[float, float]
    """Linearised, within the allowed range; that whole range if not identifiable."""
    profile_interval: tuple[float, float] | None
    """From the rise of the sum of squares, the other constants refitted; None if not computed."""
    identifiable: bool
    at_bound: str
    """ "lower", "upper" or "" (inside the allowed range)."""
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
class Calibration:
    """Parameters fitted to measurements; ``str()`` of it is a summary in sentences."""

    params: Any
    """The part with the fitted values, to solve and for FMUs."""
    estimates: tuple[Estimate, ...]
    """In the order of ``fit``."""
    correlation: Array
    """(constants, constants); NaN where a constant is not told."""
    confounded: tuple[str, ...]
    """Combinations of constants that the points cannot tell apart, a sentence each."""
    singular_values: tuple[float, ...]
    """Of the scaled derivatives over the scatter, falling; 0: nothing is known of a direction."""
    residuals: Array
    """(n,) measured less fitted value [SI unit of its output]."""
    rms: float
    """Of the residuals [SI]; it has a unit where one output is fitted, ``rms_of`` tells each."""
    degrees_of_freedom: int
    reduced_chi_square: float | None
    """None without given errors."""
    confidence: float
    warnings: tuple[str, ...] = ()
    """Sentences on points that the law cannot follow, the gravest first; empty for a sound fit."""
    _problem: Any = field(repr=False)
    _best: Array = field(repr=False)
    _told: Information = field(repr=False)

    @property
    def all_estimates(self) -> tuple[Estimate, ...]:
        """The fitted constants, and what follows from them."""
        return self.estimates

    def __getitem__(self, name: str) -> Estimate:
        """Return the estimate of one constant."""
        return next(e for e in self.all_estimates if e.name == name)

    def as_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        return {
            "warnings": list(self.warnings),
            "fitted": {e.name: e.value for e in self.estimates},
            "estimates": [finite(asdict(e)) for e in self.estimates],
            "correlation": finite(self.correlation.tolist()),
            "confounded": list(self.confounded),
            "singular_values": list(self.singular_values),
            "residuals": self.residuals.tolist(),
            "rms": self.rms,
            "degrees_of_freedom": self.degrees_of_freedom,
            "reduced_chi_square": self.reduced_chi_square,
            "confidence": self.confidence,
        }

    def summary(self) -> list[str]:
        """Return sentences on what was fitted to what."""
        raise NotImplementedError

    def shown(self) -> list[Series]:
        """Return the outputs to be drawn."""
        raise NotImplementedError

    def series(
        self,
        name: str,
        unit: str,
        inputs: Mapping[str, tuple[str, Array]],
        chosen: Any = slice(None),
    ) -> Series:
        """Return one output to be drawn, of the values chosen."""
        problem, best = self._problem, self._best
        half = [self._told.half_width_of(row) for row in problem.slopes_of_curve(best)[chosen]]
        error = 1.0 / problem.weight[chosen] if problem.known_errors else None
        return Series(name, unit, inputs, problem.measured[chosen], error,
                      problem.curve(best)[chosen], np.array(half))  # fmt: skip

    def remarks(self) -> list[str]:
        """Return sentences on what else the points tell."""
        return []

    def __str__(self) -> str:
        """Return the calibration in sentences and one table."""
        share, problem = f"{100 * self.confidence:g} %", self._problem
        lines = [f"WARNING. {text}" for text in self.warnings] + self.summary()
        if self.reduced_chi_square is not None:
            lines.append(_chi_text(self, problem))
        lines += [_row(e, share) for e in self.all_estimates]
        for reason in dict.fromkeys(e.reason for e in self.estimates if e.reason):
            names = [e.name for e in self.estimates if e.reason == reason]
            lines.append(f"{', '.join(names)}: {reason}.")
        lines += filter(None, map(_curved, self.estimates))
        lines += self.remarks()
        errors = "the given errors" if problem.known_errors else "the points' scatter"
        doubt = "; they suppose a law that can follow the points" if self.warnings else ""
        lines.append(f"Intervals: linearised covariance with {errors}{doubt}.")
        return "\n".join(lines)


def size_text(found: Calibration, fitted_to: str, rms: str) -> str:
    """Say how many constants were fitted to what, and how well."""
    return (
        f"{counted(len(found.estimates), 'constant')} fitted to {fitted_to}, rms residual {rms}, "
        f"{counted(found.degrees_of_freedom, 'degree')} of freedom."
    )


def spanned(low: float, high: float) -> str:
    """Return an interval with enough digits to show its width; "a +- b" if it is very narrow."""
    width, size = high - low, max(abs(low), abs(high))
    if not width > NARROW * size:
        return f"{0.5 * (low + high):.10g} +- {0.5 * width:.2g}"
    digits = max(4, 2 - math.floor(math.log10(width / size)))
    return f"{low:.{digits}g} .. {high:.{digits}g}"


def _row(e: Estimate, share: str) -> str:
    unit = "" if e.unit == "1" else f" {e.unit}"
    if not e.identifiable:
        bound = f"at its {e.at_bound} bound; " if e.at_bound else ""
        return f"  {e.name:18} {e.value:<10.5g}{unit:4}  {bound}not told by these points"
    return (
        f"  {e.name:18} {e.value:<10.5g}{unit:4}  +- {e.standard_error:<9.2g}"
        f"  {share}: {spanned(*e.interval)}{unit}"
    )


def _chi_text(found: Calibration, problem: Problem) -> str:
    """Say whether the given errors explain the residuals."""
    from scipy.stats import chi2

    reduced, freedom = found.reduced_chi_square or 0.0, found.degrees_of_freedom
    chance = float(chi2.sf(reduced * freedom, freedom))
    text, errors = f"Reduced chi-square {reduced:.3g}", problem.error_name
    if chance < 0.01:
        return (
            f"{text}: the residuals are larger than {errors} allows; the law does not fit, "
            "or the errors are too small and so are the intervals."
        )
    if chance > 0.99:
        return text + f": the residuals are smaller than {errors} says; it may be too large."
    return text + f": the residuals are as large as {errors} says."


def _curved(e: Estimate) -> str:
    width, ends = e.interval[1] - e.interval[0], e.profile_interval or e.interval
    if all(abs(a - b) <= CURVED * width for a, b in zip(e.interval, ends, strict=True)):
        return ""
    return f"{e.name}: the profile interval {spanned(*ends)} differs; trust it more."
