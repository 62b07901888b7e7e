"""The failure map: each method meets each hazard, and what comes out is judged.

Here are a cavitating film, a surface that its oil heats, closed forms at the ends of their ranges,
lock-up in co-simulation and a shaft that swings; ``failure_balance`` has the washer's balance.
"""

import math
from collections.abc import Callable
from dataclasses import asdict
from fractions import Fraction
from functools import partial
from typing import Any

from ...errors import Status
from ...gearmesh.kernels.flank_temperature import surface_temperature
from ...tribology.lumped_body import exponential_weights
from ...washer.closed_forms.thin_film import narrow_ring_load
from ...washer.kernels.wedge import lift
from ..rivals import cavitation as films
from ..rivals import heat_loop as loops
from ..rivals import lockup
from ..rivals import lockup_methods as steppers
from ..rivals import shaft as shafts
from .failure_balance import balance
from .failure_cells import LIES, OK, SAYS, SLOW, Cell, Group, off, table

Measure = tuple[str, Callable[[], Group]]
MANY_SWEEPS, MANY_SOLVES = 100, 10
WRONG_LOAD = 0.02
NO_LOAD = 1e-12  # of a film that has a load: nothing lifts
WRONG_KELVIN = 0.1
MANY_TURNS = 20
WRONG_DIGITS = 1e-6
RADIUS, WIDTH, GAP = 0.02, 2.0**-30, 1e-5  # m, of a narrow ring
RIM = RADIUS + 0.5 * WIDTH
WRONG_ENERGY = 0.01
MOST_TURNS = 2
MANY_TORQUES = 10  # per step, and
FEW_TORQUES = 5000  # in all: so many are no matter


def cavitation(*, quick: bool = False) -> Group:
    """Judge methods to solve a cavitating film by its load."""
    fine = 47 if quick else 95
    hazards = {
        "thick film, no cavity": (films.slider, 31, 1.0),
        "one cavity": (films.one_wave, 31, 1.0),
        "turned round": (films.one_wave, 31, -1.0),
        "two cavities": (films.two_waves, 31, 1.0),
        "three, tilted": (films.waves_and_tilt, 31, 1.0),
        "dimple": (films.dimple, 31, 1.0),
        "two cavities, fine mesh": (films.two_waves, fine, 1.0),
        "standstill": (films.one_wave, 31, 0.0),
        "no wedge": (films.level, 31, 1.0),
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


def heat_loop() -> Group:
    """Judge methods to find the temperature of a flank heated by its own oil."""
    hazards = {
        "little heat": loops.Loop(40.0, 5.0, 1.0),
        "film thins with the oil": loops.Loop(40.0, 100.0, 0.3),
        "film keeps its height": loops.Loop(40.0, 100.0, 1.0),
        "much heat": loops.Loop(40.0, 1000.0, 1.0),
        "cold oil, -40 degC": loops.Loop(-40.0, 100.0, 1.0),
        "no heat": loops.Loop(40.0, 0.0, 1.0),
    }

    def ours(loop: Any) -> tuple[float, Status, int]:
        # a stress of 1 at the bulk's viscosity, so that the factor is the rise
        t, _, status, turns = surface_temperature(
            loop.bulk + 273.15, loop.rise, 1.0, 1e300, loop.power, loops.B, loops.C
        )
        return t - 273.15, Status(status), turns

    methods = {
        "substituted 50 times": loops.substitute_often,
        "substituted until it stays": loops.substitute,
        "half of each step": loops.relaxed,
        "Newton, undamped": loops.newton,
        "Newton in a bracket, the package's": ours,
    }

    def judge(method: Any, loop: Any) -> Cell:
        t, status, turns = method(loop)
        if status.is_failure:
            return Cell(SAYS, "", status.name)
        error = t - loop.root()
        if not abs(error) <= WRONG_KELVIN:
            return Cell(LIES, f"{error:+.0f} K", f"slope there {loop.slope(loop.root()):.2f}")
        words = f"off by {abs(error):.1g} K, slope there {loop.slope(loop.root()):.2f}"
        return Cell(SLOW if turns > MANY_TURNS else OK, f"{turns} turn" + "s" * (turns != 1), words)

    judged = f"off by more than {WRONG_KELVIN:g} K"
    return table("a flank that its oil heats", judged, methods, hazards, judge)


def closed_forms() -> Group:
    """Judge closed forms at the ends of their ranges, as printed and as the package has them."""

    def printed(tilt: float) -> float:
        largest = GAP + tilt * (RIM + RADIUS - 0.5 * WIDTH)
        least = GAP + 0.5 * tilt * WIDTH
        return narrow_ring_load(1.0, 1.0, RADIUS - 0.5 * WIDTH, RIM, least, largest)

    def ours(tilt: float) -> float:
        # a roughness so small that it does not count
        return lift(GAP, 0.0, tilt, 0.0, 1.0, 0.0, RADIUS - 0.5 * WIDTH, RIM, 1e-12)[0]

    def weight(z: float) -> float:
        return (1.0 - (1.0 - math.exp(-z)) / z) / z

    Form = tuple[Callable[[float], float], Callable[[float], float], dict[str, float]]
    tilts = {"usual": 1e-4, "far": 1e-12, "end": 1e-17, "zero": 0.0}
    times = {"usual": 1.0, "far": 1e-6, "end": 1e-9, "zero": 0.0}
    forms: dict[str, Form] = {
        "load of a narrow ring, 1/h_1^2 - 1/h_2^2": (printed, _ring, tilts),
        "the same, as the package has it": (ours, _ring, tilts),
        "mean of a heated body, (1 - (1 - exp(-z))/z)/z": (weight, _weight, times),
        "the same, the package's": (lambda z: exponential_weights(z)[2], _weight, times),
    }
    hazards = {
        "middle of its range": "usual", "differences of near numbers": "far",
        "the end of its range": "end", "zero itself": "zero",
    }  # fmt: skip

    def judge(form: Form, place: str) -> Cell:
        formula, true, places = form
        x = places[place]
        found, exact = formula(x), true(x)
        error = found / exact - 1.0 if exact else found
        if not abs(error) <= WRONG_DIGITS:
            return Cell(LIES, off(error), f"at {x:g}")
        return Cell(OK, f"{abs(error):.0e}" if error else "", f"at {x:g}")

    judged = f"off by more than {WRONG_DIGITS:g}, relative"
    return table("closed forms at the ends of their ranges", judged, forms, hazards, judge)


def _ring(tilt: float) -> float:
    """Return the load of a tilted narrow ring, in fractions."""
    radius, width, rim, gap, g = (Fraction(x) for x in (RADIUS, WIDTH, RIM, GAP, tilt))
    least = gap + g * width / 2
    largest = gap + g * (rim + radius - width / 2)
    return float(radius * width**3 / 4 * (1 / least**2 - 1 / largest**2))


def _weight(z: float) -> float:
    """Return the sum of (-z)^k/(k + 2)!, of which nothing is lost for z up to some ten."""
    total, term = 0.0, 0.5
    for k in range(60):
        total += term
        term *= -z / (k + 3.0)
    return total


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
        "explicit fixed step (Runge-Kutta 4)": steppers.runge_kutta,
        "LSODA, smoothed friction": steppers.lsoda,
        "BDF, smoothed friction": steppers.bdf,
        "stick and slip, events located": steppers.located,
        "Gauss-Seidel, friction torque": steppers.gauss_seidel,
        "Jacobi, friction torque": steppers.jacobi,
        "step doubling with rollback, friction torque": steppers.step_doubling,
        "linearly implicit, friction torque and slope": steppers.linearly_implicit,
    }

    def judge(method: Any, hazard: Any) -> Cell:
        clutch, step, rewind = hazard
        return _judged(clutch, step, method(clutch, step, rewind))

    judged = f"slip energy off by more than {100 * WRONG_ENERGY:g} %, chatter, or slip that stays"
    return table("lock-up in co-simulation", judged, methods, hazards, judge)


def _judged(clutch: Any, step: float, run: Any) -> Cell:
    """Look at the heat, at the slip after lock-up, and at the work."""
    if not math.isfinite(run.energy):
        return Cell(LIES, "NaN", "not finite, without a word")
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


def drift(*, quick: bool = False) -> Group:
    """Judge methods to step an undamped shaft by the energy that is left."""
    many = 10_000 if quick else 100_000
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


def stability(
    *, quick: bool = False, progress: Callable[[str], None] = print, more: tuple[Measure, ...] = ()
) -> list[dict[str, Any]]:
    """Return all groups, as JSON types; ``more`` are measured after the package's own."""
    own: tuple[Measure, ...] = (
        ("a cavitating film", partial(cavitation, quick=quick)),
        ("the washer's balance", balance),
        ("a flank that its oil heats", heat_loop),
        ("closed forms", closed_forms),
        ("lock-up in co-simulation", coupling),
        ("a shaft that swings", partial(drift, quick=quick)),
    )
    groups: list[Group] = []
    for name, made in (*own, *more):
        progress("where methods fail: " + name)
        groups.append(made())
    return [asdict(g) for g in groups]
