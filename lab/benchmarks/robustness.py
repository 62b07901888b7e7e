"""Does every operating point get an answer, the right one? Prints a summary; exit status 1 if not.

python -m lab.benchmarks.robustness [SEED]

A lattice (3 tilts x 6 speeds x 13 loads) and 1000 random points are solved from nothing and their
balances checked. For every tenth random point the whole load curve, walked in steps of 0.1 sigma,
says which branch is right; and random walks with warm starts must land where cold solves land.
"""

from __future__ import annotations

import math
import statistics
import sys
import time

import numpy as np

from thrustwasher import WasherParams, WasherResult, load_curve, solve_washer

PARAMS = WasherParams()
Point = dict[str, float]


def faults(r: WasherResult) -> list[str]:
    """Name what is wrong with a result: status, balances, invariants."""
    found = [] if r.status == 0 else [r.status.name]
    numbers = (r.friction_torque, r.temperature, r.temperature_max, r.film_thickness)
    if not all(math.isfinite(x) for x in numbers):
        found.append("not finite")
    if not r.temperature_max >= r.temperature >= r.oil_temperature - 1e-9:
        found.append("temperatures out of order")
    if not abs(r.fluid_load + r.contact_load - r.load) <= 1e-5 * r.load:
        found.append("load not balanced")
    if r.friction_torque * r.speed < 0.0:
        found.append("friction drives")
    return found


def lattice() -> list[Point]:
    """Return the regular points."""
    return [
        {"load": float(w), "speed": v, "tilt": t, "oil_temperature": 297.15}
        for t in (0.001, 0.002, 0.003)
        for v in (50.0, 136.0, 300.0, 545.0, 953.0, 1367.0)
        for w in np.linspace(50.0, 1850.0, 13)
    ]


def scattered(rng: np.random.Generator, n: int) -> list[Point]:
    """Return random points, half of them uniform in the logarithm of the load."""
    points = []
    for k in range(n):
        log_load = rng.uniform(math.log(5.0), math.log(3000.0))
        points.append(
            {
                "load": rng.uniform(5.0, 3000.0) if k % 2 else math.exp(log_load),
                "speed": rng.uniform(-1500.0, 1500.0),
                "tilt": rng.uniform(0.0, 0.004),
                "oil_temperature": rng.uniform(260.0, 420.0),
            }
        )
    return points


def cold(name: str, points: list[Point]) -> int:
    """Solve all from nothing; return the number of faulty answers."""
    seconds, bad = [], 0
    for point in points:
        start = time.perf_counter()
        r = solve_washer(PARAMS, **point, throw=False)
        seconds.append(time.perf_counter() - start)
        if faults(r):
            bad += 1
            print(point, faults(r))
    print(
        f"{name}: {len(points)} points, {bad} faulty; cold solve median "
        f"{1e3 * statistics.median(seconds):.1f} ms, longest {1e3 * max(seconds):.0f} ms"
    )
    return bad


def right_branch(points: list[Point]) -> int:
    """Compare the branch with the one that the whole curve names; return the disagreements."""
    wrong = multiple = 0
    for point in points:
        around = {k: v for k, v in point.items() if k != "load"}
        curve = load_curve(PARAMS, **around, load_min=5.0)
        r = solve_washer(PARAMS, **point)
        lost = next((f.load for f in curve.folds if f.kind == "film_lost"), None)
        multiple += lost is not None
        if lost is None:
            expected = "film" if r.film_ratio >= 3.0 else "contact"
        elif abs(r.load / lost - 1.0) < 1e-3:
            continue
        else:
            expected = "film" if r.load < lost else "contact"
        if r.branch != expected:
            wrong += 1
            print(point, r.branch, "expected", expected, curve.folds)
    print(f"branches: {len(points)} curves, {multiple} with folds, {wrong} wrong")
    return wrong


def warm(rng: np.random.Generator, n: int) -> int:
    """Walk at random with warm starts; compare with cold solves of the branch arrived at."""
    bad, r = 0, None
    for k, point in enumerate(scattered(rng, n)):
        if k % 3 and r is not None:  # one input moves by up to 30 %
            name = ("load", "speed", "tilt")[rng.integers(3)]
            moved = getattr(r, name) * rng.uniform(0.7, 1.3)
            point = {
                "load": r.load,
                "speed": r.speed,
                "tilt": r.tilt,
                "oil_temperature": r.oil_temperature,
                name: moved,
            }
        r = solve_washer(PARAMS, **point, start=r, throw=False)
        again = solve_washer(PARAMS, **point, branch=r.branch, throw=False)
        apart = abs(again.friction_torque - r.friction_torque)
        if faults(r) or again.status != 0 or apart > 1e-4 * abs(r.friction_torque):
            bad += 1
            print(point, r.branch, r.film_ratio, again.film_ratio, faults(r))
    print(f"warm walk: {n} steps, {bad} faulty or elsewhere than a cold solve")
    return bad


if __name__ == "__main__":
    random = np.random.default_rng(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    some = scattered(random, 1000)
    total = cold("lattice", lattice()) + cold("random", some)
    sys.exit(bool(total + right_branch(some[::10]) + warm(random, 400)))
