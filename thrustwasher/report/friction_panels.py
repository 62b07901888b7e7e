"""Friction of the pack that engages, against its slip, as a braking test shows it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..models.clutch_params import mean_radius
from .shift_record import Record
from .style import BLACK, BLUE, GREY, ORANGE, beside, label

Array = np.ndarray[Any, Any]
RPM = 30.0 / math.pi
SHOWN = 2.5  # times the largest coefficient of the faces: above, the load is only beginning
LEAST_LOAD = 1.0  # N


def slipping(record: Record) -> Array:
    """Return the indices of the points between ramp start and lock-up where the pack slips."""
    slip = record.series(f"{record.engaging}.speed")
    end = record.figures.get("lock_time") or float(record.time[-1])
    if slip is None:
        return np.array([], dtype=int)
    inside = (record.time >= record.ramp_start) & (record.time < end) & (slip != 0.0)
    return np.flatnonzero(inside)


def draw_friction(axis: Axes, record: Record) -> bool:
    """Draw the coefficient over falling slip; False if it is constant or nothing slips."""
    pack, where = record.engaging, slipping(record)
    friction = record.series(f"{pack}.friction_coefficient")
    if friction is None or len(where) < 2 or np.ptp(friction[where]) < 1e-9:
        return False
    rpm = np.abs(record.signals[f"{pack}.speed"][where]) * RPM
    axis.plot(rpm, friction[where], color=BLUE, label="faces in contact")
    whole = _with_oil(record, where)
    if whole is not None:
        shown = np.where(whole < SHOWN * np.max(friction[where]), whole, np.nan)
        axis.plot(rpm, shown, color=ORANGE, ls="--", label="torque over load, oil's shear included")
    _draw_published(axis, record)
    axis.set_xlim(float(np.max(rpm)) * 1.02, 0.0)
    axis.set_ylim(bottom=0.0)
    label(axis, f"Friction of the {pack} as its slip falls", "slip [rpm], falling",
          "friction coefficient [1]")  # fmt: skip
    beside(axis)
    return True


def _with_oil(record: Record, where: Array) -> Array | None:
    """Return torque over load, mean radius and faces; None if the oil adds nothing of its own."""
    pack = record.engaging
    part, torque = record.part(pack), record.series(f"{pack}.friction_torque")
    oil, load = record.series(f"{pack}.viscous_torque"), record.series(f"{pack}.load")
    if part is None or torque is None or oil is None or load is None or not np.any(oil[where]):
        return None
    p = part.parameters
    radius = p["effective_radius"] or mean_radius(p["inner_radius"], p["outer_radius"])
    able = np.maximum(load[where], LEAST_LOAD) * radius * p["faces"]
    return np.asarray(np.abs(torque[where]) / able)


def _draw_published(axis: Axes, record: Record) -> None:
    """Draw the mean of this run and what the scene's source says."""
    mean = record.figures.get("friction_mean")
    if mean is not None:
        axis.axhline(mean, color=GREY, lw=1.0, label=f"mean of this run {mean:.4g}")
    for item in record.published:
        if item.name == "friction_mean":
            axis.axhline(item.published, color=BLACK, lw=1.0, ls=":",
                         label=f"published mean {item.published:.4g}")  # fmt: skip
        elif item.name == "friction_lock":
            axis.plot([0.0], [item.published], "o", color=BLACK, ms=6, clip_on=False,
                      label=f"published at lock-up {item.published:.4g}")  # fmt: skip
        elif item.name == "full_friction_speed":
            axis.axvline(item.published * RPM, color=BLACK, lw=1.0, ls="--",
                         label=f"published: full below {item.published * RPM:.0f} rpm")  # fmt: skip
