"""What errors are measured against: finest meshes, extrapolated, with an uncertainty of its own."""

from __future__ import annotations

from ..models.washer import solve_washer
from ..models.washer_params import WasherParams
from .cases import Case
from .measure import Truth

FAMILY = ((19, 64), (28, 96), (37, 128))  # intervals 2 : 4/3 : 1
CLUTCH_STEPS = (4e-4, 2e-4, 1e-4)  # s
QUICK = ((13, 40), (19, 64), (28, 96))


def washer_truth(case: Case, *, quick: bool = False) -> Truth:
    """Return converged torque, temperature and film thickness of a washer case.

    Two pairs of meshes are extrapolated with second order; the finer pair is the value. Their
    difference, and a fifth of what the finer extrapolation added, is the uncertainty.
    """
    params, family = WasherParams(), QUICK if quick else FAMILY
    results = []
    for grid in family:
        result = None
        for load, speed, tilt, oil in (*case.before, case.point):
            result = solve_washer(
                params, load=load, speed=speed, tilt=tilt, oil_temperature=oil, grid=grid,
                start=result,
            )  # fmt: skip
        results.append(result)
    values, uncertainty = {}, {}
    for name in ("friction_torque", "temperature", "film_thickness"):
        a, b, c = (getattr(r, name) for r in results)
        n = [grid[0] - 1 for grid in family]
        near = b + (b - a) / ((n[1] / n[0]) ** 2 - 1.0)
        far = c + (c - b) / ((n[2] / n[1]) ** 2 - 1.0)
        values[name] = far
        uncertainty[name] = max(abs(far - near), 0.2 * abs(far - c))
    return Truth(values, uncertainty)


def gearmesh_truth(case: Case) -> Truth:
    """Return the values of the finest rung of a gear mesh case, and how far iteration can err."""
    from ..models.gearmesh_params import SPEC
    from .ways import KernelWay

    finest = list(SPEC.fidelities)[-1]
    answer = KernelWay(SPEC, finest).solve(case)
    values = {name: answer.values[name] for name in ("friction_torque", "temperature")}
    return Truth(values, {"friction_torque": 1e-9 * abs(values["friction_torque"]),
                          "temperature": 1e-6})  # fmt: skip


def clutch_truth(case: Case) -> Truth:
    """Return slip energy and peak temperature of an engagement, from the finest rung.

    Three steps, each half the one before; the two finest are extrapolated with second order. What
    that adds, and its difference to the same of the coarser two, is the uncertainty.
    """
    from ..models.clutch_params import SPEC
    from .ways_clutch import ClutchWay

    finest = list(SPEC.fidelities)[-1]
    a, b, c = (ClutchWay(finest, step).solve(case).values for step in CLUTCH_STEPS)
    values, uncertainty = {}, {}
    for name in a:
        near, far = b[name] + (b[name] - a[name]) / 3.0, c[name] + (c[name] - b[name]) / 3.0
        values[name] = far
        uncertainty[name] = max(abs(far - near), abs(far - c[name]))
    return Truth(values, uncertainty)
