"""Where methods fail, as a page of Markdown: the maps, what the lies are, the limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import chart_text as text
from .chart_stability import WORDS

TITLE = "Where methods fail"
HEAD = (
    "Each method meets each hazard, and what comes out is judged. Nothing here is typed in: "
    "`thrustwasher chart --only stability --out docs/stability.md` runs every cell and writes this "
    "page; the same cells are drawn on the page of `thrustwasher chart`. Methods are small ones "
    "written for this map (`thrustwasher/rivals`), unless they are named as the package's."
)
TAIL = (
    "An answer that is wrong without a word is the worst a method can do. None of the methods that "
    "do so stands in a default path; tests in `tests/stability` fail if one ever did."
)


def stability_markdown(record: Mapping[str, Any]) -> str:
    """Return the page for a record with ``stability`` and ``limits``."""
    groups: Sequence[Mapping[str, Any]] = record["stability"]
    lines = [f"# {TITLE}", "", HEAD, "", TAIL, ""]
    lines += ["| verdict | meaning |", "|---|---|"]
    lines += [f"| {_verdict(v)} | {meaning} |" for v, meaning in WORDS.items()]
    lines += ["| - | does not apply |", ""]
    cells = [c["verdict"] for g in groups for row in g["cells"] for c in row]
    lines += [f"{cells.count('LIES')} of {len(cells)} answers are wrong without a word.", ""]
    for group in groups:
        lines += _group(group)
    lines += _limits(record.get("limits", []))
    return "\n".join([*lines, text.machine_sentence(record), ""])


def _group(group: Mapping[str, Any]) -> list[str]:
    """Return one map."""
    name = str(group["name"])
    lines = [f"## {name[:1].upper()}{name[1:]}", "", f"Wrong is: {group['judged']}.", ""]
    lines += ["| method | " + " | ".join(group["hazards"]) + " |"]
    lines += ["|---|" + "---|" * len(group["hazards"])]
    for method, row in zip(group["methods"], group["cells"], strict=True):
        lines.append(f"| {method} | " + " | ".join(map(_cell, row)) + " |")
    return [*lines, ""]


def _cell(cell: Mapping[str, str]) -> str:
    """Return a verdict with its figure, or with the name of what was said."""
    figure = cell["figure"]
    if cell["verdict"] == "says" and not figure:
        figure = cell["words"].partition(":")[0]
    return f"{_verdict(cell['verdict'])} {figure}".strip()


def _verdict(verdict: str) -> str:
    return f"**{verdict}**" if verdict == "LIES" else verdict


def _limits(limits: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the limits of coupling."""
    if not limits:
        return []
    lines = [
        "## Limits of coupling", "",
        "Steps and slopes at which a loop of two parts stops being stable, by formula and measured "
        "by bisection or growth. J is the inertia that the slip sees, c = d(torque)/d(slip), H the "
        "communication step; kappa = H c/J. Measured are the least loops, whose parts are exact on "
        "their own; tests bisect the same limits with FMUs stepped by FMPy.", "",
        "| loop | limit | predicted | measured | deviation |", "|---|---|---|---|---|",
    ]  # fmt: skip
    lines += [
        f"| {one['loop']} | {one['formula']} | {one['predicted']:.5g} | {one['measured']:.5g} | "
        f"{100 * one['deviation']:+.2f} % |"
        for one in limits
    ]
    return [*lines, ""]
