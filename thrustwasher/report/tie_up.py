"""What to say where both packs of a shift worked against each other."""

from __future__ import annotations

from ..units import format_quantity as say
from .shift_record import Record

MOSTLY = 0.5  # share of the torque from which the oil is called the cause


def tie_up_text(record: Record) -> list[str]:
    """Return what a tie-up was and where it came from; nothing where there was none."""
    lasted, most = record.figure("tie_up_duration"), record.figure("tie_up_torque")
    heat = record.figures.get("tie_up_heat")
    if lasted is None or most is None or lasted.value is None or most.value is None:
        return []
    other = record.releasing
    before = record.at(f"transmission.{other}_reaction", record.ramp_start) or 0.0
    begin = lasted.time or record.ramp_start
    words = (
        f"Tie-up: from {begin:.4g} s on both packs worked against each other for "
        f"{say(lasted.value, 's', digits=3)}. The torque of the {other} turned from "
        f"{say(before, 'N.m', digits=3)} to {say(most.value, 'N.m', digits=3)}, and it took up "
        f"{say(heat or 0.0, 'J', digits=3)} of heat meanwhile."
    )
    return [f"{words}{_cause(record, begin)}"]


def _cause(record: Record, begin: float) -> str:
    """Return where the early torque came from, if that was the shear of the oil."""
    pack = record.engaging
    oil, whole = (
        abs(record.at(f"{pack}.{name}", begin) or 0.0)
        for name in ("viscous_torque", "friction_torque")
    )
    if not whole or oil / whole < MOSTLY:
        return ""
    return (
        f" The {pack} closed early: {oil / whole:.0%} of its torque at {begin:.4g} s was shear of "
        f"the oil, supplied at {say(record.oil_temperature, 'K', digits=3)}."
    )
