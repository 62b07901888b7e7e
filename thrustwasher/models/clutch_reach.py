"""Which coefficients of friction the law can give at all, and what would let it give others."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from .clutch_fit import Problem, bounds_of
from .clutch_friction import end_frictions, friction_over

Array = NDArray[np.float64]

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


def out_of_reach(problem: Problem, scatter: Array, side: int) -> str:
    """Return a sentence if points lie above (side 1) or below (-1) all the law can give, or "".

    Parameters
    ----------
    problem : what is fitted, within which ranges
    scatter : (points,) standard deviation of ``friction``
    side : 1 for points that are too high, -1 for those too low
    """
    measured = problem.friction
    edge = _extreme(problem, side)
    slack = np.maximum(SCATTERS * scatter, MATERIAL * measured.mean())
    beyond = side * (measured - edge) > slack
    if not beyond.any():
        return ""
    most, limit = ("most", edge.max()) if side > 0 else ("least", edge[beyond].min())
    far = measured.max() if side > 0 else measured.min()

    def reached(values: Mapping[str, float]) -> bool:
        gap = side * (measured - friction_over(values, problem.speed))
        return bool(np.all(gap <= 1e-12))

    return (
        f"The law cannot reach {_share(beyond)} (it gives at {most} {limit:.4g}, measured are "
        f"{'up' if side > 0 else 'down'} to {far:.4g}): {_stopped(problem, side, beyond)}. "
        f"{_cures(problem, side, reached)}"
    )


def hidden_fall(problem: Problem, best: Array, first: Array) -> str:
    """Return a sentence if the fit hides a fall it is forced to have below the slowest point.

    Points that all lie below the least possible friction at rest, and would be in the law's fall
    by the values before the fit, can be met by a fall that is over before the first of them.
    """
    lowest = end_frictions(_corner(problem, -1))[0]
    highest = float(problem.friction.max())
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
    problem: Problem, side: int, changes: Mapping[str, float] | None = None
) -> dict[str, float]:
    """Return the law's numbers for its most (1) or least (-1) friction within the ranges."""
    values = dict(problem.base)
    for name, low, high in zip(problem.names, problem.low, problem.high, strict=True):
        values[name] = float(high if GROWS[name] * side > 0 else low)
    return {**values, **(changes or {})}


def _extreme(problem: Problem, side: int) -> Array:
    """Return the most or least friction at each measured speed."""
    return friction_over(_corner(problem, side), problem.speed)


def _fall_left(values: Mapping[str, float], speed: Array) -> float:
    """Return the share of the law's fall that is still to come at a slip speed."""
    unit = {**values, "plough_weight": 0.0, "shear_floor": 0.0}
    return float(friction_over(unit, speed)[0] / end_frictions(unit)[0])


def _share(beyond: Array) -> str:
    count, total = int(np.count_nonzero(beyond)), len(beyond)
    return "any of these points" if count == total else f"{count} of {total} points"


def _stopped(problem: Problem, side: int, points: Array | None) -> str:
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


def _cures(problem: Problem, side: int, reached: Callable[[Mapping[str, float]], bool]) -> str:
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
    helps = f"What would help: {_or(words)}. " if words else ""
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


def _or(words: list[str]) -> str:
    return " or ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else words[0]
