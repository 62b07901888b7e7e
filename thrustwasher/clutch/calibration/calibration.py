"""Fit the clutch's friction law to measured friction, and say what the points can tell."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ParameterError, suggestion
from ...model.prepare import course_of
from ...numerics.jit import Array
from ..parameters import LOAD, OIL, SPEED, ClutchParams
from . import friction_law as law
from .calibration_result import Calibration, Estimate
from .data_warnings import warnings
from .identifiability import Information, Verdict, combination, information, load_test, verdicts
from .least_squares import Problem, best_fit, bounds_of, profile_end, settled

__all__ = ["Calibration", "Estimate", "calibrate"]

LARGEST_FRICTION = 2.0
SPEEDS = ("stick_speed", "decay_speed")
DEFAULT_FIT = ("plough_weight", "shear_floor", "stick_speed", "decay_speed")


def calibrate(
    params: ClutchParams,
    *,
    speed: ArrayLike,
    load: ArrayLike,
    friction: ArrayLike,
    friction_error: ArrayLike | None = None,
    oil_temperature: ArrayLike | None = None,
    fit: Sequence[str] = DEFAULT_FIT,
    confidence: float = 0.95,
    profile: bool = True,
) -> Calibration:
    """Fit constants of the friction law to measured coefficients of friction.

    The law's curve over slip speed is mu_inf + (mu_0 - mu_inf) e(v; stick_speed, decay_speed), with
    mu_0 = k P(x) + D(x, N) and mu_inf = k P(x) + D(x, N) S_inf. So the best of measurements tells
    four numbers, and plough_weight k, shear_floor S_inf, hardness_ratio N and indentation x act
    through two of them: at most two of these four can be fitted at once. Load does not act at all.

    Parameters
    ----------
    params : the pack: its friction radius, the constants that are not fitted, the first guess; its
        ``friction_data`` says what the law describes. "total": the points as they are. "boundary":
        the points less the shear of the settled film. A table gives way to the law
    speed : (points,) slip [rad/s]; the sign does not matter
    load : (points,) or one value [N], above 0; used to test that friction does not depend on it
    friction : (points,) measured coefficient of friction [-]
    friction_error : (points,) or one value, standard deviation of ``friction``; without it the
        scatter of the residuals is taken
    oil_temperature : (points,) or one value [K]; wanted for friction_data "boundary" alone
    fit : names of constants: plough_weight, shear_floor, stick_speed, decay_speed, hardness_ratio,
        indentation; constant_friction alone under friction_law "constant"
    confidence : probability of the intervals, above 0 and below 1
    profile : also compute profile intervals (a tenth of a second or so)

    Returns
    -------
    Calibration : fitted ``params`` and, for every constant, value, interval and verdict; points
        that the law cannot follow are no error but ``warnings``

    Raises
    ------
    ParameterError : wrong shapes, numbers out of range, unknown names
    SolveError : no starting point led to a fit

    Notes
    -----
    Source of the law: Wang, Wei & Wu (2012), Eq 12; the speed law is this package's (see
    docs/theory/calibration.md, also for the method). Intervals are from the linearised covariance:
    Student's distribution on the scatter of the residuals, or the normal one on ``friction_error``.

    Examples
    --------
    >>> import numpy as np
    >>> from thrustwasher import solve_clutch
    >>> slip = np.linspace(5.0, 150.0, 30)
    >>> truth = ClutchParams(friction_law="wang", plough_weight=0.2, decay_speed=2.0)
    >>> mu = [solve_clutch(truth, load=5e3, speed=w).friction_coefficient for w in slip]
    >>> found = calibrate(ClutchParams(), speed=slip, load=5e3, friction=mu)
    >>> round(found.params.plough_weight, 6), round(found.params.decay_speed, 6)
    (0.2, 2.0)
    """
    if params.friction_law == "table":
        params = replace(params, friction_law="wang")
    names = checked_names(params, fit)
    problem = checked_problem(params, names, speed, load, friction, friction_error)
    if params.friction_data == "boundary":
        problem = _of_asperities(params, problem, speed, oil_temperature)
    if not isinstance(confidence, int | float) or not 0.0 < confidence < 1.0:
        raise ParameterError(f"confidence = {confidence!r}, allowed: above 0 and below 1")
    first = np.array([problem.base[name] for name in names])
    best, told, judged = _settled(problem, first, confidence)
    values = problem.values(best)
    changes: dict[str, Any] = {name: values[name] for name in names}
    residuals = problem.friction - problem.curve(best)
    chi = problem.cost(best) / told.freedom if told.freedom > 0 else None
    return Calibration(
        params=replace(params, **changes),
        estimates=tuple(
            _estimate(problem, best, told, i, verdict, profile)
            for i, verdict in enumerate(judged)
        ),
        end_frictions=() if names == law.CONSTANT_LAW else _end_estimates(problem, best, told),
        correlation=_correlation(problem, told),
        confounded=tuple(combination(problem, direction) for direction in told.blurred()),
        residuals=residuals,
        rms=float(np.sqrt(np.mean(residuals**2))),
        degrees_of_freedom=told.freedom,
        reduced_chi_square=chi if problem.known_errors else None,
        load_test=load_test(problem, best, told),
        warnings=warnings(problem, best, first, judged),
        confidence=float(confidence),
        _problem=problem, _best=best, _told=told,
    )  # fmt: skip


def _settled(
    problem: Problem, first: Array, confidence: float
) -> tuple[Array, Information, list[Verdict]]:
    """Return the fit, what it tells, and the verdicts; constants not told stay near their first."""
    best = best_fit(problem, first)
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
    name, value = problem.names[i], float(best[i])
    low, high = float(problem.low[i]), float(problem.high[i])
    unit = next(f.metadata["unit"] for f in fields(ClutchParams) if f.name == name)
    error = verdict.half_width / told.quantile if np.isfinite(told.quantile) else np.inf
    interval, ends = (low, high), None
    if verdict.identifiable:
        interval = (max(low, value - verdict.half_width), min(high, value + verdict.half_width))
        if profile and told.deviation > 0.0 and verdict.half_width > 1e-9 * problem.scale[i]:
            rise = (told.quantile * told.deviation) ** 2
            lower, upper = (
                profile_end(problem, best, i, value + side * verdict.half_width, rise)
                for side in (-1.0, 1.0)
            )
            ends = (lower, upper)
    return Estimate(
        name, unit, value, float(error), interval, ends, verdict.identifiable,
        verdict.at_bound, verdict.reason,
    )  # fmt: skip


def _end_estimates(problem: Problem, best: Array, told: Information) -> tuple[Estimate, ...]:
    """Return the coefficients at rest and at very high slip."""
    values = problem.values(best)
    rows = law.friction_slopes(
        {**values, "stick_speed": 0.0, "kink_width": 0.0}, np.array([0.0, 1e9]), problem.names
    )
    found = []
    for name, value, row in zip(
        ("friction_at_rest", "friction_at_speed"), law.end_frictions(values), rows, strict=True
    ):
        error = told.error_of(row) if np.any(row) else 0.0
        half = error * told.quantile if np.isfinite(told.quantile) else np.inf
        known = bool(half <= value)
        interval = (max(0.0, value - half), value + half) if known else (0.0, np.inf)
        reason = "" if known else "the points do not reach it"
        found.append(Estimate(name, "1", value, float(error), interval, None, known, "", reason))
    return tuple(found)


def _correlation(problem: Problem, told: Information) -> Array:
    """Return the correlation of the constants that are told, NaN for the others."""
    count = len(problem.names)
    known = [np.isfinite(told.error_of(row)) for row in np.eye(count)]
    covariance = told.covariance()
    width = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    matrix = covariance / np.outer(width, width)
    matrix[~np.outer(known, known)] = np.nan
    return np.asarray(matrix)


def _of_asperities(
    params: ClutchParams, problem: Problem, speed: ArrayLike, oil_temperature: ArrayLike | None
) -> Problem:
    """Return the problem without the shear of the settled film."""
    if oil_temperature is None:
        raise ParameterError(
            "oil_temperature is missing, wanted with friction_data = 'boundary': shear of the oil "
            "is taken off the measured friction"
        )
    oil = course_of("oil_temperature", oil_temperature, "K", OIL.low or 0.0, OIL.high or 0.0,
                    len(problem.friction))  # fmt: skip
    shear = law.settled_shear(params, np.asarray(speed, float), problem.load, oil)
    return replace(problem, friction=law.without_shear(problem.friction, shear))


def checked_names(params: ClutchParams, fit: Sequence[str]) -> tuple[str, ...]:
    """Return the names to fit, or say which one cannot be."""
    names = (fit,) if isinstance(fit, str) else tuple(fit)
    acting = law.constants_of(params)
    allowed = f"allowed under friction_law {params.friction_law!r}: {', '.join(acting)}"
    if not names:
        raise ParameterError(f"fit names nothing, {allowed}")
    for name in names:
        if name == "load":
            raise ParameterError(
                f"fit = 'load': the friction law does not depend on load; {allowed}"
            )
        if name not in acting:
            hint = suggestion(str(name), acting, "did you mean {}? ")
            raise ParameterError(f"fit = {name!r}, {hint}{allowed}")
        if names.count(name) > 1:
            raise ParameterError(f"fit names {name} twice")
    return names


def checked_problem(
    params: ClutchParams, names: tuple[str, ...], speed: ArrayLike, load: ArrayLike,
    friction: ArrayLike, friction_error: ArrayLike | None,
) -> Problem:  # fmt: skip
    """Return what is to be solved, or name the first value that cannot be used."""
    mu = course_of("friction", friction, "1", -LARGEST_FRICTION, LARGEST_FRICTION)
    count = len(mu)
    slips = np.atleast_1d(np.asarray(speed, object))  # one speed for all tells nothing
    slip = course_of("speed", slips, "rad/s", SPEED.low or 0.0, SPEED.high or 0.0, count)
    force = course_of("load", load, "N", 0.0, LOAD.high or 0.0, count)
    weight = np.ones(count)
    if friction_error is not None:
        error = course_of("friction_error", friction_error, "1", 0.0, LARGEST_FRICTION, count)
        weight = 1.0 / _above_zero("friction_error", error)
    if mu.mean() <= 0.0:
        raise ParameterError(
            f"friction is {mu.mean():.3g} on average, allowed: above 0 (for either sign of speed)"
        )
    force, slip_speed = _above_zero("load", force, " N"), np.abs(slip) * params.friction_radius
    scale = np.where(np.isin(names, SPEEDS), float(slip_speed.max()) or 1.0, 1.0)
    if names == law.CONSTANT_LAW:
        scale[0] = float(mu.mean())
    return Problem(
        law.law_values(params), names, slip_speed, mu, force, weight, *bounds_of(names), scale,
        names == law.CONSTANT_LAW, friction_error is not None,
    )  # fmt: skip


def _above_zero(name: str, array: Array, unit: str = "") -> Array:
    """Return the array, or name its first zero."""
    if (array == 0.0).any():
        i = int(np.argmax(array == 0.0))
        raise ParameterError(f"{name}[{i}] = 0{unit}, allowed: above 0")
    return array
