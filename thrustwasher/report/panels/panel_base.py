"""What all panels over the time of a shift share: lines, phases, events."""

from textwrap import fill

import numpy as np
from matplotlib.axes import Axes

from ..shift.shift_record import Array, Record
from ..style import label

MOST_EVENTS, FIRST_EVENTS = 8, 5  # numbered in a panel: all, or the first of too many
LETTER = 0.008  # of the panel's width: a phase that its name fits in has it there
SHADES = ("#F1F1F1", "#FFF3D9", "#E2F0FA", "#E3F4EC", "#F7E9F1")


def draw(
    axis: Axes, record: Record, name: str, words: str, colour: str, dashes: str = "-",
    zero: float = 0.0, width: float | None = None,
) -> float:  # fmt: skip
    """Draw a signal if the run has it; return its largest value."""
    values = record.series(name)
    if values is None:
        return 0.0
    axis.plot(record.time, values - zero, color=colour, ls=dashes, lw=width, label=words)
    return float(np.nanmax(values - zero))


def thin(record: Record) -> Array:
    """Return the indices of at most about 600 times: areas are not simplified by the plotter."""
    step = max(1, len(record.time) // 600)
    return np.unique(np.append(np.arange(0, len(record.time), step), len(record.time) - 1))


def draw_phases(axis: Axes, record: Record, words: bool = True, legend: bool = False) -> None:
    """Shade the phases and write their names; with ``legend`` narrow ones are named there."""
    first, last = float(record.time[0]), float(record.time[-1])
    axis.set_xlim(first, last)
    axis.margins(y=0.1)  # room for the names at the top
    for index, phase in enumerate(record.phases):
        shade = SHADES[index % len(SHADES)]
        wide = phase.end - phase.start > LETTER * len(phase.name) * (last - first)
        axis.axvspan(phase.start, phase.end, color=shade, lw=0, zorder=0,
                     label=phase.name if legend and not wide else None)  # fmt: skip
        if words and wide:
            axis.annotate(phase.name, (0.5 * (phase.start + phase.end), 0.985), ha="center",
                          va="top", xycoords=axis.get_xaxis_transform(), fontsize=8.5,
                          color="#666666")  # fmt: skip


def draw_events(axis: Axes, record: Record) -> None:
    """Draw the events as numbered lines; numbers of close neighbours stand above each other."""
    close = 0.025 * float(record.time[-1] - record.time[0])
    height, before = 0, -np.inf
    shown = record.events if len(record.events) <= MOST_EVENTS else record.events[:FIRST_EVENTS]
    for number, event in enumerate(shown, 1):
        height = height + 1 if event.time - before < close else 0
        before = event.time
        words = fill(f"{number}: {event.time:.4g} s {event.text}", 36, subsequent_indent="    ")
        axis.axvline(event.time, color="#444444", lw=0.8, ls=":", label=words)
        axis.annotate(str(number), (event.time, 0.0), (2, 3 + 9 * height),
                      textcoords="offset points", xycoords=axis.get_xaxis_transform(),
                      fontsize=8, color="#444444")  # fmt: skip
    if len(shown) < len(record.events):
        more = len(record.events) - len(shown)
        axis.plot([], [], lw=0.0, label=f"and {more} more events")


def draw_phase_lines(axis: Axes, record: Record) -> None:
    """Draw thin lines where a phase begins."""
    axis.set_xlim(float(record.time[0]), float(record.time[-1]))
    for phase in record.phases[1:]:
        axis.axvline(phase.start, color="#999999", lw=0.8, ls=":")


def finish(axis: Axes, title: str, up: str) -> None:
    """Set title and label of the axis, and the legend to the right, where it hides no line."""
    label(axis, title, "", up)
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
