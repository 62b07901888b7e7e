"""Where ways to step in time, and to couple parts that step on their own, fail."""

from __future__ import annotations

import math
from typing import Any

from .stability_cells import LIES, OK, SLOW, Cell, Group, off, table

WRONG_ENERGY = 0.01
MOST_TURNS = 2
MANY_TORQUES = 10  # per step, and
FEW_TORQUES = 5000  # in all: so many are no matter


def coupling(*, quick: bool = False) -> Group:
    """Judge ways to step a clutch through lock-up by slip energy, chatter and creep.

    ``quick``: only the hazards of few steps.
    """
    from ..rivals import lockup as k
    from ..rivals import lockup_solvers as solvers
    from ..rivals import lockup_ways as ways

    usual, filling = k.Clutch(), k.Clutch(lag=0.2)
    hazards = {
        "fine steps, 0.1 ms": (usual, 1e-4, None),
        "stiff lock-up, 1 ms": (usual, 1e-3, None),
        "lock inside a step, 7 ms": (usual, 7e-3, None),
        "huge step, 50 ms": (usual, 5e-2, None),
        "rungs blended, 0.1 ms": (k.Clutch(other=0.97), 1e-4, None),
        "rolled back, 0.1 ms": (filling, 1e-4, k.Rewind()),
        "rolled back, film forgotten": (filling, 1e-4, k.Rewind(forgets=True)),
        "100 000 steps": (k.Clutch(span=2.0), 2e-5, None),
    }
    if quick:
        hazards = {name: h for name, h in hazards.items() if h[1] > 5e-4}
    methods = {
        "explicit fixed step (Runge-Kutta 4)": ways.runge_kutta,
        "LSODA, smoothed friction": solvers.lsoda,
        "BDF, smoothed friction": solvers.bdf,
        "stick and slip, events located": ways.located,
        "Gauss-Seidel, friction torque": ways.gauss_seidel,
        "Jacobi, friction torque": ways.jacobi,
        "step doubling with rollback, friction torque": ways.step_doubling,
        "linearly implicit, friction torque and slope": ways.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        clutch, step, rewind = hazard
        return _judged(clutch, step, method(clutch, step, rewind))

    judged = f"slip energy off by more than {100 * WRONG_ENERGY:g} %, chatter, or slip that stays"
    return table("lock-up in co-simulation", judged, methods, hazards, judge)


def _judged(clutch: Any, step: float, course: Any) -> Cell:
    """Look at the heat, at the slip after lock-up, and at the work."""
    if not math.isfinite(course.energy):
        return Cell(LIES, "NaN", "not finite, without a word")
    error = course.energy / clutch.slip_energy - 1.0
    turns = course.chatter(clutch)
    if abs(error) > WRONG_ENERGY:
        return Cell(LIES, off(error), "slip energy off")
    if turns > MOST_TURNS:
        return Cell(LIES, "chatters", f"the slip turns round {turns} times after lock-up")
    if abs(course.slip[-1]) > clutch.width:
        words = f"slips on with {course.slip[-1]:.2g} rad/s after lock-up"
        return Cell(LIES, "slips on", words)
    per_step = course.work / round(clutch.span / step)
    words = f"{course.work} torques, slip energy off by {100 * abs(error):.2g} %"
    if per_step > MANY_TORQUES and course.work > FEW_TORQUES:
        return Cell(SLOW, f"{per_step:.0f} a step", words)
    return Cell(OK, f"{100 * abs(error):.2f} %", words)


def drift(*, quick: bool = False) -> Group:
    """Judge ways to step an undamped shaft by the energy that is left."""
    from ..rivals import shaft as s

    many = 10_000 if quick else 100_000
    hazards = {
        f"{many} steps of 1/314 swing": s.Shaft(0.02, many),
        f"{many} steps of 1/31 swing": s.Shaft(0.2, many),
        "10 steps of half a swing": s.Shaft(3.0, 10),
    }
    methods = {
        "explicit fixed step (Runge-Kutta 4)": s.runge_kutta,
        "LSODA, one system": s.lsoda,
        "Gauss-Seidel, torque held": s.gauss_seidel,
        "Jacobi, torque held": s.jacobi,
        "step doubling with rollback, torque held": s.step_doubling,
        "linearly implicit": s.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        error = method(hazard) - 1.0
        if not abs(error) <= WRONG_ENERGY:
            text = off(error) if math.isfinite(error) else "grows"
            return Cell(LIES, text, "energy off")
        return Cell(OK, f"{100 * abs(error):.2g} %", "")

    judged = f"energy off by more than {100 * WRONG_ENERGY:g} %"
    return table("a shaft that swings", judged, methods, hazards, judge)
