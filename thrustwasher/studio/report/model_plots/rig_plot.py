"""Values of a measured data set with their errors, computed ones with their scatter band."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, ORANGE
from ..style import label, new_figure, styled

SIGMAS = 1.645  # 5 .. 95 %


@styled
def rig_figure(found: Any) -> Figure:
    """Return measured and computed values over the varied input, or of several results."""
    rig = found.rig
    if len({*rig.outputs}) > 1:
        return _of_several(found)
    order = np.argsort(rig.inputs[rig.vary], kind="stable")
    x, unit = rig.inputs[rig.vary][order], _unit(rig)
    figure, (axis, *_) = new_figure(6.4, 4.2)
    axis.errorbar(
        x,
        rig.measured[order],
        SIGMAS * rig.error[order],
        fmt="o",
        color=BLACK,
        capsize=3,
        label="measured, 5 .. 95 %",
    )
    ends = np.abs(np.array([found.low, found.high])[:, order] - found.computed[order])
    axis.errorbar(
        x,
        found.computed[order],
        ends,
        fmt="s",
        color=BLUE,
        capsize=5,
        label="computed, with scatter",
    )
    used = ~found.judged[order]
    if used.any():
        axis.plot(x[used], rig.measured[order][used], "o", color=ORANGE, label="used for the fit")
    axis.legend()
    label(axis, rig.texts["title"], f"{rig.vary} [{unit}]", f"{rig.output} [{rig.unit}]")
    return figure


def _of_several(found: Any) -> Figure:
    """Return what was computed over what was measured, a line for each point."""
    rig, places = found.rig, np.arange(len(found.rig.measured))
    figure, (axis, *_) = new_figure(6.4, 0.34 * len(places) + 1.4)
    ratio = found.computed / rig.measured
    ends = np.abs(np.array([found.low, found.high]) / rig.measured - ratio)
    axis.errorbar(ratio, places, xerr=ends, fmt="s", color=BLUE, capsize=4)
    axis.axvline(1.0, color=BLACK)
    axis.set_yticks(places, rig.outputs)
    axis.invert_yaxis()
    label(axis, rig.texts["title"], "computed over measured", "")
    return figure


def _unit(rig: Any) -> str:
    known = {"load": "N", "speed": "rad/s", "torque": "N m", "power": "W", "tilt": "rad"}
    return known.get(rig.vary, "SI")
