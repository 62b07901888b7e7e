"""Panels of oil films over the time of a shift: who carries, oil or asperities."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .extremes import distressed
from .panel_base import draw_phase_lines, thin
from .panels import COLOURS
from .shift_record import PACKS, Record
from .style import BLACK, GREEN, ORANGE, RED, SIGMA, SKY, beside, label

Array = np.ndarray[Any, Any]
LOWEST_RATIO = 0.05  # film ratios at or below this are drawn on this line


def draw_films(axis: Axes, record: Record) -> bool:
    """Draw the film ratios over regime bands, distress marked; False if there is no film."""
    drawn = []
    lines = [(pack, pack, COLOURS[pack]) for pack in PACKS if record.presses(pack)]
    lines += [("washer", "thrust washer", ORANGE), ("mesh", "gear mesh", GREEN)]
    for part, words, colour in lines:
        values = record.series(f"{part}.film_ratio")
        if values is not None:
            shown = np.maximum(values, LOWEST_RATIO)
            axis.plot(record.time, shown, color=colour, label=words, zorder=3)
            drawn.append(shown)
    if not drawn:
        return False
    low = max(LOWEST_RATIO, 0.6 * min(float(np.min(d)) for d in drawn))
    high = 1.6 * max(3.0, *(float(np.max(d)) for d in drawn))
    _draw_regimes(axis, low, high)
    draw_phase_lines(axis, record)
    lost = distressed(record)
    if np.any(lost):
        axis.plot(record.time[lost], np.full(np.sum(lost), 0.82 * high), "|", color=BLACK, ms=7,
                  mew=1.2, label="washer's film lost (distress)", zorder=4)  # fmt: skip
    up = f"film ratio h/{SIGMA} [1]"
    label(axis, "Film ratios: does oil or do asperities carry?", "", up)
    beside(axis)
    return True


def draw_washer_load(axis: Axes, record: Record, load: Array, share: Array) -> None:
    """Draw the load on one washer, split into what oil and asperities carry."""
    some = thin(record)
    axis.stackplot(
        record.time[some], (load * share)[some], (load * (1.0 - share))[some], colors=[SKY, RED],
        labels=["carried by the oil film", "carried by asperities"], lw=0, alpha=0.75,
    )  # fmt: skip
    axis.plot(record.time, load, color=BLACK, lw=1.2, label="load on one washer")
    draw_phase_lines(axis, record)
    axis.set_ylim(bottom=0.0)
    label(axis, "Load on one thrust washer", "", "load [N]")
    beside(axis)


def _draw_regimes(axis: Axes, low: float, high: float) -> None:
    """Draw the regime bands behind a logarithmic axis of film ratios."""
    for bottom, top, shade, words in (
        (3.0, high, "#EAF4FB", "full film"),
        (1.0, 3.0, "#FFF6E3", "mixed"),
        (low, 1.0, "#FBE9E1", "boundary"),
    ):
        if bottom < top:
            axis.axhspan(bottom, top, color=shade, lw=0, zorder=0)
            axis.annotate(
                words, (0.995, bottom), (0, 3), xycoords=axis.get_yaxis_transform(),
                textcoords="offset points", ha="right", va="bottom", fontsize=8.5, color="#666666",
            )  # fmt: skip
    for ratio in (1.0, 3.0):
        axis.axhline(ratio, color="#555555", lw=0.9, ls="--", zorder=1)
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    axis.set_yticks([v for v in (0.1, 0.3, 1, 3, 10, 30, 100, 300) if low <= v <= high])
    axis.yaxis.set_major_formatter("{x:g}")
    axis.minorticks_off()
