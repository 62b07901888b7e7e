"""A calibration on recordings: measured and fitted over time, and what is left."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....units import display_unit
from ..palette import BLACK, BLUE, GREY, ORANGE, SKY
from ..style import heading, label, new_figure, styled
from .fit_plot import fit_heading

MOST_RECORDINGS = 4  # that are drawn, each in a row of panels
WIDTH = 11.0  # inch


@styled
def trace_figure(found: Any) -> Figure:
    """Return for each output of each recording measured and fit over time, and the residuals."""
    histories = found.histories()
    names = dict.fromkeys(history.name for history in histories)
    shown = [
        c for name in names for c in [x for x in histories if x.name == name][:MOST_RECORDINGS]
    ]
    told = fit_heading(found, WIDTH)
    lines = 1 + told.count("\n")
    figure, panels = new_figure(WIDTH, 1.2 + 2.8 * len(shown), len(shown), 2, head=lines)
    for history, left, right in zip(shown, panels[::2], panels[1::2], strict=True):
        unit, factor = display_unit(float(abs(history.measured).max()), history.unit)
        _draw_history(left, found, history, unit, factor)
        look: Any = {"color": BLUE, "marker": ".", "ls": "", "ms": 3.5, "alpha": 0.85}
        right.plot(history.time, (history.measured - history.computed) / factor, **look)
        right.axhline(0.0, color=BLACK, lw=0.9)
        label(right, "Residuals", "time [s]", f"measured - fitted [{unit}]")
    left_out = len(histories) - len(shown)
    more = f"; {left_out} more are not drawn" if left_out else ""
    heading(figure, told + more, fontsize=10)
    return figure


def _draw_history(axis: Axes, found: Any, history: Any, unit: str, factor: float) -> None:
    """Draw one output of one recording, the fit with its band."""
    time, computed, half = history.time, history.computed / factor, history.half / factor
    look: Any = {"color": BLUE, "marker": ".", "ls": "", "ms": 4.0, "zorder": 3}
    axis.plot(time, history.measured / factor, label="measured", **look)
    known = half < 10.0 * abs(computed).max()
    if known.all():
        name = f"{100 * found.confidence:g} % band"
        axis.fill_between(time, computed - half, computed + half, color=SKY, alpha=0.6, label=name)
    axis.plot(time, computed, color=ORANGE, label="fit", zorder=4)
    of = Path(history.recording).name  # of a file its name alone
    label(axis, f"{history.name.replace('_', ' ')}, {of}", "time [s]", f"[{unit}]")
    axis.legend(edgecolor=GREY)
