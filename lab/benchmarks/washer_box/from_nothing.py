"""Solves from nothing of two versions at the same random places: branch, torque, time.

    git worktree add ../before v0.22.0
    python -m lab.benchmarks.washer_box.from_nothing --before ../before [--points 2000] [--seed 1]

Default washer, `field`. Places in and around the box of its map: 10 .. 2500 N, 20 .. 1500 rad/s,
0.6 .. 4 mrad, oil 285 .. 410 K, even in their logarithms. Without ``--before`` the solves that
start where a map says are compared with those of this checkout that do not. The versions take
turns at blocks of places; times are of the processor.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from lab.benchmarks.printed import table_head, table_row

HERE = Path(__file__).parents[3]
LOW, HIGH = (10.0, 20.0, 6e-4, 285.0), (2500.0, 1500.0, 4e-3, 410.0)
BLOCK = 100
SOLVES = """
import json, sys, time
from thrustwasher import WasherParams, solve_washer
from thrustwasher.washer import solve
if {plain}:
    solve._map_guess = lambda: lambda *_: None
params, names = WasherParams(), ("load", "speed", "tilt", "oil_temperature")
solve_washer(params, load=300.0, speed=953.0, tilt=0.002)
found = []
for place in json.load(sys.stdin):
    point, began = dict(zip(names, place)), time.process_time()
    r = solve_washer(params, **point, throw=False)
    took = time.process_time() - began
    found.append([str(r.status), str(r.branch), bool(r.distress), r.friction_torque, took])
json.dump(found, sys.stdout)
"""


def solved(places: list[list[float]], source: Path, plain: bool) -> list[list[Any]]:
    """Return status, branch, distress, torque [N m] and time [s] of each place."""
    settings = {**os.environ, "PYTHONPATH": str(source)}
    words = [sys.executable, "-c", SOLVES.format(plain=plain)]
    done = subprocess.run(
        words,
        input=json.dumps(places),
        env=settings,
        cwd=source,
        capture_output=True,
        text=True,
        check=True,
    )
    return list(json.loads(done.stdout))


def main() -> int:
    """Read the command line, solve, print the table; 1 if a branch differs."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--before", type=Path, help="folder with the other version's package")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    old = HERE if given.before is None else given.before.resolve()
    draw = np.random.default_rng(given.seed)
    places = np.exp(draw.uniform(np.log(LOW), np.log(HIGH), (given.points, 4))).tolist()
    before: list[list[Any]] = []
    after: list[list[Any]] = []
    for k in range(0, len(places), BLOCK):
        block = places[k : k + BLOCK]
        before += solved(block, old, given.before is None)
        after += solved(block, HERE, False)
    other = [(p, a, b) for p, a, b in zip(places, before, after, strict=True) if a[:3] != b[:3]]
    same = [(a, b) for a, b in zip(before, after, strict=True) if a[:3] == b[:3]]
    apart = [abs(b[3] / a[3] - 1.0) for a, b in same if a[3]]
    ratios = [a[4] / b[4] for a, b in same]
    table_head("figure", "value")
    table_row("points, same status, branch and distress", f"{len(places)}, {len(same)}")
    table_row("largest and median change of torque", f"{max(apart):.1e}, {np.median(apart):.1e}")
    for name, rows in (("before", before), ("after", after)):
        took = [1e3 * row[4] for row in rows]
        table_row(f"{name}: median, sum", f"{statistics.median(took):.2f} ms, {sum(took):.0f} ms")
    table_row("times less, median of the points'", f"{statistics.median(ratios):.2f}")
    for place, a, b in other:
        table_row(", ".join(f"{x:.6g}" for x in place), f"{a[:4]} {b[:4]}")
    return 1 if other else 0


if __name__ == "__main__":
    raise SystemExit(main())
