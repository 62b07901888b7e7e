"""Pictures of a reducer's report: loss map with its operating points, losses by source, lives."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, GREY, ORANGE, RED, RPM
from ..style import label, legend_below, new_figure, styled
from .contours import numbered_contours
from .train_plot import SOURCES

WIDE, HIGH = 5.3, 4.0  # inch of a tile
LEVELS = (1.0, 2.0, 5.0)  # of each decade
HOUR = 3600.0  # s


@styled
def loss_map_figure(found: Any, points: Sequence[tuple[float, float]]) -> Figure:
    """Return lines of equal loss over speed and torque; ``points``: torque [N m], speed [rad/s]."""
    c = found.columns
    torque, speed = np.unique(c["torque"]), np.unique(c["speed"])
    loss = c["loss"].reshape(len(speed), len(torque)).T  # torque is fastest
    rpm = np.round(RPM * speed, 6)  # an end that is whole in rpm has its tick
    figure, (axis,) = new_figure(WIDE, HIGH, 1, 1)
    known = loss[np.isfinite(loss)]
    wanted = [d * s for d in 10.0 ** np.arange(-2, 9) for s in LEVELS]
    levels = [x for x in wanted if known.min() < x < known.max()] or [float(np.median(known))]
    numbered_contours(axis, rpm, torque, loss, levels, BLUE)
    axis.axhline(0.0, color=GREY, linewidth=0.8)
    for number, (m, w) in enumerate(points, 1):
        axis.plot([RPM * w], [m], "o", color=RED, clip_on=False, zorder=5)
        axis.annotate(f"{number}", (RPM * w, m), (5, 5), textcoords="offset points", color=RED)
    label(axis, "Loss [W]", "speed [rpm]", "torque [N·m]")
    return figure


@styled
def source_figure(names: Sequence[str], losses: Sequence[Mapping[str, float]]) -> Figure:
    """Return the losses of each operating point by source; ``losses`` [W] by column."""
    figure, (axis,) = new_figure(WIDE, HIGH, 1, 1, foot=1)
    at, below = np.arange(len(names)), np.zeros(len(names))
    for source, (words, colour) in SOURCES.items():
        heights = np.array([own[source] for own in losses])
        axis.bar(at, heights, 0.6, bottom=below, label=words, color=colour)
        below += heights
    axis.set_xticks(at, names)
    axis.set_xlim(-0.8, len(names) - 0.2)
    label(axis, "Losses by source", "operating point", "loss [W]")
    legend_below(figure, *axis.get_legend_handles_labels(), columns=4)
    return figure


@styled
def life_figure(
    lives: Mapping[str, float], bands: Mapping[str, tuple[float, float]], required: float
) -> Figure:
    """Return lives of bearings [s] with their bands, and what is required [s], 0: nothing."""
    figure, (axis,) = new_figure(WIDE, max(2.2, 1.1 + 0.32 * len(lives)), 1, 1, left=1.75)
    for place, (name, life) in enumerate(lives.items()):
        low, high = (x / HOUR for x in bands.get(name, (life, life)))
        axis.plot([low, high], [place, place], color=BLUE, linewidth=4.0, alpha=0.5)
        axis.plot([life / HOUR], [place], "o", color=BLACK)
    axis.set_yticks(range(len(lives)), list(lives))
    axis.invert_yaxis()
    axis.set_xscale("log")
    if required > 0.0:
        axis.axvline(required / HOUR, color=ORANGE, linewidth=1.5)
    label(axis, "Life L10h", "life [h]", "")
    return figure
