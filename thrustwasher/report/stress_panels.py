"""Panels of tooth stress over the time of a shift: how near the endurance limit."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from .panel_base import draw, draw_phases
from .shift_record import Record
from .style import BLACK, BLUE, ORANGE, beside, label

STEELS = (("aisi1020", "AISI 1020", BLUE), ("aisi4340", "AISI 4340", ORANGE))


def draw_stress(axis: Axes, record: Record) -> None:
    """Draw the utilisation of both steels; 1 is the endurance limit."""
    draw_phases(axis, record)
    for key, words, colour in STEELS:
        draw(axis, record, f"mesh.stress_utilization_{key}", words, colour)
    axis.axhline(1.0, color=BLACK, lw=0.9, ls=(0, (1, 3)), label="endurance limit")
    axis.set_ylim(bottom=0.0)
    label(axis, "Tooth stress, mechanical and thermal together, over its endurance limit", "",
          "utilisation [1]")  # fmt: skip
    beside(axis)


def draw_allowable(axis: Axes, record: Record) -> None:
    """Draw by what factor heat lowers the contact stress allowed."""
    draw_phases(axis, record, words=False)
    lowest = 1.0
    for key, words, colour in STEELS:
        name = f"mesh.allowable_ratio_{key}"
        values = record.series(name)
        if values is not None:
            draw(axis, record, name, words, colour)
            lowest = min(lowest, float(np.min(values)))
    axis.set_ylim(max(0.0, lowest - 0.1), 1.05)
    label(axis, "Contact stress allowed with heat, over that without", "", "ratio [1]")
    beside(axis)
