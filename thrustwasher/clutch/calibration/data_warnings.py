"""Warnings of a calibration: points that the friction law cannot follow, in plain sentences."""

from collections.abc import Callable, Mapping

import numpy as np

from ...calibration.identifiability import Verdict, listed
from ...numerics.jit import Array
from .friction_law import LawProblem, bounds_of, end_frictions, friction_over

POOR = 0.2  # of the mean friction: an rms residual above it is always worth a warning
RISE = 0.05  # of the mean friction: a smaller rise with speed is not worth one
CHANCE = 1e-4  # probability below which a rise is not the scatter's; the place is searched for
FEWEST = 4  # points that can show a rise

# Friction grows with each of these all over its range, or falls; so the bounds are the extremes.
GROWS = {
    "plough_weight": 1, "shear_floor": 1, "stick_speed": 1, "decay_speed": 1, "indentation": 1,
    "adhesion_factor": 1, "hardness_ratio": -1,
}  # fmt: skip
MATERIAL = 0.02  # of the mean friction: less is not worth a warning
SCATTERS = 3.0  # a point further off than this many standard deviations is off
SEEN, HIDDEN = 0.5, 0.05  # of the fall still to come at the slowest point: before, after the fit
TABLE = (
    'take friction_law = "table" (ClutchParams.with_table), which follows a measured curve '
    "in up to six points."
)


def warnings(
    problem: LawProblem, best: Array, first: Array, judged: list[Verdict]
) -> tuple[str, ...]:
    """Return what is wrong with the fit as a whole, the gravest first; each "headline: details".

    ``first`` are the values before the fit, ``judged`` is the verdict on every constant.
    """
    scatter = 1.0 / problem.weight if problem.known_errors else _scatter(problem)
    found = [_rising(problem)]
    if not problem.is_constant:
        found = [out_of_reach(problem, scatter, side) for side in (1, -1)] + found
    rms = float(np.sqrt(np.mean((problem.curve(best) - problem.measured) ** 2)))
    if not any(found):
        found.append(_missed(problem, rms, judged, scatter))
        if not problem.is_constant:
            found.append(hidden_fall(problem, best, first))
    found.append(_poor(rms / float(problem.measured.mean()), alone=not any(found)))
    return tuple(text for text in found if text)


def _scatter(problem: LawProblem) -> Array:
    """Return the standard deviation of a point beside its neighbours in speed, (points,)."""
    sorted_friction = problem.measured[np.argsort(problem.speed, kind="stable")]
    bends = np.diff(sorted_friction, 2)
    size = float(np.sqrt(np.mean(bends**2) / 6.0)) if len(bends) else 0.0
    return np.full(len(sorted_friction), size)


def _rising(problem: LawProblem) -> str:
    """Return a sentence if friction rises with speed in some range, clearly.

    The best curve that only falls is flat where the points rise; the flat piece that misses them
    most is searched for a trend.
    """
    from scipy.optimize import isotonic_regression
    from scipy.stats import linregress

    order = np.lexsort((-problem.measured, problem.speed))  # one speed's points are no rise
    speed, friction = problem.speed[order], problem.measured[order]
    falling = isotonic_regression(friction, weights=problem.weight[order] ** 2, increasing=False)
    cost = (problem.weight[order] * (friction - falling.x)) ** 2
    worst = int(np.argmax(np.add.reduceat(cost, falling.blocks[:-1])))
    piece = slice(*falling.blocks[worst : worst + 2])
    speed, friction, mean = speed[piece], friction[piece], problem.measured.mean()
    if len(speed) < FEWEST or np.ptp(speed) <= 0.0:
        return ""
    trend = linregress(speed, friction)
    rise = float(trend.slope * np.ptp(speed))
    if rise < RISE * mean or not trend.pvalue < CHANCE:
        return ""
    law = "the constant law cannot change" if problem.is_constant else "this law can only fall"
    return (
        f"Friction rises with speed ({100 * rise / mean:.0f} % of its mean from {speed[0]:.4g} to "
        f"{speed[-1]:.4g} m/s): {law}; {TABLE}"
    )


def _missed(problem: LawProblem, rms: float, judged: list[Verdict], scatter: Array) -> str:
    """Return a sentence if the law misses the points by more than they scatter."""
    mean, usual = float(problem.measured.mean()), float(np.sqrt(np.mean(scatter**2)))
    if rms <= max(SCATTERS * usual, MATERIAL * mean):
        return ""
    stops = [
        f"{name} is at its {verdict.reason.rpartition('at its ')[2]}"
        for name, verdict in zip(problem.names, judged, strict=True)
        if "pull beyond" in verdict.reason
    ]
    why = "; ".join(stops) or "its curve has another shape than theirs"
    if problem.is_constant:
        why = 'friction changes with speed, take friction_law = "wang"'
    return (
        f"The law misses the points by more than they scatter (rms residual {rms:.3g}, "
        f"{100 * rms / mean:.0f} % of the mean friction; scatter about {usual:.2g}): {why}; or "
        + TABLE
    )


def _poor(share: float, alone: bool) -> str:
    """Return a sentence if the residuals are a large part of the friction itself."""
    if share <= POOR:
        return ""
    return (
        f"The rms residual is {100 * share:.0f} % of the mean friction: values and intervals "
        "describe the nearest curve of this law, not the clutch"
        + (f"; if the points do not just scatter, {TABLE}" if alone else ".")
    )


def out_of_reach(problem: LawProblem, scatter: Array, side: int) -> str:
    """Return a sentence if points lie above (side 1) or below (-1) all the law can give, or "".

    ``scatter`` is the standard deviation of ``friction``, (points,).
    """
    measured = problem.measured
    edge = friction_over(_corner(problem, side), problem.speed)
    slack = np.maximum(SCATTERS * scatter, MATERIAL * measured.mean())
    beyond = side * (measured - edge) > slack
    if not beyond.any():
        return ""
    most, limit = ("most", edge.max()) if side > 0 else ("least", edge[beyond].min())
    far = measured.max() if side > 0 else measured.min()

    def reached(values: Mapping[str, float]) -> bool:
        gap = side * (measured - friction_over(values, problem.speed))
        return bool(np.all(gap <= 1e-12))

    count, total = int(np.count_nonzero(beyond)), len(beyond)
    these = "any of these points" if count == total else f"{count} of {total} points"
    return (
        f"The law cannot reach {these} (it gives at {most} {limit:.4g}, measured are "
        f"{'up' if side > 0 else 'down'} to {far:.4g}): {_stopped(problem, side, beyond)}. "
        f"{_cures(problem, side, reached)}"
    )


def hidden_fall(problem: LawProblem, best: Array, first: Array) -> str:
    """Return a sentence if the fit hides a fall it is forced to have below the slowest point.

    Points that all lie below the least possible friction at rest, and would be in the law's fall
    by the values before the fit, can be met by a fall that is over before the first of them.
    """
    lowest = end_frictions(_corner(problem, -1))[0]
    highest = float(problem.measured.max())
    slowest = np.array([problem.speed.min()])
    left = [_fall_left(problem.values(guess), slowest) for guess in (first, best)]
    if highest >= lowest * (1.0 - MATERIAL) or left[0] < SEEN or left[1] > HIDDEN:
        return ""

    def reached(values: Mapping[str, float]) -> bool:
        return bool(end_frictions(values)[0] <= highest)

    at_rest, at_speed = end_frictions(problem.values(best))
    return (
        f"The fit puts the fall from {at_rest:.4g} at rest to {at_speed:.4g} below the slowest "
        f"point, {slowest[0]:.4g} m/s, where nothing was measured (no point is above "
        f"{highest:.4g}): friction at rest cannot be below {lowest:.4g}, "
        f"{_stopped(problem, -1, None)}. {_cures(problem, -1, reached)}"
    )


def _corner(
    problem: LawProblem, side: int, changes: Mapping[str, float] | None = None
) -> dict[str, float]:
    """Return the law's numbers for its most (1) or least (-1) friction within the ranges."""
    values = dict(problem.base)
    for name, low, high in zip(problem.names, problem.low, problem.high, strict=True):
        values[name] = float(high if GROWS[name] * side > 0 else low)
    return {**values, **(changes or {})}


def _fall_left(values: Mapping[str, float], speed: Array) -> float:
    """Return the share of the law's fall that is still to come at a slip speed."""
    unit = {**values, "plough_weight": 0.0, "shear_floor": 0.0}
    return float(friction_over(unit, speed)[0] / end_frictions(unit)[0])


def _stopped(problem: LawProblem, side: int, points: Array | None) -> str:
    """Name the bounds without which the law would give more, or less (at rest if no points)."""
    at = np.zeros(1) if points is None else problem.speed[points]
    edge = friction_over(_corner(problem, side), at)
    stopping = []
    for name, low, high in zip(problem.names, problem.low, problem.high, strict=True):
        bound, inner = (high, low) if GROWS[name] * side > 0 else (low, high)
        inside = bound + 0.01 * (inner - bound)
        if np.any(friction_over(_corner(problem, side, {name: inside}), at) != edge):
            which = "upper" if bound == high else "lower"
            stopping.append(f"{name} is stopped by its {which} bound {bound:g}")
    return " and ".join(stopping) or "none of the fitted constants acts on that"


def _cures(problem: LawProblem, side: int, reached: Callable[[Mapping[str, float]], bool]) -> str:
    """Say which constants that are not fitted would help, and from which value on alone."""
    words = []
    corner = _corner(problem, side)
    for name, grows in GROWS.items():
        if name in problem.names:
            continue
        low, high = (float(x[0]) for x in bounds_of((name,)))
        bound = high if grows * side > 0 else low
        at_bound = {**corner, name: bound}
        change = abs(end_frictions(at_bound)[0] / end_frictions(corner)[0] - 1.0)
        if change < MATERIAL and not reached(at_bound):
            continue
        enough = f" ({_enough(corner, name, bound, reached)})" if reached(at_bound) else ""
        words.append(f"a {'larger' if bound == high else 'smaller'} {name}{enough}")
    helps = f"What would help: {listed(words, 'or')}. " if words else ""
    return f"{helps}Or {TABLE}"


def _enough(
    corner: Mapping[str, float], name: str, bound: float,
    reached: Callable[[Mapping[str, float]], bool],
) -> str:  # fmt: skip
    """Return the value of one constant from which on it alone is enough."""
    short, far = corner[name], bound
    for _ in range(50):
        middle = 0.5 * (short + far)
        short, far = (short, middle) if reached({**corner, name: middle}) else (middle, far)
    step = 0.005 * abs(far)  # more than rounding to three digits takes away
    if bound > corner[name]:
        return f"{min(far + step, bound):.3g} or more"
    return f"{max(far - step, bound):.3g} or less"
