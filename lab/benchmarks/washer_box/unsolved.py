"""How many random washers and points stay unsolved, and what the slowest solves take.

python -m lab.benchmarks.washer_box.unsolved [--washers 2000] [--points 2000] [--fidelity field]
    [--seed 1] [--out FOLDER]

Washers: each number of the parameters that has a default is that times a factor between 1/3 and 3,
evenly in its logarithm, within its range; laws and switches are drawn evenly; inputs come from
their whole ranges. Points: the default washer, inputs from their whole ranges. Work is counted in
Newton iterations; times are of the processor and for comparison only.
"""

import argparse
import csv
import json
import math
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from thrustwasher import ParameterError, WasherParams, solve_washer

LEFT = ("thermal_mode", "thermal_start", "body_storage", "holding", "film_heat_fraction")
SPREAD = 3.0
RANGES = {
    "load": (1.0, 1e4),
    "speed": (-2000.0, 2000.0),
    "tilt": (0.0, 0.01),
    "oil_temperature": (233.15, 473.15),
}


def point(rng: np.random.Generator) -> dict[str, float]:
    """Return inputs from anywhere in their ranges, half of the loads evenly in their logarithm."""
    at = {name: float(rng.uniform(*ends)) for name, ends in RANGES.items()}
    if rng.random() < 0.5:
        at["load"] = math.exp(rng.uniform(0.0, math.log(1e4)))
    return at


def washer(rng: np.random.Generator) -> WasherParams:
    """Return a random washer that keeps the rules between parameters."""
    while True:
        given: dict[str, Any] = {}
        for field in fields(WasherParams):
            value, extra = field.default, field.metadata
            if field.name in LEFT or field.name.startswith("coupling"):
                continue
            if isinstance(value, bool):
                given[field.name] = bool(rng.random() < 0.5)
            elif isinstance(value, str):
                given[field.name] = str(rng.choice(list(extra["options"])))
            elif value:
                times = SPREAD ** rng.uniform(-1.0, 1.0)
                drawn = float(value) * times
                given[field.name] = min(max(drawn, extra["min"]), extra["max"])
        if given["gear_far_face"] == "bulk":
            given["gear_far_face"] = "oil"
        inner, outer = sorted((given["inner_radius"], given["outer_radius"]))
        given["inner_radius"], given["outer_radius"] = inner, outer
        given["gear_inner_radius"] = inner + rng.uniform(0.1, 0.9) * (outer - inner)
        try:
            return WasherParams(**given)
        except ParameterError:
            continue


def tasks(kind: str, n: int, seed: int) -> Iterator[tuple[WasherParams, dict[str, float]]]:
    """Yield the same washers and points for a seed, whatever the solver does."""
    for i in range(n):
        rng = np.random.default_rng((seed, i))
        yield (washer(rng) if kind == "washers" else WasherParams()), point(rng)


def solved(params: WasherParams, at: dict[str, float], fidelity: str) -> dict[str, Any]:
    """Return what became of a point."""
    began = time.process_time()
    r = solve_washer(params, **at, fidelity=fidelity, throw=False)
    return {
        **at,
        "status": r.status.name,
        "failed": r.status.is_failure,
        "iterations": r.iterations,
        "seconds": time.process_time() - began,
        "torque": r.friction_torque,
        "film_ratio": r.film_ratio,
        "branch": r.branch,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--washers", type=int, default=2000)
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--fidelity", default="field")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path)
    asked = parser.parse_args()
    for kind, n in (("washers", asked.washers), ("points", asked.points)):
        rows = []
        for i, (params, at) in enumerate(tasks(kind, n, asked.seed)):
            rows.append({"number": i, **solved(params, at, asked.fidelity)})
        if not rows:
            continue
        failed = [row for row in rows if row["failed"]]
        counts = Counter(row["status"] for row in failed)
        used = sorted(row["iterations"] for row in rows)
        print(
            f"{kind}: {len(failed)} of {n} unsolved ({100 * len(failed) / n:.2f} %): {dict(counts)}"
        )
        shares = {f"{100 * q:g} %": used[min(n - 1, int(q * n))] for q in (0.5, 0.9, 0.99, 0.999)}
        print(f"  iterations: {json.dumps(shares)}, most {used[-1]}")
        print("  the ten slowest:")
        for row in sorted(rows, key=lambda row: -row["iterations"])[:10]:
            print("   ", {k: row[k] for k in ("number", "status", "iterations", "seconds")})
        if asked.out:
            asked.out.mkdir(parents=True, exist_ok=True)
            path = asked.out / f"{kind}-{asked.fidelity}-{asked.seed}.csv"
            with path.open("w", newline="") as file:
                table = csv.DictWriter(file, rows[0])
                table.writeheader()
                table.writerows(rows)


if __name__ == "__main__":
    main()
