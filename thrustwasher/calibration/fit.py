"""A fit and what the points tell of it: values, intervals, verdicts."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import ParameterError, suggestion
from ..numerics.jit import Array
from .estimates import Estimate
from .identifiability import Information, Verdict, combination, information, verdicts
from .least_squares import Problem, best_fit, profile_end, settled


def chosen_names(fit: Sequence[str], known: Sequence[str], words: str) -> tuple[str, ...]:
    """Return the names to fit, or say which one cannot be; ``words`` say what is allowed."""
    names = (fit,) if isinstance(fit, str) else tuple(fit)
    if not names:
        raise ParameterError(f"fit names nothing, allowed: {words}")
    for name in names:
        if name not in known:
            hint = suggestion(str(name), known, "did you mean {}? ")
            raise ParameterError(f"fit = {name!r}, {hint}allowed: {words}")
        if names.count(name) > 1:
            raise ParameterError(f"fit names {name} twice")
    return names


def fitted(
    problem: Problem, first: Array, confidence: float, profile: bool
) -> tuple[dict[str, Any], list[Verdict]]:
    """Return the fields of a ``Calibration`` but its parameters, and the verdicts.

    ``first`` are the values before the fit; constants not told stay near them.
    """
    if not isinstance(confidence, int | float) or not 0.0 < confidence < 1.0:
        raise ParameterError(f"confidence = {confidence!r}, allowed: above 0 and below 1")
    best, told, judged = _settled(problem, first, confidence)
    residuals = problem.measured - problem.curve(best)
    chi = problem.cost(best) / told.freedom if told.freedom > 0 else None
    found = {
        "estimates": tuple(
            _estimate(problem, best, told, i, verdict, profile) for i, verdict in enumerate(judged)
        ),
        "correlation": _correlation(problem, told),
        "confounded": tuple(combination(problem, best, way) for way in told.blurred()),
        "singular_values": tuple(told.strength.tolist()),
        "residuals": residuals,
        "rms": float(np.sqrt(np.mean(residuals**2))),
        "degrees_of_freedom": told.freedom,
        "reduced_chi_square": chi if problem.known_errors else None,
        "confidence": float(confidence),
        "_problem": problem, "_best": best, "_told": told,
    }  # fmt: skip
    return found, judged


def _settled(
    problem: Problem, first: Array, confidence: float
) -> tuple[Array, Information, list[Verdict]]:
    """Return the fit, what it tells, and the verdicts; constants not told stay near their first."""
    best = best_fit(problem, first)
    told = information(problem, best, confidence)
    lost = [not verdict.identifiable for verdict in verdicts(problem, best, told)]
    if any(lost):  # it may have started where nothing depends on it
        middle = np.where(lost, 0.5 * (problem.low + problem.high), best)
        best = best_fit(problem, first, [middle])
        told = information(problem, best, confidence)
    deviation = told.deviation
    weak = np.zeros(len(best))
    for _ in problem.names:
        judged = verdicts(problem, best, told)
        now = np.maximum(weak, [0.0 if verdict.identifiable else 1.0 for verdict in judged])
        if np.array_equal(now, weak):
            break
        weak = now
        best = settled(problem, best, first, weak, deviation)
        told = information(problem, best, confidence)
    return best, told, verdicts(problem, best, told, weak)


def _estimate(
    problem: Problem, best: Array, told: Information, i: int, verdict: Verdict, profile: bool
) -> Estimate:
    """Return value, error and intervals of one constant."""

    def shown(place: float) -> float:
        return float(problem.shown(np.where(np.arange(len(best)) == i, place, best))[i])

    name, value = problem.names[i], float(best[i])
    low, high = float(problem.low[i]), float(problem.high[i])
    error = verdict.half_width / told.quantile if np.isfinite(told.quantile) else np.inf
    interval, ends = (shown(low), shown(high)), None
    if verdict.identifiable:
        half = verdict.half_width
        interval = (shown(max(low, value - half)), shown(min(high, value + half)))
        if profile and told.deviation > 0.0 and half > 1e-9 * problem.scale[i]:
            rise = (told.quantile * told.deviation) ** 2
            lower, upper = (
                shown(profile_end(problem, best, i, value + side * half, rise))
                for side in (-1.0, 1.0)
            )
            ends = (lower, upper)
    return Estimate(
        name, problem.units[name], shown(value), float(error * problem.stretch(best)[i]), interval,
        ends, verdict.identifiable, verdict.at_bound, verdict.reason,
    )  # fmt: skip


def _correlation(problem: Problem, told: Information) -> Array:
    """Return the correlation of the constants that are told, NaN for the others."""
    count = len(problem.names)
    known = [np.isfinite(told.error_of(row)) for row in np.eye(count)]
    covariance = told.covariance()
    width = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    matrix = covariance / np.outer(width, width)
    matrix[~np.outer(known, known)] = np.nan
    return np.asarray(matrix)
