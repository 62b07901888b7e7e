"""Which samples nothing beats, with ties: noise of a clock decides nothing."""

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


def _has(sample: Sampled, quantity: str, kind: str) -> bool:
    error = sample["errors"].get(quantity, {}).get(kind)
    return error is not None and sample["call_median"] is not None


def _error(sample: Sampled, quantity: str, kind: str) -> float:
    uncertainty = sample["ref_uncertainty"].get(quantity) or 0.0
    return max(float(sample["errors"][quantity][kind]), uncertainty)
