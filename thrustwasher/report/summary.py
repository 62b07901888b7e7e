"""What happened in a shift, in sentences made from its numbers."""

from __future__ import annotations

import math

from ..units import format_quantity as say
from .extremes import highest, worst_film
from .shift_record import Record


def sentences(record: Record) -> list[str]:
    """Return three sentences: the course, the clutch's heat, the washer or the energy book."""
    third = _book(record) if worst_film(record) is None else _washer(record)
    return [_course(record), _clutch(record), third]


def warnings(record: Record) -> list[str]:
    """Return what a reader must not miss."""
    found = []
    if record.figures["lock_time"] is None:
        found.append("The clutch did not lock: the shift is not finished at the end of the run.")
    distress = record.figures.get("washer_distress_time") or 0.0
    if distress > 0.0:
        found.append(
            f"Thermo-viscous distress: the washers' oil film was lost for "
            f"{say(distress, 's', digits=3)}. Torque and temperatures of that time are those of "
            "the equations; no real film survives there."
        )
    found += [f"From {e.time:.4g} s on: {e.text}." for e in record.events if "hotter" in e.text]
    return found


def rpm(speed: float) -> str:
    """Return a speed [rad/s] in both units."""
    return f"{speed:.4g} rad/s ({speed * 30.0 / math.pi:.0f} rpm)"


def _course(record: Record) -> str:
    """Return when the brake let go and the clutch locked."""
    figures, start = record.figures, record.ramp_start
    speed = record.at("transmission.engine_speed", start) or 0.0
    words = f"In first gear the engine had reached {rpm(speed)} when, at {start:.4g} s, pressure "
    words += "began to move from the brake to the clutch"
    release, lock, lock_speed = (
        figures["release_time"], figures["lock_time"], figures["lock_speed"]
    )  # fmt: skip
    if release is not None:
        words += f"; the brake let go of the ring at {release:.4g} s"
    if lock is None or lock_speed is None:
        return f"{words}, and the clutch was still slipping at the end."
    return (
        f"{words}, and the clutch locked at {lock:.4g} s, {say(lock - start, 's', digits=3)} after "
        f"the shift began, with the engine at {rpm(lock_speed)}."
    )


def _clutch(record: Record) -> str:
    """Return the clutch's heat and temperature."""
    figures, hot = record.figures, highest(record, "clutch.temperature")
    area, power = figures["slip_energy_per_area"] or 0.0, figures["peak_power"] or 0.0
    rise = hot.value - record.oil_temperature if hot else 0.0
    heated = (
        f"its faces reached {say(hot.value, 'K', digits=3)}" if hot and rise > 0.05
        else "its temperature is that of the oil in this scene"
    )  # fmt: skip
    return (
        f"Slipping turned {say(figures['slip_energy'] or 0.0, 'J', digits=3)} into heat in the "
        f"clutch ({say(area, 'J/m2', digits=3)} of lining), at most {say(power, 'W', digits=3)} "
        f"at once; {heated}."
    )


def _washer(record: Record) -> str:
    """Return how the washers' film fared."""
    low, hot = worst_film(record), highest(record, "washer.temperature_max")
    assert low is not None
    if record.figures.get("washer_distress_time"):
        state = "lost their oil film"
    elif low.value >= 3.0:
        state = "kept a full oil film"
    elif low.value >= 1.0:
        state = "ended up partly on their asperities"
    else:
        state = "ended up on their asperities"
    spot = "" if hot is None else f", their hottest spot was {say(hot.value, 'K', digits=3)}"
    return (
        f"The thrust washers {state}: the least film ratio while they turned was {low.value:.3g} "
        f"at {low.time:.4g} s{spot}, and all of them together took "
        f"{say(record.energy['washers'], 'J', digits=3)}."
    )


def _book(record: Record) -> str:
    """Return how well the energy book closes."""
    book = record.energy
    return (
        f"The engine did {say(book['engine_work'], 'J', digits=3)} of work, the load took "
        f"{say(book['load_work'], 'J', digits=3)}; the energy book closes to "
        f"{book['residual_share']:.1e} of the engine's work."
    )
