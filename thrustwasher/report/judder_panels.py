"""Panels of a swinging output shaft: its torque, and the slip of the pack that feeds the swing."""

from __future__ import annotations

from matplotlib.axes import Axes

from .panel_base import draw, draw_phases
from .panels import COLOURS
from .shift_record import Record
from .style import BLUE, GREEN, GREY, beside, label


def draw_shaft(axis: Axes, record: Record) -> None:
    """Draw the torque of the shaft and of the load behind it."""
    draw_phases(axis, record)
    draw(axis, record, "transmission.shaft_torque", "output shaft", BLUE, width=1.0)
    draw(axis, record, "transmission.resistance_torque", "load at the vehicle", GREEN, "--")
    _mark(axis, record)
    label(axis, "Torque of the output shaft", "", "torque [N·m]")
    beside(axis)


def draw_slip(axis: Axes, record: Record) -> None:
    """Draw the slip of the pack."""
    draw_phases(axis, record, words=False)
    pack = record.judder.pack
    draw(axis, record, f"transmission.{pack}_speed", pack, COLOURS[pack], width=1.0)
    _mark(axis, record)
    label(axis, f"Slip of the {pack}", "", "slip [rad/s]")
    beside(axis)


def _mark(axis: Axes, record: Record) -> None:
    """Draw where the swing was judged."""
    for time in (record.judder.start, record.judder.end):
        axis.axvline(time, color=GREY, lw=0.9, ls="--")
