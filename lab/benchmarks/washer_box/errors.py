"""How far a level is from the converged torques of reference.csv: one table.

python -m lab.benchmarks.washer_box.errors [TABLE.csv] [--fidelity field] [--worst 5]

Random and hard rows apart. A row on the other branch, or failed, counts as beyond every limit;
``estimate`` is the share of rows at which the result's own estimate is not below the true error, of
those that have one: below 50 rad/s no verification table speaks.
"""

import argparse
import csv
import math
import statistics
from pathlib import Path

from lab.benchmarks.printed import table_head, table_row
from thrustwasher import WasherParams, solve_washer

TABLE = Path(__file__).with_name("reference.csv")
HEAD = (
    "points",
    "places",
    "median",
    "95 %",
    "99.9 %",
    "most",
    "within 1 %",
    "within 3 %",
    "estimate",
)
INPUTS = "load", "speed", "tilt", "oil_temperature"
LIMITS = 0.01, 0.03


def off(row: dict[str, str], fidelity: str) -> tuple[float, float, int]:
    """Return the error of the torque, the estimate of it (both relative), and iterations."""
    at = {name: float(row[name]) for name in INPUTS}
    r = solve_washer(WasherParams(), **at, branch=row["branch"], fidelity=fidelity, throw=False)
    if r.status.is_failure or r.branch != row["branch"]:
        return math.inf, 0.0, r.iterations
    estimate = r.error_estimate if r.error_estimate is not None else math.nan
    return abs(r.friction_torque / float(row["torque"]) - 1.0), estimate, r.iterations


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, nargs="?", default=TABLE)
    parser.add_argument("--fidelity", default="field")
    parser.add_argument("--worst", type=int, default=5)
    asked = parser.parse_args()
    with asked.table.open(newline="") as file:
        rows = list(csv.DictReader(file))
    table_head(*"points|places|median|95 %|99.9 %|most|within 1 %|within 3 %|estimate".split("|"))
    for chosen in ("random", "hard"):
        found = [(*off(row, asked.fidelity), row) for row in rows if row["chosen"] == chosen]
        found.sort(key=lambda x: x[0])
        if not found:
            continue
        errors = [x[0] for x in found]
        n = len(errors)
        at = [errors[min(n - 1, int(q * n))] for q in (0.95, 0.999)]
        within = [sum(e <= limit for e in errors) / n for limit in LIMITS]
        told = [e <= estimate for e, estimate, _, _ in found if not math.isnan(estimate)]
        true = sum(told) / max(len(told), 1)
        cells = [statistics.median(errors), *at, errors[-1], *within, true]
        table_row(chosen, n, *(f"{100 * x:.3g} %" for x in cells))
        for error, _, _, row in found[-asked.worst :]:
            print(
                f"  {100 * error:.2f} %:", *(f"{float(row[k]):.6g}" for k in INPUTS), row["branch"]
            )


if __name__ == "__main__":
    main()
