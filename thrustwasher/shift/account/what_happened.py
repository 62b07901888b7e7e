"""What happened in a shift, in sentences: its profile, its heat, its washers, meshes and energy."""

import math
from functools import partial

from ...units import format_quantity
from ..warning_texts import text_of
from .shift_record import Record
from .worst_moments import highest, of_meshes

say = partial(format_quantity, digits=3)
pitting_safety, scuffing_safety = of_meshes("pitting_safety"), of_meshes("scuffing_safety")
STEELS = ("1020", "4340")
WARMER = 0.05  # [K] a rise that counts


def sentences(r: Record) -> list[str]:
    """Return the shift, the heat of the engaging pack, then what sits at the planets or the energy.

    Three sentences; a fourth if there are both washers and gear meshes.
    """
    planets = [*_washers(r), *_meshes(r)]
    return [_stop(r) if r.alone else _shift(r), _heat(r), *(planets or [_energy(r)])]


def headline(r: Record) -> str:
    """Return the shift in one sentence: lock-up, heat, jerk."""
    pack, f, start = r.engaging, r.figures, r.ramp_start
    lock = f["lock_time"]
    locked = f"The {pack} was still slipping at the end"
    if r.sticks_and_slips:
        locked = f"The {pack} stuck and slipped in turn to the end"
    elif lock is not None and r.alone:
        locked = f"The {pack} stopped all slip in {lock - start:.3g} s"
    elif lock is not None:
        locked = f"The {pack} locked at {lock:.4g} s, the shift took {lock - start:.3g} s"
    text = f"{locked}; slipping made {say(f['slip_energy'] or 0.0, 'J')} of heat in it"
    if jerk := f.get("peak_jerk"):
        text += f", and the maximum jerk of the vehicle {spread_words(r, 'peak_jerk', jerk)}"
    return f"{text}."


def spread_words(r: Record, name: str, nominal: float) -> str:
    """Return what a figure is: its median and band and the nominal value, or that alone."""
    figure, spread = r.figure(name), r.spread(name)
    assert figure is not None
    if spread is None:
        return f"was {figure.words(nominal, 3)}"
    low, middle, high = (figure.words(x, 3) for x in spread)
    return (
        f"by the scatter of this scene is {middle} (median; {low} to {high} from 5 to 95 %), "
        f"{figure.words(nominal, 3)} with nominal values"
    )


def known_texts(r: Record) -> list[str]:
    """Return the jerk with the band that is known of its scene."""
    jerk, known = r.figures.get("peak_jerk"), r.known.get("peak_jerk")
    if jerk is None or known is None:
        return []
    ends, why = list(known.quantiles.values()), ""
    if not ends[0] <= jerk <= ends[-1]:
        why = ", which no real unit has"
    return [
        f"The maximum jerk of the vehicle {spread_words(r, 'peak_jerk', jerk)}{why} "
        f"({known.runs} runs)."
    ]


def rpm(speed: float) -> str:
    """Return a speed [rad/s], with rpm next to it."""
    return f"{speed:.4g} rad/s ({speed * 30.0 / math.pi:.0f} rpm)"


def _shift(r: Record) -> str:
    """Return when the one pack let go and the other locked."""
    start, pack, other, f = r.ramp_start, r.engaging, r.releasing, r.figures
    before = r.phases[0].name if r.phases else ""
    speed = rpm(r.at("transmission.engine_speed", start) or 0.0)
    engine = f"{f'In {before}' if 'gear' in before else 'With no pack locked'} the engine"
    if start > r.time[-1]:
        return f"{engine} reached {speed}; the run ends before the shift begins."
    moved = f"move from the {other} to the" if r.presses(other) else "rise on the"
    text = f"{engine} had reached {speed} when, at {start:.4g} s, pressure began to {moved} {pack}"
    if (released := f["release_time"]) is not None:
        drum = " of the drum" if other == "brake" else ""
        text += f"; the {other} let go{drum} at {released:.4g} s"
    if r.sticks_and_slips:
        return f"{text}; from {r.phases[-1].start:.4g} s on the {pack} stuck and slipped in turn."
    lock, lock_speed = f["lock_time"], f.get("lock_speed")
    if lock is None or lock_speed is None:
        return f"{text}, and the {pack} was still slipping at the end."
    return (
        f"{text}, and the {pack} locked at {lock:.4g} s with the engine at {rpm(lock_speed)}: "
        f"the shift took {lock - start:.3g} s."
    )


def _stop(r: Record) -> str:
    """Return how long a pack that acts alone took."""
    f, taken = r.figures, r.figures["lock_after_half_ramp"]
    text = f"From {r.ramp_start:.4g} s on the {r.engaging} was pressed;"
    speed = rpm(f["maximum_slip"] or 0.0)
    if taken is None:
        return f"{text} from {speed} it was still slipping at the end."
    inertia = say(f.get("stopped_inertia") or 0.0, "kg.m2")
    done = (
        f"brought {inertia} from {speed} to rest"
        if r.engaging == "brake"
        else f"ended a slip of {speed} between inertias worth {inertia}"
    )
    return (
        f"{text} it {done} in {taken:.4g} s, counted from the middle of the ramp, with a mean "
        f"friction coefficient of {f['friction_mean'] or 0.0:.4f} and "
        f"{f['friction_lock'] or 0.0:.4f} just before standstill."
    )


def _heat(r: Record) -> str:
    """Return what the packs took up."""
    f, hot = r.figures, highest(r, f"{r.engaging}.temperature")
    faces = "its temperature is that of the oil in this scene."
    if hot and hot.value - r.oil_temperature > WARMER:
        faces = f"its faces reached {say(hot.value, 'K')}."
    text = (
        f"Slipping turned {say(f['slip_energy'] or 0.0, 'J')} into heat in the {r.engaging} "
        f"({say(f['slip_energy_per_area'] or 0.0, 'J/m2')} of lining), at most "
        f"{say(f['peak_power'] or 0.0, 'W')} at once; {faces}"
    )
    both = f.get("shift_heat")
    if both and r.presses(r.releasing):
        text += f" Both packs together took {say(both, 'J')} from the shift's start to the end "
        text += "of the later slip."
    return text


def _washers(r: Record) -> list[str]:
    """Return how the washers' film fared; nothing without washers that turn."""
    low, hot = r.figure("minimum_washer_film_ratio"), highest(r, "washer.temperature_max")
    if low is None or low.value is None:
        return []
    if r.figures.get("washer_distress_time"):
        film = "lost their oil film"
    elif low.value >= 3.0:
        film = "kept a full oil film"
    else:
        film = f"ended up {'partly ' if low.value >= 1.0 else ''}on their asperities"
    least_time = "" if low.time is None else f" at {low.time:.4g} s"
    spot = f", their hottest spot was {say(hot.value, 'K')}" if hot else ""
    return [
        f"The thrust washers {film}: the minimum film ratio while they turned was {low.value:.3g}"
        f"{least_time}{spot}, and all of them together took {say(r.energy['washers'], 'J')}."
    ]


def _meshes(r: Record) -> list[str]:
    """Return how hot the teeth became and what stress was left; nothing without gear meshes."""
    flash, bodies = (r.figures.get(f"peak_{n}_temperature") for n in ("flash", "gear"))
    if flash is None:
        return []
    text = f"The contact of the gear teeth reached {say(flash, 'K')}"
    if bodies is not None:
        text += f", the gears' bodies {say(bodies, 'K')}"
    if (stress := stress_words(r)) and not stress_words(r, over=1.0):
        text += f", tooth stress at most {stress}"
    if pitting := pitting_safety(r):
        scuffing = scuffing_safety(r) or 0.0
        text += f", the minimum safety against pitting was {pitting:.2f}, against scuffing "
        text += f"{scuffing:.2f}"
    text += f"; all meshes together took {say(r.energy['meshes'], 'J')}"
    if bearings := r.energy.get("bearings"):
        text += f", the thrust bearings of sun and ring {say(bearings, 'J')}"
    if losses := r.energy.get("losses"):
        text += f", oil pump, churning, bearings and seals {say(losses, 'J')}"
    return [f"{text}."]


def stress_words(r: Record, over: float = 0.0) -> str:
    """Return the maximum stress over endurance of the steels where it is above ``over``."""
    margins = {steel: r.figures.get(f"stress_margin_aisi{steel}") for steel in STEELS}
    return " and ".join(
        text_of("endures", times=1.0 - margin, steel=steel)
        for steel, margin in margins.items()
        if not r.rated_teeth and margin is not None and 1.0 - margin > over
    )


def _energy(r: Record) -> str:
    """Return what work became heat, and how well the balance closes."""
    book = r.energy
    text = f"The kinetic energy fell by {say(abs(book['kinetic']), 'J')}"
    if work := book["engine_work"]:
        text = f"The engine did {say(work, 'J')} of work, the load took "
        text += say(book["load_work"], "J")
    share = f"{book['residual_share']:.1e}"
    return f"{text}; the energy balance closes to {share} of {r.whole_name}."
