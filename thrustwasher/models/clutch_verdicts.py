"""Which fitted constants of the friction law to believe, and why not, in words."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .clutch_calibration_text import counted
from .clutch_fit import Problem
from .clutch_friction import shares
from .clutch_information import Information, combination, members

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Verdict:
    """One constant: told by the points or not, and the reason."""

    half_width: float
    """Of the linearised interval; infinite if nothing is known."""
    identifiable: bool
    at_bound: str
    """"lower", "upper" or ""."""
    reason: str


def verdicts(
    problem: Problem, best: Array, told: Information, weak: Array | None = None
) -> list[Verdict]:
    """Return the verdict on every constant.

    A constant counts as identifiable where the half width of its interval is below a change that
    would certainly matter: 1 for weights and ratios, the fastest slip for speeds. Those marked in
    ``weak`` do not, whatever the slopes at this place say.
    """
    blurred = told.blurred()
    found = []
    for i in range(len(best)):
        error = told.error_of(np.eye(len(best))[i])
        half = error * told.quantile if np.isfinite(told.quantile) else np.inf
        known = bool(half <= problem.scale[i]) and not (weak is not None and weak[i])
        side = _side(problem, best, i)
        words = [] if known else [_why_not(problem, best, told, i, half, blurred)]
        if side:
            words.append(_bound_text(problem, best, i, side))
        found.append(Verdict(half, known, side, "; ".join(words)))
    return found


def confounded(problem: Problem, told: Information) -> tuple[str, ...]:
    """Return one sentence for every combination of constants that the points do not resolve."""
    return tuple(combination(problem.names, d, problem.scale) for d in told.blurred())


def _side(problem: Problem, best: Array, i: int) -> str:
    if best[i] <= problem.low[i]:
        return "lower"
    return "upper" if best[i] >= problem.high[i] else ""


def _bound_text(problem: Problem, best: Array, i: int, side: str) -> str:
    """Say that a bound stops the fit, and what would free it."""
    text = f"at its {side} bound {best[i]:g}"
    gradient = problem.slopes(best)[:, i] @ problem.misfit(best) * problem.scale[i]
    if gradient * (1.0 if side == "lower" else -1.0) <= 1e-9 * problem.cost(best):
        return text
    text += ": the points pull beyond it"
    if problem.names[i] == "plough_weight" and side == "lower":
        adhesion = shares(problem.values(best))[1]
        text += (
            f" (friction at rest cannot be below the adhesive share alone, {adhesion:.4g}; "
            "a larger hardness_ratio lowers that)"
        )
    return text


def _why_not(
    problem: Problem, best: Array, told: Information, i: int, half: float, blurred: list[Array]
) -> str:
    """Return the reason why the points do not tell a constant, the most tangible one first."""
    name, speed = problem.names[i], problem.speed
    stick, fastest, slowest = problem.values(best)["stick_speed"], speed.max(), speed.min()
    few = f"{counted(len(speed), 'point')} for {counted(len(best), 'constant')}"
    if name in ("shear_floor", "decay_speed", "stick_speed") and fastest <= stick:
        return (
            f"all points lie below stick_speed ({stick:.4g} m/s; fastest slip {fastest:.4g} m/s), "
            "where friction does not change with speed"
        )
    lead = ""
    if len(speed) < len(best):
        lead = f"{few}; "
    elif fastest == slowest:
        lead = f"all points have one slip speed ({fastest:.4g} m/s); "
    elif name == "stick_speed" and slowest >= stick:
        lead = f"all points lie above it (slowest slip {slowest:.4g} m/s); "
    about = [d for d in blurred if name in members(problem.names, d, problem.scale)]
    if about:
        return lead + combination(problem.names, about[0], problem.scale)
    if not np.isfinite(told.quantile):
        return f"{few}: no scatter is left to judge by, add points or give friction_error"
    return f"{lead}at this scatter its interval would be +- {half:.2g}"
