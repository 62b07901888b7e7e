"""Where methods fail on the washer's equations.

On its balance by the branch they end on, in closed forms at the ends of their ranges.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from functools import cache, partial
from itertools import pairwise
from typing import Any, NamedTuple

from thrustwasher.model.part_file import preset_params
from thrustwasher.tribology.lumped_body import exponential_weights
from thrustwasher.washer.load_curve import load_curve
from thrustwasher.washer.parameters import SPEC, WasherParams
from thrustwasher.washer.solve import solve_washer

from .failure_cells import LIES, NONE, OK, SAYS, Cell, Group, off, table
from .narrow_ring import narrow_ring_load
from .plain2006 import Plain2006

WRONG_RATIO = 1.0  # of the film: another branch, not another mesh
MESH = (17, 67)
OIL = 297.15
WRONG_DIGITS = 1e-6
RADIUS, WIDTH, GAP = 0.02, 2.0**-30, 1e-5  # m, of a narrow ring
RIM = RADIUS + 0.5 * WIDTH


class Hazard(NamedTuple):
    """Where the washer is to be solved, and where it was before (None: nowhere)."""

    load: float
    speed: float
    tilt: float
    before: tuple[float, float, float] | None = None
    oil: float = OIL


HAZARDS = {
    "full film": Hazard(300.0, 545.0, 2e-3),
    "contact onset": Hazard(320.0, 136.0, 2e-3),
    "near a fold": Hazard(690.0, 545.0, 2e-3, (600.0, 545.0, 2e-3)),
    "past the fold": Hazard(1200.0, 545.0, 2e-3, (700.0, 545.0, 2e-3)),
    "back below the fold": Hazard(300.0, 545.0, 2e-3, (1200.0, 545.0, 2e-3)),
    "standstill": Hazard(300.0, 0.0, 2e-3, (300.0, 545.0, 2e-3)),
    "turned round": Hazard(300.0, -545.0, 2e-3, (300.0, 545.0, 2e-3)),
    "no tilt": Hazard(300.0, 545.0, 0.0, (300.0, 545.0, 2e-4)),
    "hardly a load": Hazard(1.0, 545.0, 2e-3, (20.0, 545.0, 2e-3)),
    "cold oil, -39 degC": Hazard(300.0, 100.0, 2e-3, None, 234.15),
}


class Found(NamedTuple):
    """An answer; ``estimate`` is the relative error that it owns up to."""

    failure: str  # name of the status, or "" if the numbers are a solution
    ratio: float
    torque: float
    estimate: float = 0.0


@cache
def true_balance(point: Hazard, preset: str | None = None) -> Found:
    """Return the answer of the ``fine`` mesh from nothing, to the equations of a preset."""
    return _ours(point, "fine", warm=False, preset=preset)


def balance() -> Group:
    """Judge methods to find the washer's balance; those that start warm start where they were."""
    base = partial(Plain2006, grid=MESH, tolerance=1e-4)
    rivals: dict[str, Any] = {
        "Newton, undamped, level start": _rival(partial(base, limited=False, level=True)),
        "Newton, limited, cold; temperatures substituted": _rival(partial(base, share=1.0)),
        "Newton, limited, cold; temperatures relaxed": _rival(base),
        "Newton, limited, warm; temperatures relaxed": _rival(base, warm=True),
    }
    ours: dict[str, Any] = {
        "steps in film thickness": _curve,
        "map": partial(_ours, fidelity="map", warm=True),
        "field, the default, cold": partial(_ours, fidelity="field", warm=False),
        "field, the default, warm": partial(_ours, fidelity="field", warm=True),
    }

    def judge(method: Any, hazard: Hazard) -> Cell:
        preset = "paper" if method in rivals.values() else None  # whose equations it solves
        true, found = true_balance(hazard, preset), method(hazard)
        return Cell(NONE) if found is None else judged(true, found)

    words = f"film ratio off by more than {WRONG_RATIO:g}: another branch"
    return table("the washer's balance", words, rivals | ours, HAZARDS, judge)


def judged(true: Found, found: Found) -> Cell:
    """Compare an answer with the true one."""
    if found.failure:
        return Cell(SAYS, "", found.failure)
    if not (math.isfinite(found.ratio) and math.isfinite(found.torque)):
        return Cell(LIES, "NaN", "not finite, status OK")
    words = f"film ratio {found.ratio:.3g}, true {true.ratio:.3g}"
    if abs(found.ratio - true.ratio) <= max(WRONG_RATIO, 0.05 * true.ratio):
        return Cell(OK, "", words)
    if abs(found.torque - true.torque) <= found.estimate * abs(true.torque):
        return Cell(SAYS, f"within {100 * found.estimate:.0f} %", f"{words}; so it estimates")
    return Cell(LIES, f"{found.ratio:.1f} for {true.ratio:.1f}", words)


def _rival(make: Any, *, warm: bool = False) -> Any:
    """Return how the method of 2006 solves a point, from the point before if ``warm``."""

    def solve(point: Hazard) -> Found | None:
        washer = make()
        if warm and point.before is None:
            return None
        if warm and point.before and washer.solve(*point.before, point.oil).is_failure:
            washer = make()
        status = washer.solve(point.load, point.speed, point.tilt, point.oil)
        failure = status.name if status.is_failure else ""
        return Found(failure, washer.found.film_ratio, washer.found.friction_torque)

    return solve


def _ours(point: Hazard, fidelity: str, warm: bool, preset: str | None = None) -> Found:
    """Solve with a level of the package."""
    params = preset_params(SPEC, preset, {})

    def solve(load: float, speed: float, tilt: float, start: Any = None) -> Any:
        return solve_washer(
            params,
            load=load,
            speed=speed,
            tilt=tilt,
            oil_temperature=point.oil,
            fidelity=fidelity,
            start=start,
            throw=False,
        )

    start = solve(*point.before) if warm and point.before else None
    r = solve(point.load, point.speed, point.tilt, start)
    failure = r.status.name if r.status.is_failure else ""
    return Found(failure, r.film_ratio, r.friction_torque, r.error_estimate)


def _curve(point: Hazard) -> Found:
    """Read the branch that a washer loaded from nothing is on off the whole curve of solutions."""
    curve = load_curve(
        WasherParams(),
        speed=point.speed,
        tilt=point.tilt,
        oil_temperature=point.oil,
        load_min=min(20.0, point.load),
    )
    points = [p for p in curve.points if p.branch == "film"]
    if not points or points[-1].load < point.load:
        points = [p for p in curve.points if p.branch != "film" and p.branch != "unstable"]
        points = curve.points if not points else points
    for a, b in pairwise(points):
        if a.load <= point.load <= b.load:
            x = (point.load - a.load) / (b.load - a.load)
            ratio = a.film_ratio + x * (b.film_ratio - a.film_ratio)
            return Found("", ratio, a.friction_torque + x * (b.friction_torque - a.friction_torque))
    return Found("NO_BRANCH", math.nan, math.nan)


def closed_forms() -> Group:
    """Judge closed forms at the ends of their ranges, as printed and as the package has them."""

    def printed(tilt: float) -> float:
        largest = GAP + tilt * (RIM + RADIUS - 0.5 * WIDTH)
        least = GAP + 0.5 * tilt * WIDTH
        return narrow_ring_load(1.0, 1.0, RADIUS - 0.5 * WIDTH, RIM, least, largest)

    def weight(z: float) -> float:
        return (1.0 - (1.0 - math.exp(-z)) / z) / z

    Form = tuple[Callable[[float], float], Callable[[float], float], dict[str, float]]
    tilts = {"usual": 1e-4, "far": 1e-12, "end": 1e-17, "zero": 0.0}
    times = {"usual": 1.0, "far": 1e-6, "end": 1e-9, "zero": 0.0}
    forms: dict[str, Form] = {
        "load of a narrow ring, 1/h_1^2 - 1/h_2^2": (printed, _ring, tilts),
        "mean of a heated body, (1 - (1 - exp(-z))/z)/z": (weight, _weight, times),
        "the same, the package's": (lambda z: exponential_weights(z)[2], _weight, times),
    }
    hazards = {
        "middle of its range": "usual",
        "differences of near numbers": "far",
        "the end of its range": "end",
        "zero itself": "zero",
    }

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
