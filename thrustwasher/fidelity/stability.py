"""Where methods fail: each method meets each hazard, and what comes out is judged.

=======  =========================================================================================
ok       right, or off by its mesh only
slow     right, but more than 100 sweeps or 10 solves
says     fails, and says so by a status or an exception
LIES     wrong, without a word
-        does not apply
=======  =========================================================================================
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

from ..errors import ParameterError, SolveError

OK, SLOW, SAYS, LIES, NONE = "ok", "slow", "says", "LIES", "-"
MANY_SWEEPS, MANY_SOLVES = 100, 10
WRONG_LOAD, WRONG_ENERGY = 0.02, 0.01
WRONG_RATIO = 1.0  # of the film: another branch, not another mesh
MOST_TURNS = 2


@dataclass(frozen=True)
class Cell:
    """One method at one hazard."""

    verdict: str
    figure: str = ""  # what is off, or how much was done
    words: str = ""


@dataclass(frozen=True)
class Group:
    """Methods for one thing, hazards it meets, and cells[method][hazard]."""

    name: str
    judged: str
    methods: list[str]
    hazards: list[str]
    cells: list[list[Cell]]


Judge = Callable[[Any, Any], Cell]


def table(
    name: str, judged: str, methods: dict[str, Any], hazards: dict[str, Any], judge: Judge
) -> Group:
    """Return all cells; an exception is a way of saying it."""
    cells = []
    for method in methods.values():
        row = []
        for hazard in hazards.values():
            try:
                row.append(judge(method, hazard))
            except (ParameterError, SolveError, ArithmeticError, ValueError) as error:
                row.append(Cell(SAYS, "", f"{type(error).__name__}: {error}"))
        cells.append(row)
    return Group(name, judged, list(methods), list(hazards), cells)


def cavitation(*, quick: bool = False) -> Group:
    """Judge ways to solve a cavitating film by its load."""
    from ..rivals import cavitation as c

    fine = 47 if quick else 95
    hazards = {
        "one cavity": (c.one_wave, 31, 1.0),
        "one cavity, swept the other way": (c.one_wave, 31, -1.0),
        "two cavities": (c.two_waves, 31, 1.0),
        "three, tilted": (c.waves_and_tilt, 31, 1.0),
        "dimple": (c.dimple, 31, 1.0),
        "two cavities, fine mesh": (c.two_waves, fine, 1.0),
    }
    methods = {
        "linear solve, negatives cut": c.cut,
        "clamp in back substitution": c.clamp,
        "projected relaxation, stop on the change": c.relax_change,
        "projected over-relaxation, stop on the residual": c.relax_rest,
        "active set, cold": c.active_set,
        "active set, nested meshes": None,
    }
    exact: dict[Any, float] = {}

    def judge(method: Any, hazard: Any) -> Cell:
        height, n, direction = hazard
        pad = partial(c.pad, height, direction=direction)
        if hazard not in exact:
            exact[hazard] = c.active_set(pad(n)).load
        film = method(pad(n)) if method else c.nested(pad, n)
        if film.status.is_failure:
            return Cell(SAYS, "", film.status.name)
        error = film.load / exact[hazard] - 1.0
        if abs(error) > WRONG_LOAD:
            return Cell(LIES, f"{100 * error:+.0f} %", "load off, status OK")
        swept = method in (c.relax_change, c.relax_rest)
        slow = film.work > (MANY_SWEEPS if swept else MANY_SOLVES)
        done = f"{film.work} {'sweeps' if swept else 'solves'}"
        return Cell(SLOW if slow else OK, done, f"load off by {100 * error:+.2g} %")

    return table("cavitation", f"load off by more than {100 * WRONG_LOAD:g} %", methods, hazards,
                 judge)  # fmt: skip


# load N, speed rad/s, tilt rad
WASHER_HAZARDS = {
    "full film": (300.0, 545.0, 2e-3),
    "contact onset": (320.0, 136.0, 2e-3),
    "near a fold": (690.0, 545.0, 2e-3),
    "past the fold": (1200.0, 545.0, 2e-3),
    "standstill": (300.0, 0.0, 2e-3),
    "no tilt": (300.0, 545.0, 0.0),
}
MESH = (17, 67)


def balance() -> Group:
    """Judge ways to find the washer's balance, from nothing, by the branch they end on."""
    from ..models.washer import solve_washer
    from ..models.washer_params import WasherParams
    from ..rivals.plain2006 import Plain2006

    base = partial(Plain2006, grid=MESH, tolerance=1e-4)
    methods: dict[str, Any] = {
        "Newton, undamped, level start": partial(base, limited=False, level=True),
        "Newton, limited; temperatures substituted": partial(base, share=1.0),
        "Newton, limited; temperatures relaxed": base,
        "field, the package's default": None,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        load, speed, tilt = hazard
        point: Any = {"load": load, "speed": speed, "tilt": tilt}
        true = solve_washer(WasherParams(), **point, fidelity="fine")
        if method is None:
            found = solve_washer(WasherParams(), **point, throw=False)
            status, ratio, torque = found.status, found.film_ratio, found.friction_torque
        else:
            washer = method()
            status = washer.solve(load, speed, tilt, 297.15)
            ratio, torque = washer.film_ratio, washer.friction_torque
        if status.is_failure:
            return Cell(SAYS, "", status.name)
        if not (math.isfinite(ratio) and math.isfinite(torque)):
            return Cell(LIES, "NaN", "not finite, status OK")
        off = f"film ratio {ratio:.2g}, true {true.film_ratio:.2g}"
        if abs(ratio - true.film_ratio) > WRONG_RATIO:
            return Cell(LIES, f"{ratio:.1f} for {true.film_ratio:.1f}", off)
        return Cell(OK, "", off)

    judged = f"film ratio off by more than {WRONG_RATIO:g}: another branch"
    return table("the washer's balance", judged, methods, WASHER_HAZARDS, judge)


def coupling() -> Group:
    """Judge ways to step a clutch through lock-up by slip energy and chatter."""
    from ..rivals import lockup as k

    usual = k.Clutch()
    hazards = {
        "fine steps, 0.1 ms": (usual, 1e-4),
        "stiff lock-up, 1 ms": (usual, 1e-3),
        "lock inside a step, 7 ms": (usual, 7e-3),
        "huge step, 50 ms": (usual, 5e-2),
        "100 000 steps": (k.Clutch(span=2.0), 2e-5),
    }
    methods = {
        "explicit fixed step (Runge-Kutta 4)": k.runge_kutta,
        "LSODA, smoothed friction": k.adaptive,
        "stick and slip, events located": k.located,
        "Gauss-Seidel, friction torque": k.gauss_seidel,
        "Jacobi, friction torque": k.jacobi,
        "linearly implicit": k.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        clutch, step = hazard
        course = method(clutch, step)
        if not math.isfinite(course.energy):
            return Cell(LIES, "NaN", "not finite, without a word")
        error = course.energy / clutch.slip_energy - 1.0
        turns = course.chatter(clutch)
        creep = abs(course.slip[-1]) / clutch.width
        if abs(error) > WRONG_ENERGY:
            return Cell(LIES, f"{100 * error:+.1f} %", "slip energy off")
        if turns > MOST_TURNS:
            return Cell(LIES, "chatters", f"the slip turns round {turns} times after lock-up")
        if creep > 1.0:
            words = f"slips on with {course.slip[-1]:.2g} rad/s after lock-up"
            return Cell(LIES, "slips on", words)
        return Cell(OK, f"{100 * abs(error):.2f} %", "")

    judged = f"slip energy off by more than {100 * WRONG_ENERGY:g} %, chatter, or slip that stays"
    return table("lock-up in co-simulation", judged, methods, hazards, judge)


def stability(
    *, quick: bool = False, progress: Callable[[str], None] = print
) -> list[dict[str, Any]]:
    """Return all groups, as JSON types."""
    groups: list[Group] = []
    for made in (partial(cavitation, quick=quick), balance, coupling):
        progress("where methods fail: " + made_name(made))
        groups.append(made())
    return [asdict(g) for g in groups]


def made_name(made: Callable[..., Group]) -> str:
    """Return what a group is called before it is measured."""
    function = made.func if isinstance(made, partial) else made
    return str(function.__name__)


def liars(groups: Sequence[dict[str, Any]]) -> list[tuple[str, str]]:
    """Return (method, hazard) of every wrong answer given without a word."""
    return [
        (method, hazard)
        for g in groups
        for method, row in zip(g["methods"], g["cells"], strict=True)
        for hazard, cell in zip(g["hazards"], row, strict=True)
        if cell["verdict"] == LIES
    ]
