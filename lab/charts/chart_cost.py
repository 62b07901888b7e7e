"""Error against cost: every way a model can be solved, on logarithmic axes."""

import re
from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import LogLocator, NullFormatter
from matplotlib.transforms import Bbox

from lab.charts.chart_text import staircase
from thrustwasher.studio.report.palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from thrustwasher.studio.report.style import label, legend_below, new_figure, note_at_right, styled

COLOURS = {"fidelity levels": BLUE, "mesh of the package": SKY}
RIVALS = (RED, ORANGE, PURPLE, GREEN, BLACK, GREY)
WORDS = {
    "friction_torque": "friction torque",
    "temperature": "mean temperature",
    "slip_energy": "slip energy",
    "lock_time": "lock time",
    "peak_temperature": "peak temperature",
    "end_temperature": "interface temperature at the end",
}
SIDE_BY_SIDE = 3  # names in a row of the legend
SIZE, MARK = 7.5, 3.5  # of letters; half of a mark, in points
FAR = (4.0, 12.0, 22.0, 34.0)  # of a name from its mark, in points; from the second on with a line
SIDES = ((1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1), (0, -1))  # of the mark: right, above
HORIZONTAL, VERTICAL = {1: "left", 0: "center", -1: "right"}, {1: "bottom", -1: "top"}
Sampled = Mapping[str, Any]
Label = tuple[float, float, str, str]  # place in data, a name, its colour


@styled
def cost_figure(
    title: str, study: Mapping[str, Any], fronts: Mapping[str, Sequence[int]], across: str
) -> Figure:
    """Return error over cost, a panel per quantity; lines follow the knob of a series.

    ``study`` is as in the JSON file, ``fronts`` the indices of the samples that nothing beats,
    ``across`` what a cost is.
    """
    quantities, families = study["quantities"], {s["family"] for s in study["samples"]}
    foot = -(-(len(families) + 1) // SIDE_BY_SIDE)  # rows of the legend, a name for the front too
    figure, panels = new_figure(11.0, 5.0, 1, len(quantities), foot=foot)
    for axes, quantity in zip(panels, quantities, strict=True):
        name = quantity["name"]
        draw_samples(axes, study["samples"], quantity, fronts[name])
        unit = "relative" if quantity["kind"] == "relative" else quantity["unit"]
        label(axes, f"{title}{WORDS.get(name, name)}", across, f"error [{unit}]")
    legend_below(figure, *panels[0].get_legend_handles_labels(), columns=SIDE_BY_SIDE)
    return figure


def draw_samples(
    axes: Axes,
    samples: Sequence[Sampled],
    quantity: Mapping[str, Any],
    front: Sequence[int],
    cost: str = "call_median",
) -> None:
    """Draw worst (filled) and rms (hollow) of each sample, lines along the knob, the front."""
    name = quantity["name"]
    axes.set(xscale="log", yscale="log")
    known = [s for s in samples if s[cost] and s["errors"].get(name, {}).get("worst") is not None]
    floor = max((s["ref_uncertainty"].get(name) or 0.0 for s in samples), default=0.0)
    low = _draw_floor(axes, known, name, floor)
    costs = [s[cost] for s in samples if s[cost]] or [1.0]
    axes.set_xlim(min(costs) / 2.0, 4.0 * max(costs))  # room for words next to the marks
    labels: list[Label] = []
    if max(costs) < 20.0 * min(costs):  # as many numbers as there is room for
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
        axes.xaxis.set_minor_formatter(NullFormatter())
    families = list(dict.fromkeys(s["family"] for s in samples))
    free = RIVALS if set(families) & set(COLOURS) else (BLUE, SKY, *RIVALS)
    rivals = iter(free * 4)
    for family in families:
        members = [s for s in known if s["family"] == family]
        colour = COLOURS.get(family) or next(rivals)
        if members:
            labels += _draw_family(axes, family, members, name, cost, colour, low)
    best = staircase(samples, front, name)
    axes.step(
        [s[cost] for s in best],
        [max(s["errors"][name]["worst"], low) for s in best],
        where="post",
        color=BLACK,
        lw=0.9,
        ls=":",
        label="nothing beats these (worst case)",
        zorder=1,
    )
    _draw_failures(axes, samples, cost, name)
    kinds = ("worst", "rms")
    place_labels(
        axes, labels, [(s[cost], max(s["errors"][name][k], low)) for s in known for k in kinds]
    )


def _draw_floor(axes: Axes, known: Sequence[Sampled], name: str, floor: float) -> float:
    """Set the range of errors, shade what the reference cannot tell; return where zero is drawn."""
    errors = [s["errors"][name][k] for s in known for k in ("worst", "rms")]
    low = min([e for e in errors if e > 0.0] + ([floor] if floor else []), default=1e-16)
    axes.set_ylim(0.4 * low, 6.0 * max([*errors, floor, low]))  # room for crosses at the top
    if floor:
        axes.axhspan(0.4 * low, floor, color="#E8E8E8", lw=0, zorder=0)
        words = "uncertainty of the reference"
        note_at_right(axes, words, 0.4 * low, place=0.99, shift=(0, 2), va="bottom", color=GREY)
    return 0.6 * low


def _draw_family(
    axes: Axes,
    family: str,
    members: Sequence[Sampled],
    name: str,
    cost: str,
    colour: str,
    low: float,
) -> list[Label]:
    """Draw one line in the order of its knob; return what is to be named.

    Levels are no line. The marks of the worst case are found in the drawing by ``mark_of``.
    """
    x = np.array([s[cost] for s in members])
    joined = "" if family == "fidelity levels" else "-"
    single = all(s["errors"][name]["rms"] == s["errors"][name]["worst"] for s in members)
    for kind, fill in (("worst", colour), ("rms", "white"))[: 1 if single else 2]:
        y = np.maximum([s["errors"][name][kind] for s in members], low)
        axes.plot(
            x,
            y,
            ls=joined,
            marker="o" if family != "fidelity levels" else "D",
            ms=5,
            color=colour,
            mfc=fill,
            lw=1.2 if kind == "worst" else 0.7,
            zorder=3,
            label=None if kind == "rms" else family if single else f"{family}: worst, hollow rms",
            gid=mark_of(name, family) if kind == "worst" else None,
        )
        if cost == "call_median" and kind == "worst":
            axes.errorbar(
                x,
                y,
                xerr=[0.5 * (s["call_iqr"] or 0.0) for s in members],
                fmt="none",
                ecolor=colour,
                elinewidth=0.9,
                zorder=2,
            )
    shown = members if len(members) < 5 or not single else (members[0], members[-1])
    return [(s[cost], max(s["errors"][name]["worst"], low), s["value"], colour) for s in shown]


def mark_of(quantity: str, family: str) -> str:
    """Return the identifier of a family's marks in the panel of a quantity."""
    return re.sub(r"\W+", "-", f"{quantity} {family}")


def _draw_failures(axes: Axes, samples: Sequence[Sampled], cost: str, name: str) -> None:
    """Mark failed samples by a cross: of many cases at the top, with their number."""
    failed = [s for s in samples if s["n_failed"]]
    for s in (s for s in failed if s["n_cases"] == 1 and s[cost] and s["errors"][name]["worst"]):
        axes.plot([s[cost]], [s["errors"][name]["worst"]], marker="x", ms=9, color=RED, mew=1.6)
    for rank, s in enumerate(s for s in failed if s["n_cases"] > 1):
        up = 0.98 - 0.045 * rank
        text = f"{s['label']}: {s['n_failed']} of {s['n_cases']} fail"
        where: Any = axes.get_xaxis_transform() if s[cost] else axes.transAxes
        x = s[cost] or 0.02
        axes.plot([x], [up], marker="x", ms=7, color=RED, mew=1.8, clip_on=False, transform=where)
        axes.annotate(
            text,
            (x, up),
            (6, -3),
            xycoords=where,
            textcoords="offset points",
            fontsize=7.5,
            color=RED,
        )


@styled
def count_figure(model: str, survey: Mapping[str, Any]) -> Figure:
    """Return error over the work that needs no machine, a panel per unit of work."""
    quantity = survey["quantities"][0]
    groups = list(dict.fromkeys(s["count_of"] for s in survey["samples"] if s["count"]))
    figure, panels = new_figure(11.0, 3.8, 1, max(1, len(groups)))
    for axes, group in zip(panels, groups, strict=False):
        members = [s for s in survey["samples"] if s["count_of"] == group]
        draw_samples(axes, members, quantity, (), "count")
        words = WORDS.get(quantity["name"], quantity["name"])
        label(axes, f"{model}: {words}", f"{group} per case", "error")
    return figure


def place_labels(axes: Axes, labels: Sequence[Label], marks: Sequence[tuple[float, float]]) -> None:
    """Write the labels where they cover neither each other nor marks; limits must be final.

    One that finds no place is left out: the page tells it of the point.
    """
    frame, half = axes.get_window_extent(), MARK * axes.figure.dpi / 72.0
    spots = [axes.transData.transform(mark) for mark in marks]
    taken = [Bbox.from_extents(x - half, y - half, x + half, y + half) for x, y in spots]
    taken += [words.get_window_extent() for words in axes.texts]
    for x, y, text, colour in labels:
        for far, (right, up) in product(FAR, SIDES):
            line: Any = {"arrowstyle": "-", "lw": 0.5, "color": colour, "shrinkB": 3.0}
            words = axes.annotate(
                text,
                (x, y),
                (far * right, far * up),
                textcoords="offset points",
                ha=HORIZONTAL[right],
                va=VERTICAL[up],
                fontsize=SIZE,
                color=colour,
                arrowprops=line if far > FAR[0] else None,
            )
            words.get_window_extent()  # finds its place, and what there is with the line
            box = Text.get_window_extent(words)
            inside = frame.contains(box.x0, box.y0) and frame.contains(box.x1, box.y1)
            if inside and not box.count_overlaps(taken):
                taken.append(box)
                break
            words.remove()
