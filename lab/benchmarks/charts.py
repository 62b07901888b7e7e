"""Do two runs of the charts agree? Prints every way that is on one front only.

python -m lab.benchmarks.charts A/chart.json B/chart.json

Both records from `python -m lab.chart` on the same idle machine and commit. A way that is on the
front of one run only is listed unless the spreads of both runs explain it; exit status 1 then.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lab.charts.chart_text import Sampled, beats, front


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
            print(
                f"{name}, {quantity['name']}: {fronts[0]} and {fronts[1]} on the front; "
                f"{', '.join(found) or 'no disagreement'}"
            )
    return count


def disagreements(one: Sequence[Sampled], two: Sequence[Sampled], quantity: str) -> list[str]:
    """Return the labels on one front only though the two runs' spreads do not explain it.

    A sample is explained if in the run where it is beaten some sample that beats it does so by
    less than the change of its own or the other's median between the runs.
    """
    labels = {s["label"]: s for s in one}, {s["label"]: s for s in two}
    fronts = [{run[i]["label"] for i in front(run, quantity)} for run in (one, two)]
    found = []
    for label in sorted(fronts[0] ^ fronts[1]):
        if label not in labels[0] or label not in labels[1]:
            found.append(label)
            continue
        loser = 1 if label in fronts[0] else 0
        mine = labels[loser][label]
        rivals = [s for s in labels[loser].values() if beats(s, mine, quantity)]
        if not any(_explained(labels, label, s["label"]) for s in rivals):
            found.append(label)
    return found


def _explained(
    labels: tuple[dict[str, Sampled], dict[str, Sampled]], label: str, other: str
) -> bool:
    """Tell if the order of two samples changed by no more than the spreads of both runs."""
    gaps, spread = [], 0.0
    for run in labels:
        if other not in run:
            return False
        gaps.append(run[label]["call_median"] - run[other]["call_median"])
        spread += run[label]["call_iqr"] + run[other]["call_iqr"]
    return bool(abs(gaps[0] - gaps[1]) <= spread)


if __name__ == "__main__":
    files = [json.loads(Path(p).read_text("utf-8")) for p in sys.argv[1:3]]
    sys.exit(1 if compare(*files) else 0)
