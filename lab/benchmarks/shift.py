"""A shift at a tolerance against the default levels everywhere: how fast, and how far apart.

python -m lab.benchmarks.shift [--tolerance 0.01] [--scene planetary] [--repeats 9] [--converged]

Native FMUs through FMPy, one process, one thread; medians over repeats, quartiles in brackets. The
time of a run is that of its communication steps; choice and check stand apart, because
they are made once for a scene, and so do building, loading and the first solve.
``--converged`` also runs the finest level of every part at an eighth of the step, which takes
minutes: the truth that both runs are compared with. Counts need no machine.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np

from lab.benchmarks.printed import table_head, table_row
from thrustwasher.fmu.fmu_cache import fmu_paths
from thrustwasher.fmu.stepper import Instance
from thrustwasher.shift import Scene, ShiftResult, load_scene, run_auto, with_fidelities

FINER = 8  # the converged run's steps, for each of the scene's


@contextmanager
def maker(scene: Scene) -> Iterator[Callable[[str, Any], Instance]]:
    """Give a function that makes an instance of a part, or resets the one it has."""
    paths = fmu_paths((part.spec.name for part in scene.parts.values()), "native")
    made: dict[tuple[str, str], Instance] = {}
    with ExitStack() as alive:

        def make(name: str, part: Any) -> Instance:
            key = name, part.fidelity
            if key in made:
                made[key].reset()
            else:
                new = Instance(paths[part.spec.name], parameters=part.parameters(), name=name)
                made[key] = alive.enter_context(new)
            return made[key]

        yield make


def repeated(scene: Scene, repeats: int) -> tuple[list[ShiftResult], list[float]]:
    """Return the results of equal runs and the seconds each took as a whole; the first is left."""
    results, whole = [], []
    with maker(scene) as make:
        for _ in range(repeats + 1):
            begin = time.perf_counter()
            results.append(run_auto(scene, make))
            whole.append(time.perf_counter() - begin)
    return results[1:], whole[1:]


def said(seconds: list[float]) -> str:
    """Return median and quartiles in ms."""
    low, middle, high = (1e3 * q for q in statistics.quantiles(seconds, n=4))
    return f"{middle:.1f} ms ({low:.1f} .. {high:.1f})"


def figures(r: ShiftResult) -> dict[str, float]:
    """Return what a shift is evaluated by, temperatures as rises above the oil."""
    found = {
        "slip energy [J]": r.figures["slip_energy"],
        "lock-up time [s]": r.figures["lock_time"],
        "peak of the clutch's interface, rise [K]": peak(r, "clutch"),
        "peak of the washer's film, rise [K]": peak(r, "washer"),
        "washer, maximum torque [N.m]": float(np.max(np.abs(torque(r)))),
        "heat of the washers [J]": r.energy["washers"],
    }
    return {name: float(value or 0.0) for name, value in found.items()}


def peak(r: ShiftResult, part: str) -> float:
    return float(r.signals[f"{part}.temperature"].max()) - r.scene.oil_temperature


def torque(r: ShiftResult) -> Any:
    return r.signals["washer.friction_torque"]


def compare(run: ShiftResult, others: dict[str, ShiftResult]) -> None:
    """Print the figures of a run and how far others' are from them, in percent."""
    mine = figures(run)
    table_head("figure", "at the tolerance", *others)
    for name, value in mine.items():
        off = [100.0 * (value / figures(o)[name] - 1.0) for o in others.values()]
        table_row(name, f"{value:.7g}", *(f"{x:+.4f} %" for x in off))
    for title, other in others.items():
        theirs = np.interp(run.time, other.time, torque(other))
        worst = 100.0 * np.max(np.abs(torque(run) - theirs)) / np.max(np.abs(theirs))
        print(f"washer torque against {title}: at most {worst:.3f} % of its maximum apart")


def calls(r: ShiftResult) -> str:
    """Return the calls of each part and level, and the points of the check."""
    points = sum(c.points + len(c.failed) for c in r.guard.checks) if r.guard else 0
    counted = [f"{c.part} {c.fidelity} {c.steps}" for c in r.cost]
    return ", ".join([*counted, f"points of the check {points}"])


def converged(scene: Scene) -> ShiftResult:
    """Return the finest levels at a small step."""
    wishes = [f"{n}={list(p.spec.fidelities)[-1]}" for n, p in scene.parts.items()]
    fine = with_fidelities(scene, wishes).with_options(step=scene.step / FINER)
    with maker(fine) as make:
        return run_auto(fine, make)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="planetary")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--converged", action="store_true")
    given = parser.parse_args()
    default = load_scene(given.scene)
    wishes = [f"{n}={p.spec.default_fidelity}" for n, p in default.parts.items()]
    default = with_fidelities(default, wishes)
    asked = with_fidelities(default, [f"auto:{given.tolerance}"])
    slow, _ = repeated(default, given.repeats)
    quick, whole = repeated(asked, given.repeats)
    times = [[r.wall_time for r in runs] for runs in (slow, quick)]
    ratio = statistics.median(times[0]) / statistics.median(times[1])
    print(*(quick[-1].selection.words() if quick[-1].selection else []), sep="\n")
    print(f"\ndefault fidelity levels: {said(times[0])}; {calls(slow[-1])}")
    print(f"at {given.tolerance:g}: {said(times[1])}, {ratio:.1f} times faster; {calls(quick[-1])}")
    print(f"with choice and check: {said(whole)}")
    if quick[-1].guard:
        checks = [r.guard.seconds for r in quick if r.guard]
        print(f"guard, {said(checks)}: {quick[-1].guard.closing()}\n")
    others = {"default fidelity levels, off by": slow[-1]}
    if given.converged:
        others["converged, off by"] = converged(default)
    compare(quick[-1], others)


if __name__ == "__main__":
    main()
