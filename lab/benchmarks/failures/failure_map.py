"""The failure map: each method meets each hazard, and what comes out is judged.

Here are a cavitating film, lock-up in co-simulation and a shaft that swings.
"""

import math
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from typing import Any

from . import cavitation as films
from . import lockup
from . import shaft as shafts
from .failure_cells import LIES, OK, SAYS, SLOW, Cell, Group, off, table
from .failure_masters import masters
from .failure_washer import balance, closed_forms
from .heat_loop import heat_loop

MANY_SWEEPS, MANY_SOLVES = 100, 10
WRONG_LOAD = 0.02
NO_LOAD = 1e-12  # of a film that has a load: nothing lifts
WRONG_ENERGY = 0.01
MOST_TURNS = 2
MANY_TORQUES = 10  # per step, and
FEW_TORQUES = 5000  # in all: so many are no matter


def cavitation() -> Group:
    """Judge methods to solve a cavitating film by its load."""
    hazards = {
        "thick film, no cavity": ("slider", 31, 1.0),
        "one cavity": ("one wave", 31, 1.0),
        "turned round": ("one wave", 31, -1.0),
        "two cavities": ("two waves", 31, 1.0),
        "three, tilted": ("waves and tilt", 31, 1.0),
        "dimple": ("dimple", 31, 1.0),
        "two cavities, fine mesh": ("two waves", 95, 1.0),
        "standstill": ("one wave", 31, 0.0),
        "no wedge": ("level", 31, 1.0),
    }
    methods = {
        "linear solve, negatives cut": films.cut,
        "clamp in back substitution": films.clamp,
        "projected relaxation, stop on the change": films.relax_change,
        "projected over-relaxation, stop on the residual": films.relax_rest,
        "active set, cold": films.active_set,
        "active set, nested meshes": None,
    }
    exact: dict[Any, float] = {}

    def judge(method: Any, hazard: Any) -> Cell:
        height, n, direction = hazard
        pad = partial(films.pad, height, direction=direction)
        if hazard not in exact:
            exact[hazard] = films.active_set(pad(n)).load
        film = method(pad(n)) if method else films.nested(pad, n)
        if film.status.is_failure:
            return Cell(SAYS, "", film.status.name)
        true = exact[hazard]
        error = (film.load - true) / true if true > NO_LOAD else film.load
        if abs(error) > WRONG_LOAD:
            return Cell(LIES, off(error), "load off, status OK")
        swept = method in (films.relax_change, films.relax_rest)
        slow = film.work > (MANY_SWEEPS if swept else MANY_SOLVES)
        unit = "sweep" if swept else "solve"
        done = f"{film.work} {unit}" + ("" if film.work == 1 else "s")
        return Cell(SLOW if slow else OK, done, f"load off by {100 * error:+.2g} %")

    judged = f"load off by more than {100 * WRONG_LOAD:g} %"
    return table("a cavitating film", judged, methods, hazards, judge)


def coupling(*, quick: bool = False) -> Group:
    """Judge methods to step a clutch through lock-up by slip energy, chatter and creep.

    ``quick``: only the hazards of few steps.
    """
    usual, filling = lockup.Clutch(), lockup.Clutch(lag=0.2)
    hazards = {
        "fine steps, 0.1 ms": (usual, 1e-4, None),
        "stiff lock-up, 1 ms": (usual, 1e-3, None),
        "lock inside a step, 7 ms": (usual, 7e-3, None),
        "huge step, 50 ms": (usual, 5e-2, None),
        "rolled back, 0.1 ms": (filling, 1e-4, lockup.Rewind()),
        "rolled back, film forgotten": (filling, 1e-4, lockup.Rewind(forgets=True)),
        "100 000 steps": (lockup.Clutch(span=2.0), 2e-5, None),
    }
    if quick:
        hazards = {name: h for name, h in hazards.items() if h[1] > 5e-4}
    methods = {
        "explicit fixed step (Runge-Kutta 4)": lockup.runge_kutta,
        "LSODA, smoothed friction": lockup.lsoda,
        "BDF, smoothed friction": lockup.bdf,
        "stick and slip, events located": lockup.located,
        "Gauss-Seidel, friction torque": lockup.gauss_seidel,
        "Jacobi, friction torque": lockup.jacobi,
        "step doubling with rollback, friction torque": lockup.step_doubling,
        "linearly implicit, friction torque and slope": lockup.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        clutch, step, rewind = hazard
        return _judged(clutch, step, method(clutch, step, rewind))

    judged = f"slip energy off by more than {100 * WRONG_ENERGY:g} %, chatter, or slip that stays"
    return table("lock-up in co-simulation", judged, methods, hazards, judge)


def _judged(clutch: Any, step: float, run: Any) -> Cell:
    """Look at the heat, at the slip after lock-up, and at the work."""
    if not math.isfinite(run.energy):
        return Cell(LIES, "NaN", "not finite, silently")
    error = run.energy / clutch.slip_energy - 1.0
    turns = run.chatter(clutch)
    if abs(error) > WRONG_ENERGY:
        return Cell(LIES, off(error), "slip energy off")
    if turns > MOST_TURNS:
        return Cell(LIES, "chatters", f"the slip turns round {turns} times after lock-up")
    if abs(run.slip[-1]) > clutch.width:
        words = f"slips on with {run.slip[-1]:.2g} rad/s after lock-up"
        return Cell(LIES, "slips on", words)
    per_step = run.work / round(clutch.span / step)
    words = f"{run.work} torques, slip energy off by {100 * abs(error):.2g} %"
    if per_step > MANY_TORQUES and run.work > FEW_TORQUES:
        return Cell(SLOW, f"{per_step:.0f} a step", words)
    return Cell(OK, f"{100 * abs(error):.2f} %", words)


def drift() -> Group:
    """Judge methods to step an undamped shaft by the energy that is left."""
    many = 100_000
    hazards = {
        f"{many} steps of 1/314 swing": shafts.Shaft(0.02, many),
        f"{many} steps of 1/31 swing": shafts.Shaft(0.2, many),
        "10 steps of half a swing": shafts.Shaft(3.0, 10),
    }
    methods = {
        "explicit fixed step (Runge-Kutta 4)": shafts.runge_kutta,
        "LSODA, one system": shafts.lsoda,
        "Gauss-Seidel, torque held": shafts.gauss_seidel,
        "Jacobi, torque held": shafts.jacobi,
        "step doubling with rollback, torque held": shafts.step_doubling,
        "linearly implicit": shafts.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        error = method(hazard) - 1.0
        if not abs(error) <= WRONG_ENERGY:
            text = off(error) if math.isfinite(error) else "grows"
            return Cell(LIES, text, "energy off")
        return Cell(OK, f"{100 * abs(error):.2g} %", "")

    judged = f"energy off by more than {100 * WRONG_ENERGY:g} %"
    return table("a shaft that swings", judged, methods, hazards, judge)


def stability(progress: Callable[[str], None] = print) -> list[dict[str, Any]]:
    """Return all groups, as JSON types."""
    measures: dict[str, Callable[[], Group]] = {
        "a cavitating film": cavitation,
        "the washer's balance": balance,
        "a flank that its oil heats": heat_loop,
        "closed forms": closed_forms,
        "lock-up in co-simulation": coupling,
        "a shaft that swings": drift,
        "masters of a shift": masters,
    }
    groups: list[Group] = []
    for name, measure in measures.items():
        progress("where methods fail: " + name)
        groups.append(measure())
    return [asdict(g) for g in groups]
