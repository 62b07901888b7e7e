"""A fit and what the points tell of it: values, intervals, verdicts."""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...errors import ParameterError, suggestion
from ...numerics.jit import Array
from .estimates import Estimate
from .identifiability import Information, Verdict, combination, information, verdicts
from .least_squares import FitProblem, best_fit, profile_end, settled


class Asked(NamedTuple):
    """What is to be fitted to points, and how it is told; see ``calibrate``."""

    fit: Sequence[str] | None
    columns: Collection[str]
    """Of the data."""
    at: Collection[str]
    bounds: Mapping[str, tuple[float, float]]
    confidence: float
    profile: bool | None
    ran: Callable[[], None] = lambda: None
    """Called after each evaluation of all points."""


USUAL = ("friction_scale", "roughness")  # what a first fit is for


def chosen_names(
    fit: Sequence[str], known: Sequence[str], words: str, columns: Collection[str] = ()
) -> tuple[str, ...]:
    """Return the names to fit, or say which one cannot be; ``words`` say what is allowed."""
    names = (fit,) if isinstance(fit, str) else tuple(fit)
    if not names:
        such = next((n for n in USUAL if n in known), "")
        example = f", such as {such!r}" if such else ""
        raise ParameterError(f"fit names nothing, allowed: {words}{example}")
    for name in names:
        if name not in known:
            hint = suggestion(str(name), known, "did you mean {}? ")
            raise ParameterError(f"fit = {name!r}, {hint}allowed: {words}")
        if names.count(name) > 1:
            raise ParameterError(f"fit names {name} twice")
        if name in columns:
            raise ParameterError(f"fit = {name!r}: is a column of the data, allowed: one of both")
    return names


def fitted(
    problem: FitProblem, first: Array, confidence: float, profile: bool
) -> tuple[dict[str, Any], list[Verdict]]:
    """Return what a ``Calibration`` says of the constants, and the verdicts.

    ``first`` are the values before the fit; constants not determined stay near them.
    """
    if not isinstance(confidence, int | float) or not 0.0 < confidence < 1.0:
        raise ParameterError(f"confidence = {confidence!r}, allowed: above 0 and below 1")
    best, learned, judged = _settled(problem, first, confidence)
    computed = problem.curve(best)
    residuals = problem.measured - computed
    is_judged = problem.known_errors and learned.freedom > 0
    found = {
        "fitted": computed,
        "estimates": tuple(
            _estimate(problem, best, learned, i, verdict, profile)
            for i, verdict in enumerate(judged)
        ),
        "correlation": learned.correlations(),
        "confounded": tuple(combination(problem, best, way) for way in learned.blurred()),
        "singular_values": tuple(learned.strength.tolist()),
        "residuals": residuals,
        "rms": float(np.sqrt(np.mean(residuals**2))),
        "degrees_of_freedom": learned.freedom,
        "reduced_chi_square": problem.cost(best) / learned.freedom if is_judged else None,
        "confidence": float(confidence),
        "_problem": problem,
        "_best": best,
        "_learned": learned,
    }
    return found, judged


def _settled(
    problem: FitProblem, first: Array, confidence: float
) -> tuple[Array, Information, list[Verdict]]:
    """Return the fit, its information, the verdicts; what is not known stays near ``first``."""
    best, weak = best_fit(problem, first), np.zeros(len(first))
    learned = information(problem, best, confidence)
    judged = verdicts(problem, best, learned, weak)
    if not all(verdict.identifiable for verdict in judged):  # nothing may depend on it there
        lost = [not verdict.identifiable for verdict in judged]
        middle = np.where(lost, 0.5 * (problem.low + problem.high), best)
        best = best_fit(problem, first, [middle])
        learned = information(problem, best, confidence)
    deviation = learned.deviation
    for _ in problem.names:
        judged = verdicts(problem, best, learned, np.zeros(len(best)))
        now = np.maximum(weak, [0.0 if verdict.identifiable else 1.0 for verdict in judged])
        if np.array_equal(now, weak):
            break
        weak = now
        best = settled(problem, best, first, weak, deviation)
        learned = information(problem, best, confidence)
    return best, learned, verdicts(problem, best, learned, weak)


def _estimate(
    problem: FitProblem, best: Array, learned: Information, i: int, verdict: Verdict, profile: bool
) -> Estimate:
    """Return value, error and intervals of one constant."""

    def shown(place: float) -> float:
        return float(problem.shown(np.where(np.arange(len(best)) == i, place, best))[i])

    name, value, half = problem.names[i], float(best[i]), verdict.half_width
    low, high = float(problem.low[i]), float(problem.high[i])
    error = half / learned.quantile if np.isfinite(learned.quantile) else np.inf
    ends = None
    if verdict.identifiable:
        low, high = max(low, value - half), min(high, value + half)
        if profile and learned.deviation > 0.0 and half > 1e-9 * problem.scale[i]:
            rise = (learned.quantile * learned.deviation * learned.widened) ** 2
            lower, upper = (
                shown(profile_end(problem, best, i, value + side * half, rise))
                for side in (-1.0, 1.0)
            )
            ends = (lower, upper)
    error *= float(problem.derivative(best)[i])
    interval, judged = (shown(low), shown(high)), (verdict.identifiable, verdict.at_bound)
    unit = problem.quantities[i].unit
    return Estimate(name, unit, shown(value), error, interval, ends, *judged, verdict.reason)
