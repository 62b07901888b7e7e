"""A calibration on recordings: measured and fitted over time, and what is left."""

from pathlib import Path
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....numerics.jit import Array
from ....units import unit_size
from ...calibration.measured import SLIDING
from ..palette import BLACK, BLUE, GREY, ORANGE, SKY
from ..style import heading, label, new_figure, styled
from .fit_plot import fit_heading, own_unit

MOST_RECORDINGS = 4  # that are drawn, each in a row of panels
WIDTH = 11.0  # inch
SPEEDS = ("speed", SLIDING)  # columns that slip is recorded in


@styled
def trace_figure(found: Any) -> Figure:
    """Return for each output of each recording measured and fit over time, and the residuals.

    Units are those of the first file that has them.
    """
    histories = [_in_own_units(history, found) for history in found.histories()]
    names = dict.fromkeys(history.name for history in histories)
    shown = [
        c for name in names for c in [x for x in histories if x.name == name][:MOST_RECORDINGS]
    ]
    told = fit_heading(found, WIDTH)
    lines = 1 + told.count("\n")
    figure, panels = new_figure(WIDTH, 1.2 + 2.8 * len(shown), len(shown), 2, head=lines)
    for history, left, right in zip(shown, panels[::2], panels[1::2], strict=True):
        over = f"time [{history.time_unit}]"
        _draw_history(left, found, history, over)
        look: Any = {"color": BLUE, "marker": ".", "ls": "", "ms": 3.5, "alpha": 0.85}
        right.plot(history.time, history.measured - history.computed, **look)
        right.axhline(0.0, color=BLACK, lw=0.9)
        label(right, "Residuals", over, f"measured - fitted [{history.unit}]")
    left_out = len(histories) - len(shown)
    more = f"; {left_out} more are not drawn" if left_out else ""
    heading(figure, told + more, fontsize=10)
    return figure


class Drawn(NamedTuple):
    """One output of one recording in the units of its picture."""

    name: str
    unit: str
    recording: str
    time_unit: str
    time: Array
    measured: Array
    computed: Array
    half: Array


def _in_own_units(history: Any, found: Any) -> Drawn:
    """Return a history in the units of the file, else in those that a person reads.

    Slip is that of the file's speed or sliding speed.
    """
    name, unit, per = history.name, history.unit, 1.0
    if name == "slip" and (source := next((n for n in SPEEDS if n in found.written), "")):
        name = source
        unit, per = ("m/s", found.params.friction_radius) if name == SLIDING else (unit, per)
    unit, size, zero = own_unit(found, name, unit, history.measured * per)
    written = found.written.get("time", "s")
    ticks = unit_size(written, "s")  # none of a time of day
    return Drawn(
        name=history.name,
        unit=unit,
        recording=history.recording,
        time_unit=written if ticks else "s",
        time=history.time / (ticks[0] if ticks else 1.0),
        measured=(history.measured * per - zero) / size,
        computed=(history.computed * per - zero) / size,
        half=history.half * per / size,
    )


def _draw_history(axis: Axes, found: Any, history: Drawn, over: str) -> None:
    """Draw one output of one recording, the fit with its band."""
    time, computed, half = history.time, history.computed, history.half
    look: Any = {"color": BLUE, "marker": ".", "ls": "", "ms": 4.0, "zorder": 3}
    axis.plot(time, history.measured, label="measured", **look)
    known = half < 10.0 * abs(computed).max()
    if known.all():
        name = f"{100 * found.confidence:g} % band"
        axis.fill_between(time, computed - half, computed + half, color=SKY, alpha=0.6, label=name)
    axis.plot(time, computed, color=ORANGE, label="fit", zorder=4)
    of = Path(history.recording).name  # of a file its name alone
    label(axis, f"{history.name.replace('_', ' ')}, {of}", over, f"[{history.unit}]")
    axis.legend(edgecolor=GREY)
