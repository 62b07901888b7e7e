"""Which samples nothing beats, with ties: noise of a clock decides nothing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

Sampled = Mapping[str, Any]  # a sample as in the JSON file


def beats(a: Sampled, b: Sampled, quantity: str, kind: str = "worst") -> bool:
    """Tell if ``a`` is faster by more than both spreads, errs no more and fails no oftener.

    Errors below the uncertainty of the reference count as equal.
    """
    faster = a["call_median"] + a["call_iqr"] + b["call_iqr"] < b["call_median"]
    no_worse = _error(a, quantity, kind) <= _error(b, quantity, kind)
    return bool(faster and no_worse and a["n_failed"] <= b["n_failed"])


def front(samples: Sequence[Sampled], quantity: str, kind: str = "worst") -> list[int]:
    """Return the indices of the samples that no other beats, by rising cost."""
    valid = [i for i, s in enumerate(samples) if _has(s, quantity, kind)]
    kept = [
        i for i in valid
        if not any(beats(samples[j], samples[i], quantity, kind) for j in valid if j != i)
    ]  # fmt: skip
    return sorted(kept, key=lambda i: samples[i]["call_median"])


def disagreements(
    one: Sequence[Sampled], two: Sequence[Sampled], quantity: str, kind: str = "worst"
) -> list[str]:
    """Return the labels on one front only though the two runs' spreads do not explain it.

    A sample is explained if in the run where it is beaten some sample that beats it does so by
    less than the change of its own or the other's median between the runs.
    """
    labels = {s["label"]: s for s in one}, {s["label"]: s for s in two}
    fronts = [{run[i]["label"] for i in front(run, quantity, kind)} for run in (one, two)]
    found = []
    for label in sorted(fronts[0] ^ fronts[1]):
        if label not in labels[0] or label not in labels[1]:
            found.append(label)
            continue
        loser = 1 if label in fronts[0] else 0
        mine = labels[loser][label]
        rivals = [s for s in labels[loser].values() if beats(s, mine, quantity, kind)]
        if not any(_explained(labels, label, s["label"], quantity, kind) for s in rivals):
            found.append(label)
    return found


def _explained(
    labels: tuple[dict[str, Sampled], dict[str, Sampled]], label: str, other: str, quantity: str,
    kind: str,
) -> bool:  # fmt: skip
    """Tell if the order of two samples changed by no more than the spreads of both runs."""
    gaps, spread = [], 0.0
    for run in labels:
        if other not in run:
            return False
        gaps.append(run[label]["call_median"] - run[other]["call_median"])
        spread += run[label]["call_iqr"] + run[other]["call_iqr"]
    return bool(abs(gaps[0] - gaps[1]) <= spread)


def _has(sample: Sampled, quantity: str, kind: str) -> bool:
    error = sample["errors"].get(quantity, {}).get(kind)
    return error is not None and sample["call_median"] is not None


def _error(sample: Sampled, quantity: str, kind: str) -> float:
    uncertainty = sample["ref_uncertainty"].get(quantity) or 0.0
    return max(float(sample["errors"][quantity][kind]), uncertainty)
