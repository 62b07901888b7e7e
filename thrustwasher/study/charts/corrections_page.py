"""What the corrections of the physics moved, drawn: figures before and after."""

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from ...report.html import Plot, Section, Table
from ...report.palette import BLUE, GREY
from ...report.style import label, new_figure, styled

Row = Mapping[str, Any]


def corrections_section(rows: Sequence[Row]) -> Section:
    """Return the chapter: a table and what each figure was multiplied by."""
    table = [
        [r["part"], r["figure"], r["unit"], f"{r['before']:.3g}{'*' if r['recorded'] else ''}",
         f"{r['after']:.3g}", f"{r['after'] / r['before']:.2g}"] for r in rows
    ]  # fmt: skip
    heads = ["correction", "figure", "unit", "before", "after", "times"]
    words = (
        'Before is the preset "paper" of a model or the former scene, computed now; * is what '
        "version 0.5.0 gave. The two scenes are two shifts: their figures differ by design."
    )
    caption = "After over before: bars to the right grew, bars to the left shrank."
    return Section(
        "corrections", "What the corrections moved", texts=[words],
        plots=[Plot("chart-corrections", corrections_figure(rows), caption)],
        tables=[Table(heads, table, numbers=(3, 4, 5))],
    )  # fmt: skip


@styled
def corrections_figure(rows: Sequence[Row]) -> Figure:
    """Return a bar for each figure: after over before, on a logarithmic axis."""
    figure, (axes,) = new_figure(9.0, 1.4 + 0.25 * len(rows), left=3.3)
    times = [r["after"] / r["before"] for r in rows]
    colours = [GREY if r["part"].startswith("default scene") else BLUE for r in rows]
    places = list(range(len(rows)))
    axes.barh(places, [t - 1.0 for t in times], left=1.0, color=colours, height=0.7)
    axes.set(xscale="log")
    axes.set_yticks(places, [f"{r['part'].partition(':')[0]}: {r['figure']}" for r in rows])
    axes.invert_yaxis()
    axes.axvline(1.0, color="black", lw=0.8)
    label(axes, "", "after over before", "")
    return figure
