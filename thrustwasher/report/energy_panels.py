"""Panels of energy and heat flow over the time of a shift."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .panel_base import draw_phases, thin
from .panels import COLOURS
from .shift_record import PACKS, Record
from .style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    beside,
    label,
    powers_of_ten,
)  # fmt: skip

Array = np.ndarray[Any, Any]
LEAST_POWER = 0.1  # [W] the foot of the logarithmic axis


def draw_energy(axis: Axes, record: Record) -> None:
    """Draw where the energy went as areas that fill up to what came in."""
    zero = np.zeros_like(record.time)

    def kilojoules(name: str) -> Array:
        values = record.series(f"transmission.{name}")
        return zero if values is None else values / 1e3

    parts = [
        (kilojoules(name), words, colour)
        for name, words, colour in (
            ("load_work", "work into the load", GREEN),
            ("clutch_heat", "heat in the clutch", RED),
            ("brake_heat", "heat in the brake", PURPLE),
            ("washer_heat", "heat in all washers", ORANGE),
            ("mesh_heat", "heat in all meshes", SKY),
            ("shaft_heat", "heat in the output shaft", GREY),
        )
    ]
    parts = [part for part in parts if np.any(part[0] != 0.0)]
    some = thin(record)
    if parts:
        axis.stackplot(record.time[some], *(p[0][some] for p in parts), lw=0, alpha=0.8,
                       labels=[p[1] for p in parts], colors=[p[2] for p in parts])  # fmt: skip
    # What the shaft's spring keeps counts as kinetic: it comes back.
    engine, kinetic = kilojoules("engine_work"), kilojoules("kinetic_change")
    kinetic = kinetic + kilojoules("shaft_energy")
    if np.any(engine):
        axis.plot(record.time, engine, color=BLUE, label="work of the engine")
        words = "engine, less kinetic energy gained" if kinetic[-1] > 0.0 else (
            "engine + kinetic energy given up"
        )  # fmt: skip
    else:
        words = "kinetic energy given up"
    axis.plot(record.time, engine - kinetic, color=BLACK, ls="--", lw=1.2, label=words)
    title = "Energy: the areas fill up to the dashed line if no joule is lost"
    label(axis, title, "", "energy since the start [kJ]")
    beside(axis)


def draw_heat_flow(axis: Axes, record: Record) -> None:
    """Draw the friction power of the packs, of one washer and of one mesh, by decades."""
    draw_phases(axis, record)
    lines = [(pack, pack, COLOURS[pack]) for pack in PACKS if record.presses(pack)]
    lines += [("washer", "one washer", ORANGE), ("mesh", "one mesh", GREEN)]
    for part, words, colour in lines:
        values = record.series(f"{part}.friction_power")
        if values is not None and np.any(values > LEAST_POWER):
            shown = np.where(values > LEAST_POWER, values, np.nan)
            axis.plot(record.time, shown, color=colour, label=words)
    axis.set_yscale("log")
    axis.set_ylim(bottom=LEAST_POWER)
    powers_of_ten(axis)
    label(axis, "Heat flow", "", "power [W]")
    beside(axis)
