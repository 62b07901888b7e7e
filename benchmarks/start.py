"""What a newcomer waits for: a first solve, a shift, and what Python adds to a solve.

python benchmarks/start.py [--repeats 5]

Whole processes by the wall clock, everything compiled and the FMUs built; then microseconds of
calls in one process. Medians, minima in brackets. Run it on an idle machine.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

from thrustwasher import WasherParams, solve_washer
from thrustwasher.washer import solve

FIRST = (
    "from thrustwasher import *; import sys; "
    "solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002); "
    "sys.exit('numba' in sys.modules)"
)
SHIFT = ["-m", "thrustwasher", "shift"]
PROCESSES = {
    "Python, numpy imported": ["-c", "import numpy"],
    "a first solve": ["-c", FIRST],
    "thrustwasher shift": SHIFT,
    "shift --fidelity auto:0.01 --json --no-report": [
        *SHIFT, "--fidelity", "auto:0.01", "--json", "--no-report",
    ],
}  # fmt: skip
POINT = {"load": 300.0, "speed": 953.0, "tilt": 0.002}


def wall(words: list[str], folder: str) -> float:
    """Return the seconds a process takes."""
    began = time.perf_counter()
    subprocess.run([sys.executable, *words], check=True, cwd=folder, capture_output=True)
    return time.perf_counter() - began


def microseconds(call: Callable[[], object], n: int = 2000) -> float:
    """Return what a call takes."""
    began = time.perf_counter()
    for _ in range(n):
        call()
    return 1e6 * (time.perf_counter() - began) / n


def row(name: str, unit: str, times: list[float]) -> None:
    """Print a row."""
    print(f"| {name} | {statistics.median(times):.3g} ({min(times):.3g}) {unit} |", flush=True)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeats", type=int, default=5)
    repeats = parser.parse_args().repeats
    print("| what | median (minimum) |\n|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, words in PROCESSES.items():
            wall(words, folder)
            row(name, "s", [wall(words, folder) for _ in range(repeats)])
    params = WasherParams()
    start = solve_washer(params, **POINT)
    bench, state = solve._bench(params, "field", start.grid), start._state.copy()
    bench.inp[:] = (*POINT.values(), 297.15, 0.0)
    calls: dict[str, Callable[[], object]] = {
        "solve_washer, fidelity map": lambda: solve_washer(params, fidelity="map", **POINT),
        "solve_washer, field, warm": lambda: solve_washer(params, start=start, **POINT),
        "of it the compiled step": lambda: bench.step(state, 0.0, 1.0),
    }
    found = {name: [microseconds(call) for _ in range(repeats)] for name, call in calls.items()}
    for name, times in found.items():
        row(name, "us", times)
    warm, step = list(found.values())[1:]
    row("what Python adds to a warm solve", "us", [a - b for a, b in zip(warm, step, strict=True)])


if __name__ == "__main__":
    main()
