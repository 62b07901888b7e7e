"""Error of the washer's torque over the time of a solve, meshes of 0.19 and of now, as a chart.

    python -m lab.benchmarks.washer_box.mesh_chart measure REFERENCE.csv  # rows, printed
    python -m lab.benchmarks.washer_box.mesh_chart draw                   # docs/images

``measure`` solves at the points of a table with columns load, speed, tilt, oil_temperature,
branch, several (1: both branches exist) and torque, the converged one, in SI units. What it
printed on one machine stands in mesh_error.csv; milliseconds are processor time, for ratios only.
"""

import csv
import sys
import time
from pathlib import Path

import numpy as np

from thrustwasher import WasherParams
from thrustwasher.washer.solve import _solve
from thrustwasher.washer.washer_result import BRANCHES

HERE = Path(__file__).parent
MEASURED = HERE / "mesh_error.csv"
CHART = HERE.parents[2] / "docs/images/washer-mesh.svg"
MESHES = ((10, 32), (12, 40), (14, 48), (19, 64))


def measured(rows: list[dict[str, str]], grid: tuple[int, int]) -> tuple[float, ...]:
    """Return milliseconds, then median, 95, 99, 99.9 % and largest error [%], and points lost."""
    params, errors, lost = WasherParams(), [], 0
    began = time.process_time()
    for row in rows:
        load, speed, tilt, oil = (
            float(row[k]) for k in ("load", "speed", "tilt", "oil_temperature")
        )
        branch = BRANCHES[row["branch"]] if row["several"] == "1" else 0.0
        r = _solve(params, (load, speed, tilt, oil, 0.0), "field", grid, branch, None)
        if r.status.is_failure or r.status.name == "NO_BRANCH":
            lost += 1
        else:
            errors.append(100.0 * abs(r.friction_torque / float(row["torque"]) - 1.0))
    spent = 1e3 * (time.process_time() - began) / len(rows)
    return spent, *(float(x) for x in np.percentile(errors, (50, 95, 99, 99.9, 100))), lost


def draw() -> None:
    """Write the chart."""
    import matplotlib as mpl

    mpl.use("svg")
    mpl.rcParams["svg.hashsalt"] = "washer-mesh"
    import matplotlib.pyplot as plt

    rows = list(csv.DictReader(MEASURED.open()))
    figure, axes = plt.subplots(figsize=(7, 4.2), constrained_layout=True)
    for scheme, colour in (("0.19", "tab:orange"), ("now", "tab:blue")):
        own = [r for r in rows if r["scheme"] == scheme]
        spent = [float(r["ms"]) for r in own]
        for name, line in (("p50", ":"), ("p99", "--"), ("worst", "-")):
            label = {"p50": "median", "p99": "99 %", "worst": "worst"}[name]
            values = [float(r[name]) for r in own]
            axes.loglog(spent, values, line, marker="o", color=colour, label=f"{scheme}, {label}")
        for r in own:
            axes.annotate(r["mesh"], (float(r["ms"]), float(r["worst"])), fontsize=8)
    axes.set_xlabel("processor time of a cold solve [ms]")
    axes.set_ylabel("error of the torque [%]")
    axes.legend(fontsize=8)
    axes.grid(True, which="both", alpha=0.3)
    figure.savefig(CHART, metadata={"Date": None})


if __name__ == "__main__":
    if sys.argv[1:2] == ["draw"]:
        draw()
    elif sys.argv[1:2] == ["measure"] and len(sys.argv) == 3:
        table = list(csv.DictReader(Path(sys.argv[2]).open()))
        for mesh in MESHES:
            ms, *rest = measured(table, mesh)
            print(f"now,{mesh[0]} x {mesh[1]},{ms:.2f}," + ",".join(f"{x:.4g}" for x in rest))
    else:
        sys.exit(__doc__)
