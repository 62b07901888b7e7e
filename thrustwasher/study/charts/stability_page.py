"""Where methods fail, as a page of Markdown and as a map of coloured cells."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ...report.html import fill_template
from ...report.style import legend_below, new_figure, styled
from ...storage.digests import DATA
from .chart_text import machine_sentence

SAME_EVERYWHERE = DATA / "same_everywhere.json"
SHADES = {"ok": "#D5EFE3", "slow": "#FFF0CC", "says": "#D6E9F7", "LIES": "#F6C6AE", "-": "#EFEFEF"}
LETTER = 0.06  # inch of a letter in a method's name
LETTERS = 110  # that fit side by side into all cells of a row
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


@styled
def stability_figure(groups: Sequence[Mapping[str, Any]]) -> Figure:
    """Return a panel of cells for each group: methods down, hazards across."""
    rows = [len(g["methods"]) for g in groups]
    longest = max(len(name) for g in groups for name in g["methods"])
    figure, panels = new_figure(
        11.0, 0.42 * sum(rows) + 1.15 * len(groups), len(groups), 1, foot=1,
        left=0.2 + LETTER * longest, height_ratios=rows,
    )  # fmt: skip
    for axes, group in zip(panels, groups, strict=True):
        _draw_group(axes, group)
    handles = [Rectangle((0, 0), 1, 1, color=SHADES[v]) for v in WORDS]
    names = [f"{v}: {text}" for v, text in WORDS.items()]
    legend_below(figure, handles, names, columns=4)
    return figure


def _draw_group(axes: Axes, group: Mapping[str, Any]) -> None:
    """Draw the cells of one group, the worst in bold."""
    n_rows, n_columns = len(group["methods"]), len(group["hazards"])
    room = LETTERS // n_columns
    axes.set(xlim=(0, n_columns), ylim=(n_rows, 0))
    axes.grid(False)
    axes.set_title(f"{group['name']} (wrong: {group['judged']})")
    for i, row in enumerate(group["cells"]):
        for j, cell in enumerate(row):
            axes.add_patch(Rectangle((j + 0.02, i + 0.04), 0.96, 0.92, lw=0,
                                     color=SHADES[cell["verdict"]]))  # fmt: skip
            lies = cell["verdict"] == "LIES"
            text = f"{cell['verdict']}  {cell['figure']}".strip()
            text = text.replace("  ", "\n") if len(text) > room else text
            axes.text(j + 0.5, i + 0.5, text, ha="center", va="center", fontsize=8,
                      linespacing=0.95, fontweight="bold" if lies else "normal")  # fmt: skip
    names = [fill(h, min(18, room)) for h in group["hazards"]]
    axes.set_xticks([j + 0.5 for j in range(n_columns)], names, fontsize=8)
    axes.set_yticks([i + 0.5 for i in range(n_rows)], group["methods"], fontsize=8.5)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
