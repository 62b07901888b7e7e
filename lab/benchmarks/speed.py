"""What a washer solve costs: warm, cold, curve; where its time goes; what a newcomer waits for.

python -m lab.benchmarks.speed [--start | --python | --washer]

``--start``: only whole processes by the wall clock, everything compiled and the FMUs built, and
what Python adds to a solve. ``--python``: only calls from Python and sweeps, processor time;
``--washer``: only solves of the washer, from nothing, warm and in time, processor time. One
thread; medians over repeats, minima in brackets. Run it on an idle machine, two versions in turn:
``PYTHONPATH=FOLDER python lab/benchmarks/speed.py --python`` measures the one in that folder.
"""

from __future__ import annotations

import itertools
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from lab.benchmarks.printed import median_and_least, table_head, table_row
from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    WasherParams,
    WasherResult,
    load_curve,
    run_sweep,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.washer import follow, solve
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import gap, heat, heat_factor, layout, newton
from thrustwasher.washer.kernels.constants import washer_model
from thrustwasher.washer.kernels.continuation import cold_start
from thrustwasher.washer.kernels.film import evaluate_film, film_solve
from thrustwasher.washer.kernels.workspace import Point, fields_of, size_of_work, workspace_of

PARAMS = WasherParams()
POINTS = [
    ("full film", 545.0, 300.0),
    ("full film", 953.0, 300.0),
    ("transition", 136.0, 320.0),
    ("transition", 545.0, 700.0),
    ("boundary", 136.0, 1361.0),
    ("contact", 545.0, 1200.0),
    ("contact", 1367.0, 1000.0),
]

FIRST = (
    "from thrustwasher import *; import sys; "
    "solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002); "
    "sys.exit('numba' in sys.modules)"
)
SHIFT = ["-m", "thrustwasher", "shift"]
PROCESSES = {
    "bare interpreter": ["-c", "pass"],
    "Python, numpy imported": ["-c", "import numpy"],
    "import thrustwasher": ["-c", "import thrustwasher"],
    "a first solve": ["-c", FIRST],
    "thrustwasher shift": SHIFT,
    "shift --fidelity auto:0.01 --json --no-report": [
        *SHIFT,
        "--fidelity",
        "auto:0.01",
        "--json",
        "--no-report",
    ],
}


def timed(work: Callable[[], object], repeats: int) -> tuple[float, float]:
    """Return median and minimum seconds of a call."""
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds), min(seconds)


def washers() -> None:
    """Print what solves from nothing, warm ones and steps in time cost."""
    table_head("point", "from nothing, ms", "warm us, load +-1 %", "iterations")
    cold_all, warm_all = [], []
    for name, speed, load in POINTS:
        cold_solve = partial(solve_washer, PARAMS, load=load, speed=speed, tilt=0.002)
        base = cold_solve()
        cold, warm = processor_time(cold_solve, 10), processor_time(neighbours(base), 40)
        cold_all.append(cold[0])
        warm_all.append(warm[0])
        times = median_and_least(cold, 1e3, ".2f"), median_and_least(warm, 1e6, ".0f")
        table_row(f"{name}, {speed:g} rad/s, {load:g} N", *times, base.iterations)
    table_row(
        "median",
        f"{1e3 * statistics.median(cold_all):.2f}",
        f"{1e6 * statistics.median(warm_all):.0f}",
        "",
    )
    n, draw = 40, np.random.default_rng(1)
    cases = {
        "coming to rest, 50 to 5 rad/s": (np.geomspace(50.0, 5.0, n), np.full(n, 500.0)),
        "swinging through rest": (20.0 * np.sin(np.linspace(0.1, 7.0, n)), np.full(n, 500.0)),
        "jumps": (draw.uniform(10.0, 1300.0, n), draw.uniform(20.0, 1800.0, n)),
    }
    table_head("in time, steps of 10 ms", "heat", "ms a step")
    for (name, (speeds, loads)), mode in itertools.product(
        cases.items(), ("quasi_steady", "transient")
    ):
        rows = np.column_stack([loads, speeds, np.full(n, 2e-3), np.full(n, 297.15), np.zeros(n)])
        run = follow.Follower(replace(PARAMS, thermal_mode=mode), (10, 32))

        def steps() -> None:
            run.state[:] = 0.0  # noqa: B023 (called in this turn)
            for i, row in enumerate(rows):  # noqa: B023
                run._step(row, 0.01 if i else 1e-12)  # noqa: B023

        seconds = processor_time(steps, 1)
        table_row(name, mode, median_and_least(seconds, 1e3 / n, ".2f"))


def neighbours(base: WasherResult) -> Callable[[], WasherResult]:
    """Return a call that solves 1 % above or below ``base``, starting from it."""
    signs = iter(np.random.default_rng(0).choice((-1.0, 1.0), 1000).tolist())

    def solve() -> WasherResult:
        load = base.load * (1.0 + 0.01 * next(signs))
        return solve_washer(PARAMS, load=load, speed=base.speed, tilt=0.002, start=base)

    return solve


def solves() -> None:
    """Print warm and cold solves point by point."""
    table_head("point", "cold ms", "warm us, load +-1 %", "iterations")
    warm_all, cold_all = [], []
    for name, speed, load in POINTS:
        cold_solve = partial(solve_washer, PARAMS, load=load, speed=speed, tilt=0.002)
        base = cold_solve()
        cold = timed(cold_solve, 15)
        iterations = neighbours(base)().iterations
        warm = timed(neighbours(base), 400)
        warm_all.append(warm[0])
        cold_all.append(cold[0])
        what = f"{name}, {speed:g} rad/s, {load:g} N"
        times = median_and_least(cold, 1e3, ".1f"), median_and_least(warm, 1e6, ".0f")
        table_row(what, *times, iterations)
    print(
        f"\nmedian of points: cold {1e3 * statistics.median(cold_all):.1f} ms, "
        f"warm {1e6 * statistics.median(warm_all):.0f} us"
    )


def curve() -> None:
    """Print the cost of whole load curves."""
    for speed in (136.0, 545.0, 1367.0):
        load_curve(PARAMS, speed=speed, tilt=0.002)
        t = timed(partial(load_curve, PARAMS, speed=speed, tilt=0.002), 7)
        print(f"load curve at {speed:g} rad/s: {t[0]:.3f} s ({t[1]:.3f})")


def starts() -> None:
    """Print what a newcomer waits for, and what Python adds to a solve."""
    table_head("what", "median (minimum)")
    with tempfile.TemporaryDirectory() as folder:
        for name, words in PROCESSES.items():
            run = partial(
                subprocess.run,
                [sys.executable, *words],
                check=True,
                cwd=folder,
                capture_output=True,
            )
            run()
            table_row(f"{name}, new process", median_and_least(timed(run, 5), 1.0, ".3g") + " s")
    point = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
    start = solve_washer(PARAMS, **point)
    ready, state = solve._prepared(PARAMS, start.grid), start._state.copy()
    ready.inp[:] = (*point.values(), 297.15, 0.0, 0.0)
    calls: dict[str, Callable[[], object]] = {
        "solve_washer, fidelity map": lambda: solve_washer(PARAMS, fidelity="map", **point),
        "solve_washer, field, warm": lambda: solve_washer(PARAMS, start=start, **point),
        "of it the compiled step": lambda: ready.step(state, 0.0, 1.0),
    }
    found = [timed(call, 10_000) for call in calls.values()]
    added = tuple(a - b for a, b in zip(found[1], found[2], strict=True))
    names = [*calls, "what Python adds to a warm solve"]
    for name, seconds in zip(names, [*found, added], strict=True):
        table_row(name, median_and_least(seconds, 1e6, ".3g") + " us")


def python_calls() -> None:
    """Print what one call costs; the torque is read, once with all warnings."""
    pack, mesh, small = ClutchParams(), GearMeshParams(), itertools.count(1)
    washer = partial(solve_washer, PARAMS, load=300.0, speed=953.0, tilt=0.002, fidelity="map")
    clutch = partial(solve_clutch, load=3000.0, speed=10.0)
    gears = partial(solve_gearmesh, power=7500.0, speed=180.0)

    def new_pack() -> ClutchParams:
        return ClutchParams(friction_scale=1.0 - 1e-7 * next(small))

    def new_mesh() -> GearMeshParams:
        return GearMeshParams(face_width=0.02 - 1e-9 * next(small))

    calls: dict[str, Callable[[], object]] = {
        "ClutchParams()": new_pack,
        "GearMeshParams()": new_mesh,
        "solve_clutch": lambda: clutch(pack).friction_torque,
        "solve_clutch, warnings too": lambda: clutch(pack).warnings,
        "solve_clutch, a new pack": lambda: clutch(new_pack()).friction_torque,
        "solve_gearmesh": lambda: gears(mesh).friction_torque,
        "solve_gearmesh, warnings too": lambda: gears(mesh).warnings,
        "solve_gearmesh, new gears": lambda: gears(new_mesh()).friction_torque,
        "solve_washer, map": lambda: washer().friction_torque,
    }
    table_head("call", "us of processor time")
    for name, call in calls.items():
        table_row(name, median_and_least(processor_time(call, 300), 1e6, ".3g"))


def processor_time(work: Callable[[], object], n: int) -> tuple[float, float]:
    """Return median and minimum of five, of a call that is made ``n`` times each."""
    work()
    seconds = []
    for _ in range(5):
        start = time.process_time()
        for _ in range(n):
            work()
        seconds.append((time.process_time() - start) / n)
    return statistics.median(seconds), min(seconds)


def sweeps() -> None:
    """Print what a point of a sweep over two inputs costs, on a grid of 1e5, in this process."""
    grids = {
        "clutch closed": ("clutch", {"load": "1 kN:9 kN:n{}", "speed": "1:200:n{}"}),
        "gearmesh field": ("gearmesh", {"power": "1000:9000:n{}", "speed": "50:500:n{}"}),
        "washer map": ("washer", {"load": "100:900:n{}", "speed": "300:1300:n{}"}),
    }
    table_head("sweep", "us of processor time a point")
    with tempfile.TemporaryDirectory() as folder:
        for (name, (model, over)), ending in itertools.product(
            grids.items(), ("", ".csv", ".parquet")
        ):

            def run(n: int) -> None:
                run_sweep(
                    model,  # noqa: B023 (called in this turn)
                    {key: text.format(n) for key, text in over.items()},  # noqa: B023
                    fidelity=name.split()[1],  # noqa: B023
                    out=Path(folder) / f"table{ending}" if ending else None,  # noqa: B023
                    workers=1,
                    keep=not ending,  # noqa: B023
                )

            run(3)
            seconds = processor_time(partial(run, 316), 1)
            table_row(f"{name} {ending}", median_and_least(seconds, 1e6 / 316**2, ".3g"))


def profile() -> None:
    """Print microseconds of the parts of one warm iteration at 545 rad/s, 300 N."""
    par = constants(PARAMS, (10, 32))
    w = workspace_of(par, np.zeros(layout.N_HEAD + size_of_work(10, 32)))
    m, f, q = washer_model(par), fields_of(w), w.q
    pt = Point(300.0, 545.0, 0.002, 297.15, 297.15)
    cold_start(w, pt, 13.0)
    newton.newton(w, pt, newton.LOAD, 300.0, -100.0, 1e-9, 40.0)
    empty, _ = timed(lambda: newton.smooth_film(w), 2000)
    parts: list[tuple[str, Callable[[], object]]] = [
        ("gaps and contact", lambda: gap.evaluate_gaps(m, pt, q, f)),
        ("viscosity", lambda: gap.evaluate_viscosity(m, pt, f)),
        ("heat residual", lambda: heat.heat_residual(m, pt, f.temp, f)),
        ("film conductances", lambda: evaluate_film(m, pt, q, f)),
        ("heat, back substitution", lambda: heat_factor.solve_heat(m, f.heat, f.dtemp, f)),
        ("film, five right sides", lambda: film_solve(m, f.p, f)),
        ("heat, factor (cold only)", lambda: heat_factor.factor_heat(m, pt, f)),
    ]
    for name, work in parts:
        work()
        print(f"{name}: {1e6 * (timed(work, 2000)[0] - empty):.1f} us")


if __name__ == "__main__":
    if "--washer" in sys.argv:
        washers()
        sys.exit()
    if "--python" in sys.argv:
        python_calls()
        sweeps()
        sys.exit()
    if "--start" not in sys.argv:
        solves()
        curve()
        profile()
    starts()
