"""Do two runs of the charts agree? Prints every way that is on one front only.

python benchmarks/charts.py A/chart.json B/chart.json

Both records from `thrustwasher chart` on the same idle machine and commit. A way that is on the
front of one run only is listed unless the spreads of both runs explain it; exit status 1 then.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from thrustwasher.fidelity.pareto import disagreements, front


def studies(record: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return everything in a record that has samples, by name."""
    return {**record["models"], "shift": record["macro_steps"]}


def compare(one: dict[str, Any], two: dict[str, Any]) -> int:
    """Print fronts and disagreements; return how many there are."""
    count = 0
    ratio = two["calibration_s"] / one["calibration_s"]
    print(f"calibration loop: {ratio:.2f} times as long in the second run")
    others = studies(two)
    for name, study in studies(one).items():
        for quantity in study["quantities"]:
            a, b = study["samples"], others[name]["samples"]
            found = disagreements(a, b, quantity["name"])
            count += len(found)
            fronts = [len(front(s, quantity["name"])) for s in (a, b)]
            print(f"{name}, {quantity['name']}: {fronts[0]} and {fronts[1]} on the front; "
                  f"{', '.join(found) or 'no disagreement'}")  # fmt: skip
    return count


if __name__ == "__main__":
    files = [json.loads(Path(p).read_text("utf-8")) for p in sys.argv[1:3]]
    sys.exit(1 if compare(*files) else 0)
