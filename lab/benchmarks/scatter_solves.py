"""Washers of scattered parameters: what a draw costs, whether it is right, what a study takes.

    python -m lab.benchmarks.scatter_solves            time of a draw, before and after, in one run
    python -m lab.benchmarks.scatter_solves --study    6144 solves against plain runs, folds

Before is ``solve_washer`` on each draw, after ``PartEvaluator.evaluate`` on all of them. Every draw
is compared: branch, and torque within 1e-6. Some 4 minutes with --study, which uses all cores.
"""

import argparse
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from thrustwasher import load_curve, propagate, solve_washer
from thrustwasher.model.part_file import PartFile, find_part
from thrustwasher.processes import runner, usable_cores
from thrustwasher.studio.evaluators.part import part_evaluator
from thrustwasher.studio.scatter.design import make_design
from thrustwasher.studio.scatter.target import target_of

SURFACES = {"roughness": "15 %", "viscosity_scale": "8 %"}
LOAD = {"load": {"uniform": [100.0, 1800.0]}}
SCATTERS = {
    "tilt": ({}, {**SURFACES, "tilt": {"lognormal": 1.6}, **LOAD}),
    "dry friction": (
        {"friction_law": "constant"},
        {**SURFACES, "dry_friction": {"lognormal": 1.6}, **LOAD},
    ),
}
POINTS = 64  # base points of the comparison
PLAIN_RUNS = 20_000
BRANCH = {"below": None, "above": "contact"}


def part_with(**parameters: Any) -> PartFile:
    """Return the default washer with some parameters of its own."""
    return replace(find_part("washer"), parameters=parameters)


def draws_of(scatter: Any, kind: str) -> list[dict[str, Any]]:
    """Return draws as a study makes them, or of independent base points."""
    k = len(scatter.sources)
    groups = [(i,) for i in range(k)] if kind == "with indices" else []
    n = POINTS if groups else POINTS * (k + 2)
    design = make_design(1 << (n - 1).bit_length(), k, groups, 1)
    rows = np.concatenate([u for _, u in design.batches()])[: POINTS * (k + 2)]
    found: list[dict[str, Any]] = scatter.values(rows)
    return found


def plain(part: PartFile, row: dict[str, Any], reached: str = "below") -> tuple[float, str]:
    """Solve a draw alone; return its torque and branch."""
    params, inputs = part.varied(row)
    point: Any = {**part.starts, **inputs}
    found = solve_washer(params, **point, branch=BRANCH[reached], throw=False)
    return found.friction_torque, found.branch


def compare(name: str, kind: str, reached: str) -> bool:
    """Print one line of the comparison; return whether all draws agree."""
    own, table = SCATTERS[name]
    part = part_with(**own)
    scatter = part.scattered(table)
    target = target_of(part_evaluator(part, part.starts, reached), scatter)
    rows = draws_of(scatter, kind)
    plain(part, rows[0])
    target.nominal()
    before, single = [], []
    for row in rows:
        began = time.process_time()
        single.append(plain(part, row, reached))
        before.append(1e3 * (time.process_time() - began))
    began = time.process_time()
    values, codes = target.solve(rows, np.ones(len(rows), bool))
    after = 1e3 * (time.process_time() - began) / len(rows)
    torque, lost = values[:, 0], values[:, len(target.figures)]
    contact = np.array([branch == "contact" for _, branch in single])
    off = np.abs(torque / np.array([t for t, _ in single]) - 1.0)
    wrong = int(((contact != lost) | (off > 1e-6) | (codes > 0)).sum())
    medians = [float(np.median(np.array(before)[contact == c])) for c in (False, True)]
    print(
        f"{name:14}{kind:16}{reached:8}{contact.mean():9.0%}{np.mean(before):10.2f}"
        f"{medians[0]:8.2f}{medians[1]:9.2f}{after:9.2f}{np.mean(before) / after:8.1f}"
        f"{wrong:7}{off.max():12.1e}",
        flush=True,
    )
    return wrong == 0


def compare_all() -> bool:
    """Print the comparison."""
    print("processor time of a draw in ms; before: each alone; ratio of the means\n")
    print(
        f"{'scatter of':14}{'draws':16}{'reached':8}{'contact':>9}{'before':>10}{'film':>8}"
        f"{'contact':>9}{'after':>9}{'ratio':>8}{'wrong':>7}{'torque off':>12}"
    )
    return all(
        [
            compare(name, kind, reached)
            for name in SCATTERS
            for kind in ("with indices", "independent")
            for reached in BRANCH
        ]
    )


def plain_chunk(task: tuple[PartFile, list[dict[str, Any]]]) -> list[tuple[float, str]]:
    """Solve draws alone; this runs in the workers."""
    return [plain(task[0], row) for row in task[1]]


def plain_torques(part: PartFile, scatter: Any) -> tuple[np.ndarray, float]:
    """Return the torques of independent plain runs, and the share that has lost its film."""
    rows = scatter.values(np.random.default_rng(2026).random((PLAIN_RUNS, len(scatter.sources))))
    tasks = [(part, rows[a : a + 200]) for a in range(0, len(rows), 200)]
    with runner(usable_cores()) as run:
        found = [pair for chunk in run(plain_chunk, tasks, 1) for pair in chunk]
    return np.array([t for t, _ in found]), float(np.mean([b == "contact" for _, b in found]))


def study() -> Iterator[bool]:
    """Print a study against plain runs, and parts between their folds; yield what holds."""
    part, table = part_with(), SCATTERS["tilt"][1]
    result = propagate(part, scatter=table, runs=1024)
    seconds = result.wall_time
    print(f"{result.solves} solves in {seconds:.1f} s on {usable_cores()} cores; limit 30 s")
    yield seconds <= 30.0
    torques, lost = plain_torques(part, part.scattered(table))
    band = result.figures["friction_torque"]
    for p, value in band.quantiles.items():
        low, high = band.confidence[p]
        exact = float(np.quantile(torques, p))
        print(
            f"torque, {p:4.0%} quantile: {value:.5g} N m, confidence {low:.5g} .. {high:.5g}; "
            f"{PLAIN_RUNS} plain runs: {exact:.5g}"
        )
        yield low <= exact <= high
    chance = result.probabilities["film_lost"]
    print(f"film lost: {chance.value:.4f}, {chance.low:.4f} .. {chance.high:.4f}; plain {lost:.4f}")
    yield chance.low <= lost <= chance.high
    folds = sorted(fold.load for fold in load_curve(part.params, speed=545.0, tilt=0.002).folds)
    between = {"load": {"uniform": folds}}
    for reached, expected in (("below", 0.0), ("above", 1.0)):
        got = propagate(part, scatter=between, runs=256, reached=reached, indices=False)
        value = got.probabilities["film_lost"].value
        print(
            f"load uniform over {folds[0]:.1f} .. {folds[1]:.1f} N from {reached}: P(film lost) = "
            f"{value:g}, expected {expected:g}"
        )
        yield value == expected


def main() -> int:
    """Run; return 1 if something does not hold."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", action="store_true", help="a study against plain runs")
    return 0 if (all(list(study())) if parser.parse_args().study else compare_all()) else 1


if __name__ == "__main__":
    sys.exit(main())
