"""What to say where the output shaft swings while a pack slips."""

from __future__ import annotations

from typing import Any

from ..units import format_quantity as say
from .shift_record import Record

TITLES = {
    "physical": "Judder",
    "decaying": "A swing of the shaft that decays",
    "numerical": "A swing of the shaft made by the communication step",
    "unexplained": "A swing of the shaft",
}
RATE = "per second"
ADAPTIVE = "step-doubling"


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
