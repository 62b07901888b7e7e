"""What users would take elsewhere, next to this package: processor time in one run.

    python -m pip install lmfit SALib
    python -m lab.benchmarks.peers.run [BEGINNING OF A NAME ...] [--runs 5]

Each pair does the same work in this process, in turn; medians of the processor time.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from lab.benchmarks.printed import table_head, table_row
from thrustwasher import ClutchParams, boundary_friction, calibrate, run_sweep, solve_clutch

Work = Callable[[], Any]
Pair = tuple[str, str, Work, str, Work]
ROWS = 100_000
CONSTANTS = {"shear_floor": 0.3, "stick_speed": 1.185, "decay_speed": 2.872}
BOX = {"load": (500.0, 2e3), "speed": (1.0, 20.0), "oil_temperature": (320.0, 400.0)}


def fits() -> Iterator[Pair]:
    """Give the fit of three constants of Wang's law to ``ROWS`` measured coefficients."""
    import lmfit

    part = ClutchParams(friction_law="wang")
    draw = np.random.default_rng(1)
    slip = draw.uniform(0.2, 12.0, ROWS)  # [m/s]

    def law(shear_floor: float, stick_speed: float, decay_speed: float) -> Any:
        over = np.maximum(slip - stick_speed, 0.0) / decay_speed
        ratio = shear_floor + (1.0 - shear_floor) * np.exp(-over)
        return boundary_friction(part.indentation, ratio, part.plough_weight, part.hardness_ratio)

    measured = law(**CONSTANTS) * (1.0 + 0.02 * draw.standard_normal(ROWS))
    first = lmfit.Parameters()
    for name, value in CONSTANTS.items():
        first.add(name, value=1.3 * value, min=0.1 * value, max=3.0 * value)

    def others() -> Any:
        return lmfit.minimize(lambda p: law(**p.valuesdict()) - measured, first)

    data = {"sliding_speed": slip, "load": 3e3, "friction": measured}
    at = {name: 1.3 * value for name, value in CONSTANTS.items()}

    def ours() -> Any:
        return calibrate(part, data, fit=[*CONSTANTS], at=at)

    yield f"fit of 3 constants, {ROWS} rows", "lmfit", others, "calibrate", ours


def sweeps() -> Iterator[Pair]:
    """Give the points of a Sobol analysis, solved one by one and in a table."""
    from SALib.sample import sobol

    problem = {"num_vars": len(BOX), "names": [*BOX], "bounds": [list(b) for b in BOX.values()]}
    rows = sobol.sample(problem, 1024, calc_second_order=False)
    part = ClutchParams()

    def others() -> Any:
        return [
            solve_clutch(part, **dict(zip(BOX, row, strict=True))).friction_torque
            for row in rows.tolist()
        ]

    def ours() -> Any:
        return run_sweep("clutch", points=dict(zip(BOX, rows.T, strict=True)), workers=1)

    yield f"{len(rows)} points of SALib", "a loop of solve_clutch", others, "run_sweep", ours


def units(folder: Path) -> Iterator[Pair]:
    """Give 1 s at 1 ms in FMPy: the unit written in Python, and the native one."""
    from fmpy import simulate_fmu

    from thrustwasher.fmu.build import build

    def simulated(target: str) -> Work:
        path = str(build(["WetClutch"], out=folder, target=target)[0])
        values = {"load": 3e3, "speed": 5.0}
        return lambda: simulate_fmu(
            path, stop_time=1.0, output_interval=1e-3, step_size=1e-3, start_values=values
        )

    python, native = simulated("python"), simulated("native")
    yield "FMPy, 1000 steps of WetClutch", "pythonfmu", python, "native", native


def taken(one: Work, other: Work, runs: int) -> tuple[float, float]:
    """Return the median processor times [s] of both; the first run of each does not count."""
    times: tuple[list[float], list[float]] = [], []
    for _ in range(runs + 1):
        for kept, work in zip(times, (one, other), strict=True):
            began = time.process_time()
            work()
            kept.append(time.process_time() - began)
    return statistics.median(times[0][1:]), statistics.median(times[1][1:])


def main() -> None:
    """Read the command line, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("chosen", nargs="*", help="beginnings of names; default all")
    parser.add_argument("--runs", type=int, default=5)
    given = parser.parse_args()
    table_head("work", "elsewhere", "here", "times less")
    with TemporaryDirectory() as folder:
        for pairs in (fits, sweeps, lambda: units(Path(folder))):
            for name, other, theirs, own, ours in pairs():
                if given.chosen and not name.startswith(tuple(given.chosen)):
                    continue
                one, two = taken(theirs, ours, given.runs)
                table_row(
                    name,
                    f"{other}: {1e3 * one:.4g} ms",
                    f"{own}: {1e3 * two:.4g} ms",
                    f"{one / two:.2f}",
                )


if __name__ == "__main__":
    main()
