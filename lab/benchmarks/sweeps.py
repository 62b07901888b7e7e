"""What a sweep costs: per point, and how much faster two workers are than one.

python -m lab.benchmarks.sweeps [--workers 2]

Times with everything: planning, solving, journal, table written. Run it on an idle machine.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path
from typing import Any

from thrustwasher import run_sweep
from thrustwasher.washer.parameters import SPEC

FIELD = {"load": "50:1850:n100", "speed": "136:1000:n100"}
FILM = {"load": "50:600:n100", "speed": "300:1000:n100"}
MANY = {"load": "20:600:n500", "speed": "300:1000:n200"}


def seconds(folder: Path, model: str, over: dict[str, Any], suffix: str, **options: Any) -> float:
    """Return the wall time of a sweep and its table; print a row."""
    began = time.perf_counter()
    table = run_sweep(model, over, out=folder / f"table{suffix}", **options)
    spent = time.perf_counter() - began
    failed = sum(table.failures.values())
    what = (
        f"{model} {table.fidelity}, {len(table)} points, {suffix}, {options.get('workers')} workers"
    )
    print(f"| {what} | {spent:.2f} | {1e6 * spent / len(table):.1f} | {failed} |", flush=True)
    return spent


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--workers", type=int, default=2)
    workers = parser.parse_args().workers
    run_sweep("washer", {"load": [100.0, 200.0]}, workers=1)
    run_sweep("gearmesh", {"load": [100.0, 200.0]}, workers=1)
    print("| sweep | s | us per point | failed |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        one = seconds(folder, "washer", FIELD, ".csv", workers=1)
        more = seconds(folder, "washer", FIELD, ".csv", workers=workers)
        seconds(folder, "washer", FILM, ".csv", workers=1)
        if "map" in SPEC.fidelities:
            run_sweep("washer", {"load": [100.0, 200.0]}, workers=1, fidelity="map")
            for suffix in (".csv", ".parquet"):
                seconds(folder, "washer", MANY, suffix, workers=1, fidelity="map")
        for suffix in (".csv", ".parquet"):
            seconds(folder, "gearmesh", MANY, suffix, workers=1)
    print(f"\n{workers} workers: {one / more:.2f} times as fast as 1")


if __name__ == "__main__":
    main()
