"""Which samples nothing beats, and the words next to the charts: what failed, what set-up costs."""

import math
import re
from collections.abc import Mapping, Sequence
from statistics import linear_regression
from typing import Any

from thrustwasher.ladder.formats import shown_error
from thrustwasher.units import format_quantity

Sampled = Mapping[str, Any]  # a sample as in the JSON file
Row = list[str]


def beats(a: Sampled, b: Sampled, quantity: str) -> bool:
    """Tell if ``a`` is faster by more than both spreads, errs no more and fails no oftener.

    Errors below the uncertainty of the reference count as equal.
    """
    faster = a["call_median"] + a["call_iqr"] + b["call_iqr"] < b["call_median"]
    no_worse = _error(a, quantity) <= _error(b, quantity)
    return bool(faster and no_worse and a["n_failed"] <= b["n_failed"])


def front(samples: Sequence[Sampled], quantity: str) -> list[int]:
    """Return the indices of the samples that no other beats, by rising cost."""
    valid = [
        i
        for i, s in enumerate(samples)
        if s["call_median"] is not None and s["errors"].get(quantity, {}).get("worst") is not None
    ]
    kept = [
        i
        for i in valid
        if not any(beats(samples[j], samples[i], quantity) for j in valid if j != i)
    ]
    return sorted(kept, key=lambda i: samples[i]["call_median"])


def _error(sample: Sampled, quantity: str) -> float:
    uncertainty = sample["ref_uncertainty"].get(quantity) or 0.0
    return max(float(sample["errors"][quantity]["worst"]), uncertainty)


def seconds(value: float | None) -> str:
    """Return a duration as a person reads it: 234 µs, 65 s; "-" for None."""
    return "-" if value is None else format_quantity(value, "s", digits=3)


def error_text(value: float | None, quantity: Mapping[str, Any]) -> str:
    """Return an error with its unit, relative ones in per cent."""
    if value is None:
        return "-"
    return shown_error(value, None if quantity["kind"] == "relative" else quantity["unit"])


def sample_rows(survey: Mapping[str, Any]) -> tuple[Row, list[Row]]:
    """Return heads and rows of the table of all samples."""
    quantities = survey["quantities"]
    heads = ["way", "warm call", "spread", "least", "slowest case", "set-up"]
    for q in quantities:
        heads += [f"{q['name']} worst", "rms"]
    rows = []
    for s in survey["samples"]:
        spread = (s["call_iqr"] or 0.0) / s["call_median"] if s["call_median"] else None
        slowest = seconds(s["slowest_call_s"])
        slowest += f" ({s['slowest_case']})" if s["slowest_call_s"] is not None else ""
        row = [
            s["label"],
            seconds(s["call_median"]),
            "-" if spread is None else f"{100 * spread:.0f} %" + (" !" if spread > 0.1 else ""),
            seconds(s["call_min"]),
            slowest,
            seconds(s["setup_s"]),
        ]
        for q in quantities:
            errors = s["errors"][q["name"]]
            row += [
                f"{error_text(errors['worst'], q)} ({errors['case']})",
                error_text(errors["rms"], q),
            ]
        rows.append([*row, f"{s['n_failed']} of {s['n_cases']}"])
    return [*heads, "failed"], rows


def break_even_rows(survey: Mapping[str, Any], basis: str) -> tuple[Row, list[Row]]:
    """Return from how many calls on a way that is set up at some cost is cheaper than ``basis``."""
    base = next((s for s in survey["samples"] if s["label"] == basis), None)
    heads = [
        "way",
        "built once",
        "set-up",
        "warm call",
        f"calls from which it is cheaper than {basis}",
    ]
    rows = []
    for s in survey["samples"]:
        if base is None or s["is_rival"] or not s["call_median"] or s is base:
            continue
        gain = base["call_median"] - s["call_median"]
        extra = s["build_s"] + s["setup_s"] - base["setup_s"]
        calls = "never" if gain <= 0.0 else f"{max(0.0, extra) / gain:.0f}"
        built = seconds(s["build_s"]) if s["build_s"] else "-"
        rows.append([s["label"], built, seconds(s["setup_s"]), seconds(s["call_median"]), calls])
    return heads, rows


def failure_sentences(survey: Mapping[str, Any]) -> list[str]:
    """Say which samples failed where, and with which words."""
    return [
        f"{s['label']} fails in {s['n_failed']} of {s['n_cases']} cases ("
        + "; ".join(f"{case}: {why}" for case, why in s["failures"].items())
        + ")."
        for s in survey["samples"]
        if s["failures"]
    ]


def staircase(samples: Sequence[Sampled], front: Sequence[int], name: str) -> list[Sampled]:
    """Return the members of a front, from cheap to dear, that err less than all before them.

    The others are on the front because a clock cannot tell them from a cheaper one.
    """
    kept: list[Sampled] = []
    for i in front:
        error = samples[i]["errors"][name]["worst"]
        if not kept or error < kept[-1]["errors"][name]["worst"]:
            kept.append(samples[i])
    return kept


def verdict(survey: Mapping[str, Any], front: Sequence[int], quantity: Mapping[str, Any]) -> str:
    """Say in one sentence what nothing beats, from cheap to dear."""
    members = staircase(survey["samples"], front, quantity["name"])
    parts = [
        f"{s['label']} ({seconds(s['call_median'])}, worst "
        f"{error_text(s['errors'][quantity['name']]['worst'], quantity)})"
        for s in members
    ]
    return f"{quantity['name']}: nothing beats {', '.join(parts)}." if parts else ""


def order_sentences(study: Mapping[str, Any]) -> list[str]:
    """Say with which order the errors of each way fall with the step, and what goes wrong."""
    found = []
    for family in dict.fromkeys(s["family"] for s in study["samples"]):
        members = [s for s in study["samples"] if s["family"] == family]
        wrong = [s for s in members if s["n_failed"]]
        orders = [
            f"{q['name']} {order:.1f}"
            for q in study["quantities"]
            if (order := _order(members, q["name"])) is not None
        ]
        if wrong:
            words = dict.fromkeys(
                re.sub(r"\d+", "many", w) for s in wrong for w in s["failures"].values()
            )
            found.append(f"{family}: wrong in {len(wrong)} of {len(members)} ({'; '.join(words)}).")
        elif orders:
            found.append(f"{family}: order {', '.join(orders)}.")
    return found


def _order(members: Sequence[Sampled], name: str) -> float | None:
    """Return the slope of the logarithms of error and step, over errors that can be seen."""
    pairs = []
    for s in members:
        error = s["errors"][name]["worst"]
        if error and error > 3.0 * (s["ref_uncertainty"][name] or 0.0):
            pairs.append((math.log(float(s["value"].split()[0])), math.log(error)))
    if len(pairs) < 3:
        return None
    return linear_regression(*zip(*pairs, strict=True)).slope


def machine_sentence(record: Mapping[str, Any]) -> str:
    """Say where and with what the numbers were measured."""
    m, p = record["machine"], record["package"]
    state = {True: ", sources changed since", False: "", None: ""}[p["dirty"]]
    return (
        f"{m['cpu']}, {m['cores']} cores, load {m['load']} at the start; {m['os']}; Python "
        f"{m['python']}, numpy {m['numpy']}, numba {m['numba']}; one thread; thrustwasher "
        f"{p['version']}, commit {p['commit'] or 'unknown'}{state}; {record['date']}."
    )
