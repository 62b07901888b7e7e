"""What a page shows over time as one still picture: some of its plots below each other."""

import re
from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....shift.account.shift_record import Record
from .. import palette
from ..style import decade_ticks, label, legend_at_right, note_at_right, styled, time_figure
from ..target import chosen
from .shift_data import bands_of, panels, set_aside, signal_of

SHOWN = ("Speeds", "Torques", "Film ratios")
TALL = 2.87  # inch of a plot
MOST_EVENTS, FIRST_EVENTS = 8, 5  # numbered in a panel: all, or the first of too many
LETTER = 0.008  # of the panel's width: a phase that its name fits in has it there
SHADES = ("#F1F1F1", "#FFF3D9", "#E2F0FA", "#E3F4EC", "#F7E9F1")


@styled
def overview_figure(record: Record, titles: str | Sequence[str] = SHOWN) -> Figure:
    """Return the plots of these titles in ``panels.toml``; signals that stand still are left out.

    Above them phases are named, in the first one events are numbered.
    """
    given = {panel["title"]: panel for panel in panels()["panel"]}
    titles = chosen("panels", titles, given) or list(SHOWN)
    figure, axes = time_figure(TALL * len(titles), len(titles), "panels")
    for axis, title in zip(axes, titles, strict=True):
        _draw_phases(axis, record)
        _draw_signals(axis, record, given[title])
        if axis is axes[0]:
            _draw_events(axis, record)
        legend_at_right(axis)
    return figure


def _draw_signals(axis: Axes, record: Record, panel: Mapping[str, Any]) -> None:
    """Draw the signals as the page does; a logarithmic axis ends at its floor."""
    idle, floor, unit = set_aside(record), panel.get("floor", -np.inf), "1"
    for name, colour in panel["signals"].items():
        values = record.series(name)
        if values is None or not np.ptp(values) or name in idle:
            continue
        found, words = signal_of(record, name), name.removeprefix("transmission.")
        shown, unit = (values - found["zero"]) / found["scale"], found["unit"]
        look = {"color": getattr(palette, colour.upper()), "label": re.sub("[._]", " ", words)}
        axis.plot(record.time, np.maximum(shown, floor), **look)
        if (band := bands_of(record).get(name)) is not None:
            ends = ((values - found["zero"]) / found["scale"] for values in band[1:])
            low, high = (np.maximum(end, floor) for end in ends)
            axis.fill_between(band[0], low, high, color=look["color"], alpha=0.2, lw=0.0)
    if panel.get("logarithmic"):
        axis.set_yscale("log")
        low, high = axis.get_ylim()
        axis.set_ylim(max(min(low, 0.5), floor), max(high, 5.0))
        decade_ticks(axis)
    for level, words in panel.get("levels", ()):
        axis.axhline(level, color="#555555", lw=0.9, ls="--", zorder=1)
        note_at_right(axis, words, level, place=0.995, color="#666666")
    label(axis, panel["title"], "", f"{panel['title'].lower()} [{unit}]")


def _draw_phases(axis: Axes, record: Record) -> None:
    """Shade the phases and write the names that fit in."""
    first, last = float(record.time[0]), float(record.time[-1])
    axis.set_xlim(first, last)
    axis.margins(y=0.1)  # room for the names at the top
    for index, phase in enumerate(record.phases):
        shade = SHADES[index % len(SHADES)]
        axis.axvspan(phase.start, phase.end, color=shade, lw=0, zorder=0)
        if phase.end - phase.start > LETTER * len(phase.name) * (last - first):
            place = (0.5 * (phase.start + phase.end), 0.985)
            look: Any = {"ha": "center", "va": "top", "fontsize": 8.5, "color": "#666666"}
            axis.annotate(phase.name, place, xycoords=axis.get_xaxis_transform(), **look)


def _draw_events(axis: Axes, record: Record) -> None:
    """Draw the events as numbered lines; numbers of close neighbours stand above each other."""
    close = 0.025 * float(record.time[-1] - record.time[0])
    height, before = 0, -np.inf
    shown = record.events if len(record.events) <= MOST_EVENTS else record.events[:FIRST_EVENTS]
    for number, event in enumerate(shown, 1):
        height = height + 1 if event.time - before < close else 0
        before = event.time
        words = fill(f"{number}: {event.time:.4g} s {event.text}", 36, subsequent_indent="    ")
        axis.axvline(event.time, color="#444444", lw=0.8, ls=":", label=words)
        look: Any = {"fontsize": 8, "color": "#444444", "textcoords": "offset points"}
        look["bbox"] = {"boxstyle": "square,pad=0.05", "fc": "white", "ec": "none", "alpha": 0.8}
        place, across = (event.time, 0.0), axis.get_xaxis_transform()
        axis.annotate(str(number), place, (3, 3 + 10 * height), xycoords=across, **look)
    if len(shown) < len(record.events):
        more = len(record.events) - len(shown)
        axis.plot([], [], lw=0.0, label=f"and {more} more events")
