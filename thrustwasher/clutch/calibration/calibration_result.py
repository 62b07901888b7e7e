"""A friction law fitted to measurements: numbers, sentences, plain data."""

import math
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.jit import Array
from ...storage.digests import finite
from ..parameters import ClutchParams
from .friction_law import friction_slopes
from .identifiability import Information, LoadTest, counted
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


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """A friction law fitted to measurements; ``str()`` of it is a summary in sentences."""

    params: ClutchParams
    """The pack with the fitted values, for solve_clutch and FMUs."""
    estimates: tuple[Estimate, ...]
    """In the order of ``fit``."""
    end_frictions: tuple[Estimate, ...]
    """Coefficient at rest and at very high slip: often told where single constants are not."""
    correlation: Array
    """(constants, constants); NaN where a constant is not told."""
    confounded: tuple[str, ...]
    """Combinations of constants that the points cannot tell apart, a sentence each."""
    residuals: Array
    """(points,) measured less fitted coefficient."""
    rms: float
    degrees_of_freedom: int
    reduced_chi_square: float | None
    """None without ``friction_error``."""
    load_test: LoadTest
    warnings: tuple[str, ...]
    """Sentences on points that the law cannot follow, the gravest first; empty for a sound fit."""
    confidence: float
    _problem: Problem = field(repr=False)
    _best: Array = field(repr=False)
    _told: Information = field(repr=False)

    @property
    def friction(self) -> Array:
        """(points,) measured coefficient, less the shear that was taken off."""
        return self._problem.friction

    def __getitem__(self, name: str) -> Estimate:
        """Return the estimate of one constant."""
        return next(e for e in (*self.estimates, *self.end_frictions) if e.name == name)

    def band(self, slip_speed: ArrayLike) -> tuple[Array, Array]:
        """Return (coefficient, half width of its confidence band) at slip speeds [m/s].

        The half width is infinite where the points do not tell the curve; so it is below the
        slowest point if the corner at stick_speed may lie there.
        """
        speed = np.abs(np.atleast_1d(np.asarray(slip_speed, float)))
        problem, told = self._problem, self._told
        curve = problem.curve(self._best, speed)
        rows = friction_slopes(problem.values(self._best), speed, problem.names)
        if not np.isfinite(told.quantile):
            return curve, np.full(speed.shape, np.inf)
        half = told.quantile * np.array([told.error_of(row) for row in rows])
        if any(e.name == "stick_speed" and not e.identifiable for e in self.estimates):
            half[speed < problem.speed.min()] = np.inf
        return curve, half

    def as_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        load = asdict(self.load_test) | {"is_significant": self.load_test.is_significant}
        return {
            "warnings": list(self.warnings),
            "friction_data": self.params.friction_data,
            "fitted": {e.name: e.value for e in self.estimates},
            "estimates": [finite(asdict(e)) for e in self.estimates],
            "end_frictions": [finite(asdict(e)) for e in self.end_frictions],
            "correlation": finite(self.correlation.tolist()),
            "confounded": list(self.confounded),
            "residuals": self.residuals.tolist(),
            "rms": self.rms,
            "degrees_of_freedom": self.degrees_of_freedom,
            "reduced_chi_square": self.reduced_chi_square,
            "load_test": load,
            "confidence": self.confidence,
        }

    def __str__(self) -> str:
        """Return the calibration in sentences and one table."""
        return "\n".join(_sentences(self))


def spanned(low: float, high: float) -> str:
    """Return an interval with enough digits to show its width; "a +- b" if it is very narrow."""
    width, size = high - low, max(abs(low), abs(high))
    if not width > NARROW * size:
        return f"{0.5 * (low + high):.10g} +- {0.5 * width:.2g}"
    digits = max(4, 2 - math.floor(math.log10(width / size)))
    return f"{low:.{digits}g} .. {high:.{digits}g}"


def _sentences(found: Calibration) -> list[str]:
    count, share = len(found.residuals), f"{100 * found.confidence:g} %"
    lines = [f"WARNING. {text}" for text in found.warnings]
    lines.append(
        f"{counted(len(found.estimates), 'constant')} fitted to {counted(count, 'point')}, rms "
        f"residual {found.rms:.3g}, {counted(found.degrees_of_freedom, 'degree')} of freedom."
    )
    if found.params.friction_data == "total":
        lines.append("Points and law: total friction of a settled pack, shear of its oil included.")
    else:
        lines.append("Law: asperities alone; the settled film's shear was taken off the points.")
    if found.reduced_chi_square is not None:
        lines.append(_chi_text(found))
    lines += [_row(e, share) for e in (*found.estimates, *found.end_frictions)]
    for reason in dict.fromkeys(e.reason for e in found.estimates if e.reason):
        names = [e.name for e in found.estimates if e.reason == reason]
        lines.append(f"{', '.join(names)}: {reason}.")
    lines += filter(None, map(_curved, found.estimates))
    lines.append(f"Load: {found.load_test.text}.")
    if found.params.shear_temperature_slope != 0.0:
        warm = found.params.reference_temperature
        lines.append(
            f"Temperature: the points count as measured at reference_temperature ({warm:g} K); "
            "shear_temperature_slope acts away from it."
        )
    lines.append(
        "Intervals: linearised covariance with "
        + ("the given errors" if found.reduced_chi_square is not None else "the points' scatter")
        + ("; they suppose a law that can follow the points." if found.warnings else ".")
    )
    return lines


def _row(e: Estimate, share: str) -> str:
    unit = "" if e.unit == "1" else f" {e.unit}"
    if not e.identifiable:
        bound = f"at its {e.at_bound} bound; " if e.at_bound else ""
        return f"  {e.name:18} {e.value:<10.5g}{unit:4}  {bound}not told by these points"
    return (
        f"  {e.name:18} {e.value:<10.5g}{unit:4}  +- {e.standard_error:<9.2g}"
        f"  {share}: {spanned(*e.interval)}{unit}"
    )


def _chi_text(found: Calibration) -> str:
    """Say whether the given errors explain the residuals."""
    from scipy.stats import chi2

    reduced, freedom = found.reduced_chi_square or 0.0, found.degrees_of_freedom
    chance = float(chi2.sf(reduced * freedom, freedom))
    text = f"Reduced chi-square {reduced:.3g}"
    if chance < 0.01:
        return (
            f"{text}: the residuals are larger than friction_error allows; the law does not fit, "
            "or the errors are too small and so are the intervals."
        )
    if chance > 0.99:
        return text + ": the residuals are smaller than friction_error says; it may be too large."
    return text + ": the residuals are as large as friction_error says."


def _curved(e: Estimate) -> str:
    width, ends = e.interval[1] - e.interval[0], e.profile_interval or e.interval
    if all(abs(a - b) <= CURVED * width for a, b in zip(e.interval, ends, strict=True)):
        return ""
    return f"{e.name}: the profile interval {spanned(*ends)} differs; trust it more."
