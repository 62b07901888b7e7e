"""Where methods to find the washer's balance fail: by the branch they end on."""

import math
from functools import cache, partial
from itertools import pairwise
from typing import Any, NamedTuple

from ...washer.load_curve import load_curve
from ...washer.parameters import WasherParams
from ...washer.solve import solve_washer
from ..rivals.plain2006 import Plain2006
from .failure_cells import LIES, NONE, OK, SAYS, Cell, Group, table

WRONG_RATIO = 1.0  # of the film: another branch, not another mesh
MESH = (17, 67)
OIL = 297.15


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
def true_balance(point: Hazard) -> Found:
    """Return the answer of the ``fine`` mesh from nothing."""
    return _ours(point, "fine", warm=False)


def balance() -> Group:
    """Judge methods to find the washer's balance; those that start warm start where they were."""
    base = partial(Plain2006, grid=MESH, tolerance=1e-4)
    methods: dict[str, Any] = {
        "Newton, undamped, level start": _rival(partial(base, limited=False, level=True)),
        "Newton, limited, cold; temperatures substituted": _rival(partial(base, share=1.0)),
        "Newton, limited, cold; temperatures relaxed": _rival(base),
        "Newton, limited, warm; temperatures relaxed": _rival(base, warm=True),
        "steps in film thickness": _curve,
        "closed form, oil at its own temperature": partial(_ours, fidelity="closed", warm=False),
        "map": partial(_ours, fidelity="map", warm=True),
        "field, the default, cold": partial(_ours, fidelity="field", warm=False),
        "field, the default, warm": partial(_ours, fidelity="field", warm=True),
    }

    def judge(method: Any, hazard: Hazard) -> Cell:
        true, found = true_balance(hazard), method(hazard)
        return Cell(NONE) if found is None else judged(true, found)

    words = f"film ratio off by more than {WRONG_RATIO:g}: another branch"
    return table("the washer's balance", words, methods, HAZARDS, judge)


def judged(true: Found, found: Found) -> Cell:
    """Compare an answer with the true one."""
    if found.failure:
        return Cell(SAYS, "", found.failure)
    if not (math.isfinite(found.ratio) and math.isfinite(found.torque)):
        return Cell(LIES, "NaN", "not finite, status OK")
    off = f"film ratio {found.ratio:.3g}, true {true.ratio:.3g}"
    if abs(found.ratio - true.ratio) <= max(WRONG_RATIO, 0.05 * true.ratio):
        return Cell(OK, "", off)
    if abs(found.torque - true.torque) <= found.estimate * abs(true.torque):
        return Cell(SAYS, f"within {100 * found.estimate:.0f} %", f"{off}; so it estimates")
    return Cell(LIES, f"{found.ratio:.1f} for {true.ratio:.1f}", off)


def _rival(make: Any, *, warm: bool = False) -> Any:
    """Return how the method of 2006 solves a point, from the point before if ``warm``."""

    def solve(point: Hazard) -> Found | None:
        washer = make()
        if warm and point.before is None:
            return None
        if warm and point.before and washer.solve(*point.before, point.oil).is_failure:
            washer.forget()
        status = washer.solve(point.load, point.speed, point.tilt, point.oil)
        failure = status.name if status.is_failure else ""
        return Found(failure, washer.film_ratio, washer.friction_torque)

    return solve


def _ours(point: Hazard, fidelity: str, warm: bool) -> Found:
    """Solve with a rung of the package."""

    def solve(load: float, speed: float, tilt: float, start: Any = None) -> Any:
        return solve_washer(
            WasherParams(), load=load, speed=speed, tilt=tilt, oil_temperature=point.oil,
            fidelity=fidelity, start=start, throw=False,
        )  # fmt: skip

    start = solve(*point.before) if warm and point.before else None
    r = solve(point.load, point.speed, point.tilt, start)
    failure = r.status.name if r.status.is_failure else ""
    return Found(failure, r.film_ratio, r.friction_torque, r.error_estimate)


def _curve(point: Hazard) -> Found:
    """Read the branch that a washer loaded from nothing is on off the whole curve of solutions."""
    curve = load_curve(
        WasherParams(), speed=point.speed, tilt=point.tilt, oil_temperature=point.oil,
        load_min=min(20.0, point.load),
    )  # fmt: skip
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
