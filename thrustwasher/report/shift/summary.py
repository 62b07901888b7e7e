"""What happened in a shift, in sentences made from its numbers."""

import math

from ...units import format_quantity as say
from .shift_record import Record
from .warnings_in_words import chatter_text, judder_text, tie_up_text
from .worst_moments import highest


def sentences(record: Record) -> list[str]:
    """Return the course, the heat of the engaging pack, then what sits at the planets or the book.

    Three sentences; a fourth if there are both washers and gear meshes.
    """
    planets = [words for words in (_washer(record), _mesh(record)) if words]
    return [_course(record), _pack(record), *(planets or [_book(record)])]


def warnings(record: Record) -> list[str]:
    """Return what a reader must not miss."""
    found = []
    figures = record.figures
    if figures["lock_time"] is None:
        found.append(
            f"The {record.engaging} did not lock: the shift is not finished at the end of the run."
        )
    found += tie_up_text(record)
    found += judder_text(record)
    found += chatter_text(record)
    distress = figures.get("washer_distress_time") or 0.0
    if distress > 0.0:
        found.append(
            f"Thermo-viscous distress: the washers' oil film was lost for "
            f"{say(distress, 's', digits=3)}. Torque and temperatures of that time are those of "
            "the equations; no real film survives there."
        )
    over = _stress(record, over=1.0)
    if over:
        found.append(
            f"Tooth stress beyond endurance: {over}. It is the stress of one straight pair of "
            "teeth that carries the whole load; hardened flanks endure more than these steels."
        )
    found += [f"From {e.time:.4g} s on: {e.text}." for e in record.events if "hotter" in e.text]
    return found


def rpm(speed: float) -> str:
    """Return a speed [rad/s] in both units."""
    return f"{speed:.4g} rad/s ({speed * 30.0 / math.pi:.0f} rpm)"


def whole_name(record: Record) -> str:
    """Return what shares of the energy book refer to."""
    return "the engine's work" if record.energy["engine_work"] else "the kinetic energy"


def _course(record: Record) -> str:
    """Return when the one pack let go and the other locked."""
    if record.alone:
        return _stop(record)
    figures, start = record.figures, record.ramp_start
    pack, other = record.engaging, record.releasing
    speed = record.at("transmission.engine_speed", start) or 0.0
    before = record.phases[0].name if record.phases else ""
    gear = f"In {before}" if "gear" in before else "With no pack locked"
    if start > record.time[-1]:
        return f"{gear} the engine reached {rpm(speed)}; the run ends before the shift begins."
    words = f"{gear} the engine had reached {rpm(speed)} when, at {start:.4g} s, pressure "
    moves = (
        f"move from the {other} to the {pack}" if record.presses(other) else f"rise on the {pack}"
    )
    words += f"began to {moves}"
    release, lock, lock_speed = (
        figures["release_time"], figures["lock_time"], figures["lock_speed"]
    )  # fmt: skip
    if release is not None:
        object_ = " of the ring" if other == "brake" else ""
        words += f"; the {other} let go{object_} at {release:.4g} s"
    if lock is None or lock_speed is None:
        return f"{words}, and the {pack} was still slipping at the end."
    if record.judder and record.judder.stick_slip:
        return f"{words}; from {lock:.4g} s on the {pack} stuck and slipped in turn."
    return (
        f"{words}, and the {pack} locked at {lock:.4g} s, {lock - start:.3g} s after "
        f"the shift began, with the engine at {rpm(lock_speed)}."
    )


def _stop(record: Record) -> str:
    """Return how long a pack that acts alone took."""
    figures, pack, start = record.figures, record.engaging, record.ramp_start
    words = f"From {start:.4g} s on the {pack} was pressed"
    taken, speed = figures["lock_after_half_ramp"], figures["greatest_slip"] or 0.0
    if taken is None:
        return f"{words}; from {rpm(speed)} it was still slipping at the end."
    inertia = say(figures.get("stopped_inertia") or 0.0, "kg.m2", digits=3)
    what = f"brought {inertia} from {rpm(speed)} to rest" if pack == "brake" else (
        f"ended a slip of {rpm(speed)} between inertias worth {inertia}"
    )  # fmt: skip
    return (
        f"{words}; it {what} in {taken:.4g} s, counted from the middle of the ramp, with a mean "
        f"friction coefficient of {figures['friction_mean'] or 0.0:.4f} and "
        f"{figures['friction_lock'] or 0.0:.4f} just before standstill."
    )


def _pack(record: Record) -> str:
    """Return the heat and temperature of the pack that engages."""
    pack = record.engaging
    figures, hot = record.figures, highest(record, f"{pack}.temperature")
    area, power = figures["slip_energy_per_area"] or 0.0, figures["peak_power"] or 0.0
    rise = hot.value - record.oil_temperature if hot else 0.0
    heated = (
        f"its faces reached {say(hot.value, 'K', digits=3)}" if hot and rise > 0.05
        else "its temperature is that of the oil in this scene"
    )  # fmt: skip
    return (
        f"Slipping turned {say(figures['slip_energy'] or 0.0, 'J', digits=3)} into heat in the "
        f"{pack} ({say(area, 'J/m2', digits=3)} of lining), at most {say(power, 'W', digits=3)} "
        f"at once; {heated}."
    )


def _washer(record: Record) -> str:
    """Return how the washers' film fared; nothing without washers that turn."""
    low, hot = record.figure("least_washer_film_ratio"), highest(record, "washer.temperature_max")
    if low is None or low.value is None:
        return ""
    if record.figures.get("washer_distress_time"):
        state = "lost their oil film"
    elif low.value >= 3.0:
        state = "kept a full oil film"
    elif low.value >= 1.0:
        state = "ended up partly on their asperities"
    else:
        state = "ended up on their asperities"
    when = "" if low.time is None else f" at {low.time:.4g} s"
    spot = "" if hot is None else f", their hottest spot was {say(hot.value, 'K', digits=3)}"
    return (
        f"The thrust washers {state}: the least film ratio while they turned was {low.value:.3g}"
        f"{when}{spot}, and all of them together took "
        f"{say(record.energy['washers'], 'J', digits=3)}."
    )


def _mesh(record: Record) -> str:
    """Return how hot the teeth became and what stress was left; nothing without gear meshes."""
    figures = record.figures
    flash, surface = figures.get("peak_flash_temperature"), figures.get("peak_mesh_temperature")
    if flash is None or surface is None:
        return ""
    stress = "" if _stress(record, over=1.0) else _stress(record)  # beyond 1 it is a warning
    left = f", tooth stress at most {stress}" if stress else ""
    return (
        f"On the gear teeth asperities reached {say(flash, 'K', digits=3)} and the surface below "
        f"them {say(surface, 'K', digits=3)}{left}; all meshes together took "
        f"{say(record.energy['meshes'], 'J', digits=3)}."
    )


def _stress(record: Record, over: float = 0.0) -> str:
    """Return the greatest stress over endurance of the steels where it is above ``over``."""
    found = []
    for steel, words in (("aisi1020", "AISI 1020"), ("aisi4340", "AISI 4340")):
        margin = record.figures.get(f"stress_margin_{steel}")
        if margin is not None and 1.0 - margin > over:
            found.append(f"{1.0 - margin:.2f} times what {words} endures")
    return " and ".join(found)


def _book(record: Record) -> str:
    """Return how well the energy book closes."""
    book = record.energy
    closes = (
        f"the energy book closes to {book['residual_share']:.1e} of {whole_name(record)}."
    )  # fmt: skip
    if not book["engine_work"]:
        given = say(abs(book["kinetic"]), "J", digits=3)
        return f"The kinetic energy fell by {given}; {closes}"
    return (
        f"The engine did {say(book['engine_work'], 'J', digits=3)} of work, the load took "
        f"{say(book['load_work'], 'J', digits=3)}; {closes}"
    )
