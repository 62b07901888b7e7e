"""Values of a measured data set with their errors, computed ones with their scatter band."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, ORANGE
from ..style import label, new_figure, styled

SIGMAS = 1.645  # 5 .. 95 %


@styled
def comparison_figure(found: Any) -> Figure:
    """Return measured and computed values over the varied input, or of several results."""
    data_set = found.data_set
    if len({*data_set.outputs}) > 1:
        return _of_several(found)
    order = np.argsort(data_set.inputs[data_set.vary], kind="stable")
    x, unit = data_set.inputs[data_set.vary][order], _unit(data_set)
    figure, (axis, *_) = new_figure(6.4, 4.2)
    axis.errorbar(
        x,
        data_set.measured[order],
        SIGMAS * data_set.error[order],
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
        axis.plot(
            x[used], data_set.measured[order][used], "o", color=ORANGE, label="used for the fit"
        )
    axis.legend()
    label(
        axis,
        data_set.texts["title"],
        f"{data_set.vary} [{unit}]",
        f"{data_set.output} [{data_set.unit}]",
    )
    return figure


def _of_several(found: Any) -> Figure:
    """Return what was computed over what was measured, a line for each point."""
    data_set, places = found.data_set, np.arange(len(found.data_set.measured))
    figure, (axis, *_) = new_figure(6.4, 0.34 * len(places) + 1.4)
    ratio = found.computed / data_set.measured
    ends = np.abs(np.array([found.low, found.high]) / data_set.measured - ratio)
    axis.errorbar(ratio, places, xerr=ends, fmt="s", color=BLUE, capsize=4)
    axis.axvline(1.0, color=BLACK)
    axis.set_yticks(places, data_set.outputs)
    axis.invert_yaxis()
    label(axis, data_set.texts["title"], "computed over measured", "")
    return figure


def _unit(data_set: Any) -> str:
    known = {"load": "N", "speed": "rad/s", "torque": "N m", "power": "W", "tilt": "rad"}
    return known.get(data_set.vary, "SI")
