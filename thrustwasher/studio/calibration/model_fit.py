"""A model's outputs over its parameters: what is fitted, and what it cannot follow."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.parameters import allowed
from ...model.quantity import of_field
from ...model.registry import find_model
from ...numerics.jit import Array
from ..evaluators.lines import check_level
from .estimates import Calibration, remarks
from .fit import Asked, chosen_names, fitted
from .identifiability import Verdict, counted
from .least_squares import FitProblem, Terms, best_fit
from .measured import Measured, output_units
from .row_groups import grouped

ModelCalibration = Calibration  # its name while a law's fit was another one
PASSES = 2  # of a fit to means, each with the curvature at the one before
DECADE = 10.0  # a range this wide, above 0, is one of logarithms
LEAST_SHARE = 0.1  # of half the range: the minimum change that would certainly matter
ELSEWHERE = "(0:"  # in the meaning of a parameter whose 0 stands for another one's value
INSIDE = 1e-13  # of a logarithmic range: rounding does not lead out of it
POOR = 0.2  # of an output's mean: an rms residual above it is always worth a warning
MATERIAL = 0.02  # of the mean: less is not worth a warning
SCATTERS = 3.0  # a value further off than this many standard deviations is off


def fit_points(points: Measured, asked: Asked) -> Calibration:
    """Return parameters of a model fitted to its outputs; many rows as means of neighbours."""
    groups = grouped(points)
    points, plan = groups.means if groups else points, points.plan
    spec = plan.spec
    part = plan.evaluator.part
    real = part.suggesting({f.name: f for f in fields(spec.params) if f.metadata["kind"] == "real"})
    names = chosen_names(asked.fit or (), real, f"real parameters of {spec.name}", asked.columns)
    if len(points.value) < len(names):
        sizes = f"{counted(len(points.value), 'value')} for {counted(len(names), 'parameter')}"
        raise ParameterError(f"data: {sizes}, allowed: as many values as parameters, or more")
    check_level(spec, plan.fidelity, plan.params[0])
    terms = Terms(fidelity=plan.fidelity)
    problem, first = problem_of(points, names, asked.bounds, terms=terms, ran=asked.ran)
    _check_first(points, problem, first)
    guess = first
    for _ in range(PASSES if groups else 0):
        assert groups is not None
        points = groups.straightened(problem.values(guess))
        problem = replace(problem, measured=points.value)
        guess = best_fit(problem, guess)
    found, judged = fitted(problem, first, asked.confidence, bool(asked.profile))
    far, poor = misses(points, problem, found["_best"], judged)
    said = [*points.plan.warnings, *_few(problem), *far, *poor]
    values = {part.flat_name(name): value for name, value in values_of(found).items()}
    params = replace(points.plan.params[0], **values)
    return Calibration(params=params, points=points, remarks=remarks(said), **found)


def problem_of(
    points: Measured,
    names: tuple[str, ...],
    bounds: Mapping[str, tuple[float, float]],
    *,
    changes: Mapping[str, float] | None = None,
    typical: float = 0.0,
    **more: Any,
) -> tuple[FitProblem, Array]:
    """Return what is to be solved and the guess before the fit.

    Parameters
    ----------
    points : what was measured, and what computes it
    names : parameters that are fitted
    bounds : narrower ranges [SI]
    changes : by name, a change [SI] that would certainly matter; of others their range says it
    typical : size of a value; 0: the mean of those measured
    more : further fields of the problem, those of ``points`` by default
    """
    metas = {f.name: f.metadata for f in fields(points.plan.spec.params)}
    for name in bounds:
        if name not in names:
            raise ParameterError(f"bounds of {name}: allowed: of {', '.join(names)}, as fitted")
    params, rows, quantities = points.plan.params[0], [], []
    part = getattr(points.plan.evaluator, "part", None)  # recordings have none: no names of a file
    own_name = part.own_name if part else str
    for name in names:
        start, change = getattr(params, name), (changes or {}).get(name, 0.0)
        rows.append(_range_of(name, metas[name], start, bounds.get(name), change))
        quantities.append(of_field(own_name(name), start, metas[name]))
    low, high, first, scale, by_logarithm = np.array(rows).T
    usual = typical or np.abs(points.value).mean() or 1.0
    even = np.full(len(points.value), 1.0 / usual)
    if points.count is not None:
        even *= np.sqrt(points.count / points.count.mean())
    own: dict[str, Any] = {"computed": points.values, "exact_slopes": points.slopes, "base": {}}
    problem = FitProblem(
        quantities=tuple(quantities),
        measured=points.value,
        weight=even if points.error is None else 1.0 / points.error,
        low=low,
        high=high,
        scale=scale,
        logarithmic=by_logarithm > 0.0,
        known_errors=points.error is not None,
        **{**own, **more},
    )
    return problem, first


def misses(
    points: Measured,
    problem: FitProblem,
    best: Array,
    judged: list[Verdict],
    scatter: Array | None = None,
    why: str = "",
) -> tuple[list[str], list[str]]:
    """Return sentences on outputs that are missed by more than the points scatter, if known.

    And on those whose residuals are a large part of the output itself. ``scatter`` (n,): where the
    errors do not tell it; ``why``: what keeps the fit from the points, if not a bound.
    """
    far, poor, units = [], [], output_units(points.plan.spec)
    residuals, law = problem.curve(best) - problem.measured, problem.terms.law
    if scatter is None and problem.known_errors:
        scatter = 1.0 / problem.weight
    instead, why = problem.terms.instead, why or _why_missed(problem, judged)
    for name in points.names:
        chosen, unit = points.of(name), f" {units[name]}".removesuffix(" 1")
        rms = float(np.sqrt(np.mean(residuals[chosen] ** 2)))
        mean = float(np.abs(problem.measured[chosen]).mean()) or 1.0
        usual = np.inf if scatter is None else float(np.sqrt(np.mean(scatter[chosen] ** 2)))
        share = f"{100 * rms / mean:.0f} % of the mean {name}"
        if rms > max(SCATTERS * usual, MATERIAL * mean):
            far.append(
                f"The {law} misses the points by more than they scatter (rms residual "
                f"{rms:.3g}{unit}, {share}; scatter about {usual:.2g}{unit}): "
                f"{why}{instead and '; or ' + instead}."
            )
        if rms > POOR * mean:
            poor.append(
                f"The rms residual is {share}: values and intervals describe the nearest curve "
                f"of this {law}, not the part"
                f"{instead and '; if they do not just scatter, ' + instead}."
            )
    return far, poor


def values_of(found: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fitted values by name."""
    return {e.name: e.value for e in found["estimates"]}


def _why_missed(problem: FitProblem, judged: list[Verdict]) -> str:
    """Return what keeps the fit from the points."""
    stops = (
        f"{name} is at its {verdict.reason.rpartition('at its ')[2]}"
        for name, verdict in zip(problem.names, judged, strict=True)
        if "pull beyond" in verdict.reason
    )
    return "; ".join(stops) or "its curve has another shape than theirs"


def _few(problem: FitProblem) -> list[str]:
    """Say that nothing tells how good the fit is, where it goes through all points."""
    count = len(problem.names)
    if len(problem.measured) != count:
        return []
    return [
        f"as many values as parameters ({count}): the fit goes through all points, and "
        "nothing tells how good it is; measure more"
    ]


def _check_first(points: Measured, problem: FitProblem, first: Array) -> None:
    """Raise an error for the first point that the parameters before the fit do not solve."""
    plan, computed = points.plan, problem.curve(first)
    if np.isfinite(computed).all():
        return
    failed = points.computed(problem.values(first))[1]
    i = int(np.argmin(np.isfinite(computed)))
    row, name, own = int(points.row[i]), points.output[i], find_model(plan.spec.key).fits
    inputs = (f"{key} {plan.shown[key][row]:g}" for key in plan.shown if key in plan.units)
    where = f"point {row + 1} ({', '.join(inputs)}): {name}"
    if name in own.units:
        cure = "leave it out, or start nearer with --set NAME=VALUE"
        raise SolveError(f"{where} has no solution: {own.none}; {cure}")
    if row in failed:
        raise SolveError(f"{where} has no solution: {failed[row].advice}")
    raise ParameterError(f"{where} is {computed[i]}, allowed: finite outputs")


def _range_of(
    name: str,
    meta: Mapping[str, Any],
    start: float,
    bounds: tuple[float, float] | None,
    change: float,
) -> tuple[float, float, float, float, bool]:
    """Return ends, first guess and scale of a parameter's guess, and if that is a logarithm."""
    least, largest, elsewhere = meta["min"], meta["max"], ELSEWHERE in meta["help"]
    if elsewhere and start == 0.0:
        raise ParameterError(
            f"fit = {name!r}: is 0, which stands for another value ({meta['help']}); "
            "give the value to start from"
        )
    low, high = bounds or (1e-3 * start if elsewhere else least, largest)
    if not least <= low < high <= largest:
        raise ParameterError(
            f"bounds of {name} = {low:g}:{high:g}, allowed: low < high in {allowed(meta)}"
        )
    start = min(max(start, low), high)
    if change > 0.0:
        return low, high, start, change, False
    if low > 0.0 and (high >= DECADE * low or largest >= DECADE * least > 0.0):
        a, b, c = np.log([low, high, start]).tolist()
        a, b = a + INSIDE, b - INSIDE
        return a, b, min(max(c, a), b), min(1.0, 0.5 * (b - a)), True
    half = 0.5 * (high - low)
    return low, high, start, max(min(abs(start) or half, half), LEAST_SHARE * half), False
