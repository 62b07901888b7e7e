"""Searches next to random designs: times, and how far 20 000 random designs stay behind.

``python -m lab.benchmarks.optimise [--random N] [--only curve|shift|robust]``; takes half an hour
with 20 000. The figures are those of docs/command-line/optimise.md.
"""

import argparse
import time
from typing import Any

import numpy as np

from thrustwasher import optimise
from thrustwasher.studio.optimisation.front import unbeaten
from thrustwasher.studio.optimisation.whole_search import designs_of
from thrustwasher.studio.optimisation.worker_pool import WorkerPool

CURVE = {
    "target": "washer",
    "at": {"speed": 545.0, "tilt": 0.002},
    "maximise": "film_lost_load",
    "vary": {
        "roughness": "0.3 um:1 um",
        "washer_thickness": "0.5 mm:2 mm",
        "inner_radius": "8 mm:12 mm",
        "dry_friction": "0.05:0.15",
    },
}
SHIFT: dict[str, Any] = {
    "target": "planetary",
    "minimise": ["slip_energy", "peak_jerk"],
    "vary": {
        "pressure.clutch.points.1": "30 kPa:60 kPa",
        "pressure.clutch.points.3": "200 kPa:400 kPa",
        "pressure.clutch.points.4": "250 kPa:450 kPa",
        "pressure.clutch.points.5": "250 kPa:500 kPa",
        "pressure.brake.points.2": "450 kPa:650 kPa",
        "pressure.brake.points.3": "40 kPa:200 kPa",
        "clutch.land_share": "0.6:0.95",
        "clutch.friction_scale": "0.8:1.2",
    },
}
ROBUST: dict[str, Any] = SHIFT | {
    "minimise": "slip_energy",
    "limits": ["peak_jerk<=90", "lock_time<=0.95"],
    "robust": 0.95,
}


def random_designs(found: Any, asked: dict[str, Any], n: int) -> np.ndarray:
    """Return costs (m, goals) of random designs that have the figures, inside the limits."""
    designs = designs_of(asked["target"], asked.get("at", {}), "below")
    problem, random = found.problem, np.random.default_rng(7)
    rows = [problem.row(u) for u in random.random((n, len(problem.variables)))]
    began = time.perf_counter()
    with WorkerPool(designs, problem, planned=n) as pool:
        values = pool.figures(rows, problem.figures)
    sound = np.isfinite(values).all(1) & (problem.excess(values) <= 0.0).all(1)
    print(
        f"  {n} random designs in {time.perf_counter() - began:.0f} s, {sound.sum()} of them sound"
    )
    return problem.costs(values[sound])


def main() -> None:
    """Run the searches, then the random designs."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--random", type=int, default=20_000)
    parser.add_argument("--only")
    given = parser.parse_args()
    for name, asked in {"curve": CURVE, "shift": SHIFT, "robust": ROBUST}.items():
        if given.only not in (None, name):
            continue
        found = optimise(**asked)
        goals = found.problem.goals
        print(f"{name}: {found.wall_time:.1f} s, {found.tries} designs tried", flush=True)
        print(f"  {[f'{g.words} {found.best.figures[g.figure.name]:.6g}' for g in goals]}")
        print(f"  binds: {', '.join(found.binding)}; {found.share}")
        if not given.random or found.share:
            continue
        costs = random_designs(found, asked, given.random)
        if len(goals) == 1:
            best = found.problem.costs(found.tried[:, :1])
            print(f"  best of the search {np.nanmin(best):.6g}, at random {costs.min():.6g}")
            continue
        front = found.problem.costs(found.tried)
        front = front[unbeaten(front)]
        better = sum(not (front <= c).all(1).any() for c in costs)
        print(f"  {better} random designs are not beaten by the front")


if __name__ == "__main__":
    main()
