"""Where methods fail, as a page of Markdown."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ...report.html import fill_template
from ...storage.digests import DATA
from .chart_text import machine_sentence

SAME_EVERYWHERE = DATA / "same_everywhere.json"
WORDS = {
    "ok": "right", "slow": "right, but costs", "says": "fails and says so",
    "LIES": "wrong without a word",
}  # fmt: skip


def same_everywhere() -> dict[str, Any]:
    """Return what ``benchmarks/same_everywhere.py`` measured: no machine changes it."""
    return dict(json.loads(SAME_EVERYWHERE.read_text("utf-8")))


def stability_markdown(record: Mapping[str, Any]) -> str:
    """Return the page for a record with ``stability`` and ``limits``."""
    groups: Sequence[Mapping[str, Any]] = record["stability"]
    return fill_template(
        Path(__file__).with_name("stability.md.jinja"),
        words=WORDS, groups=groups, limits=record.get("limits", []),
        verdicts=[cell["verdict"] for g in groups for row in g["cells"] for cell in row],
        machine=machine_sentence(record),
    )  # fmt: skip
