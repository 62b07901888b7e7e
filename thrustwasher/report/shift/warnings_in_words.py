"""What to say where packs work against each other, a shaft swings or a slip flips."""

from typing import Any

from ...units import format_quantity as say
from .shift_record import Record

TITLES = {
    "physical": "Judder",
    "decaying": "A swing of the shaft that decays",
    "numerical": "A swing of the shaft made by the communication step",
    "unexplained": "A swing of the shaft",
}
RATE = "per second"
ADAPTIVE = "step-doubling"
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
    return [f"{words}{_oil_as_cause(record, begin)}"]


def _oil_as_cause(record: Record, begin: float) -> str:
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


def judder_text(record: Record) -> list[str]:
    """Return what a reader must not miss; nothing where no swing grows or is hidden."""
    found = record.judder
    return [] if found is None or found.kind == "decaying" else [judder_words(record)]


def judder_words(record: Record) -> str:
    """Return what the swing is, how fast it grows, why, and what to change."""
    found = record.judder
    texts = {
        "physical": _physical, "decaying": _decaying, "numerical": _numerical,
        "unexplained": _unexplained,
    }  # fmt: skip
    words = texts[found.kind](found)
    if found.kind == "numerical" and record.master == ADAPTIVE:
        words += " This master chooses its steps itself: lower master_tolerance."
    return words[0].upper() + words[1:]


def _physical(j: Any) -> str:
    return (
        f"Judder: {_swing(j)}, {_reaches(j)}. It is physical, not numerical: the driveline's "
        f"eigenvalue says {j.mode_growth:.3g} {RATE} at {j.mode_frequency:.3g} Hz, and the "
        f"communication step of {say(j.step, 's')} adds {j.step_growth:.1g}. {_cause(j)} A "
        "smaller step or another master does not end it; more damping does, or friction that "
        "falls less."
    )


def _decaying(j: Any) -> str:
    return f"{_swing(j)}; the driveline's eigenvalue says {-j.mode_growth:.3g}. {_cause(j)}"


def _numerical(j: Any) -> str:
    """Return that the step makes the difference; it may hide judder as well as make a swing."""
    if j.mode_growth > 0.0 and j.growth > 0.0:
        name = "Judder that the communication step falsifies"
    else:
        name = "Numerical, no judder" if j.growth > 0.0 else "Judder hidden by the step"
    own = "grow" if j.mode_growth > 0.0 else "decay"
    return (
        f"{name}: {_swing(j)}, {_reaches(j)}, but the driveline's eigenvalue says that it should "
        f"{own} by {abs(j.mode_growth):.3g}. Handing torques over once per step of "
        f"{say(j.step, 's')} makes the difference: it is computed to add {j.step_growth:+.3g}. Use "
        f"a step of {say(j.good_step, 's', digits=2)} or less. {_cause(j)}"
    )


def _unexplained(j: Any) -> str:
    return (
        f"{_swing(j)}, {_reaches(j)}; the driveline's eigenvalue says {j.mode_growth:+.3g}, and "
        "the communication step does not explain the difference. Repeat the run with half the "
        f"step: growth that stays is physical. {_cause(j)}"
    )


def _swing(j: Any) -> str:
    """Return frequency and growth as measured."""
    verb = "grows" if j.growth > 0.0 else "decays"
    return (
        f"from {j.start:.3g} s on the shaft torque swings at {j.frequency:.3g} Hz and {verb} by "
        f"{abs(j.growth):.3g} {RATE}"
    )


def _reaches(j: Any) -> str:
    """Return how far the swing goes."""
    words = f"up to {say(j.amplitude, 'N.m', digits=3)}"
    if not j.stick_slip:
        return words
    return f"{words}, where the {j.pack} sticks and slips in turn ({j.locks} lock-ups)"


def _cause(j: Any) -> str:
    """Return the criterion: slope of friction against damping."""
    if j.slope >= 0.0:
        return (
            f"The {j.pack}'s torque rises by {j.slope:.3g} N·m per rad/s of slip, which damps the "
            "swing."
        )
    return (
        f"The {j.pack}'s torque falls by {-j.slope:.3g} N·m per rad/s of slip; the "
        f"swing grows below {say(j.limit_damping, 'N.m.s/rad', digits=3)} of damping in the "
        f"shaft, which has {say(j.damping, 'N.m.s/rad', digits=3)}."
    )


def chatter_text(record: Record) -> list[str]:
    """Return one warning for each pack that chatters: that it is numerical, and what to change."""
    return [_chatter(found, record.master) for found in record.chatter]


def _chatter(c: Any, master: str) -> str:
    smoothing = c.smoothing * c.step / c.good_step
    limit = "" if c.limit is None else f"; the master {master} is stable below {c.limit:g}"
    return (
        f"Numerical: from {c.start:.4g} s on the slip of the {c.pack} changes its sign {c.turns} "
        f"times from one step to the next, where a real {c.pack} sticks. Its friction passes "
        f"through zero with {c.slope:.3g} N·m per rad/s, against an inertia of "
        f"{say(c.inertia, 'kg.m2', digits=3)}: at a step of {say(c.step, 's')} that is kappa = "
        f'{c.kappa:.3g}{limit}. Use coupling = "capacity", the master linearly-implicit, steps of '
        f"{say(c.good_step, 's', digits=2)} or a speed_smoothing of "
        f"{say(smoothing, 'rad/s', digits=2)}."
    )
