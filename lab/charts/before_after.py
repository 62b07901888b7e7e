"""Speed against accuracy of two versions, in one picture and one table.

    python -m lab.chart --out after   # here, and in the other checkout with --out before
    python -m lab.charts.before_after --before before/chart.json --after after/chart.json

Give records of runs that took turns on one idle machine; with several of a version, the median of
their times counts. ``--out FILE.svg``: the picture.
"""

from __future__ import annotations

import argparse
import json
import statistics
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from lab.benchmarks.printed import table_head, table_row
from lab.charts.chart_cost import WORDS
from thrustwasher.studio.report.palette import BLUE, GREY
from thrustwasher.studio.report.style import label, legend_below, new_figure, styled

TITLES = {"washer": "Washer", "clutch": "Wet clutch", "gearmesh": "Gear mesh", "shift": "Shift"}
Study = dict[str, dict[str, Any]]  # label -> its sample, time [s] and errors


def merged(records: list[dict[str, Any]]) -> dict[str, tuple[str, str, Study]]:
    """Return quantity, what a cost is and the samples of every study, median times [s]."""
    found = {}
    for name in TITLES:
        runs = [r["macro_steps"] if name == "shift" else r["models"][name] for r in records]
        quantity = runs[0]["quantities"][0]["name"]
        study: Study = {}
        for sample in runs[0]["samples"]:
            times = [
                s["call_median"]
                for run in runs
                for s in run["samples"]
                if s["label"] == sample["label"]
            ]
            error = sample["errors"].get(quantity, {}).get("worst")
            if error and not sample["n_failed"]:
                study[sample["label"]] = {"time": statistics.median(times), "error": error}
        found[name] = quantity, runs[0].get("cost_of") or "shift [s]", study
    return found


@styled
def picture(before: dict[str, Any], after: dict[str, Any]) -> Figure:
    """Return error over cost, a panel per model; a line goes from each way to what it is now."""
    chosen = [name for name in TITLES if name != "gearmesh"]  # exact to rounding: nothing to draw
    figure, panels = new_figure(11.0, 4.4, 1, len(chosen), foot=1)
    for axes, name in zip(panels, chosen, strict=True):
        quantity, cost, new = after[name]
        old = before[name][2]
        shared = [key for key in old if key in new]
        for key in shared:
            pair = old[key], new[key]
            axes.plot([p["time"] for p in pair], [p["error"] for p in pair], color=GREY, lw=0.8)
        for study, colour, filled, text in (
            (old, GREY, "none", "before"),
            (new, BLUE, BLUE, "now"),
        ):
            x, y = ([study[key][part] for key in shared] for part in ("time", "error"))
            axes.plot(x, y, "o", color=colour, mfc=filled, ms=5, label=text)
        axes.set_xscale("log")
        axes.set_yscale("log")
        what = WORDS.get(quantity, quantity)
        label(axes, f"{TITLES[name]}: {what}", cost, "worst error, relative")
    legend_below(figure, *panels[0].get_legend_handles_labels(), columns=2)
    return figure


def main() -> None:
    """Read the records, print the table, draw."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--before", nargs="+", type=Path, required=True)
    parser.add_argument("--after", nargs="+", type=Path, required=True)
    parser.add_argument("--out", type=Path, help="FILE.svg of the picture")
    given = parser.parse_args()
    old, new = (
        [json.loads(path.read_text("utf-8")) for path in paths]
        for paths in (given.before, given.after)
    )
    before, after = merged(old), merged(new)
    table_head("way", "before", "now", "times less", "worst error before", "now")
    for name, (_, cost, study) in after.items():
        for key, sample in study.items():
            if key in before[name][2]:
                was = before[name][2][key]
                table_row(
                    f"{name} ({cost}): {key}",
                    *(f"{1e3 * s['time']:.3g} ms" for s in (was, sample)),
                    f"{was['time'] / sample['time']:.2f}",
                    *(f"{s['error']:.2e}" for s in (was, sample)),
                )
    if given.out:
        picture(before, after).savefig(given.out, bbox_inches="tight")


if __name__ == "__main__":
    main()
