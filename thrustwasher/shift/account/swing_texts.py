"""A swing of the shaft and a slip that flips: physical or numerical, and what to change."""

from functools import partial
from typing import Any

from ...units import format_quantity
from .shift_record import Record

say = partial(format_quantity, digits=3)


def judder_text(r: Record) -> str:
    """Return what a swing of the shaft is, how fast it grows, why, and what to change."""
    j = r.judder
    match j.kind:
        case "physical":
            return (
                f"Judder: {_swing(j, 'from')}, {_reaches(j)}. It is physical, not numerical: the "
                f"driveline's eigenvalue says {j.mode_growth:.3g} per second at "
                f"{j.mode_frequency:.3g} Hz, and the communication step of "
                f"{say(j.step, 's', digits=4)} adds {j.step_growth:.1g}. {_cause(j)} A smaller "
                "step or another master does not end it; more damping does, or friction that falls "
                "less."
            )
        case "decaying":
            return (
                f"{_swing(j, 'From')}; the driveline's eigenvalue says {-j.mode_growth:.3g}. "
                f"{_cause(j)}"
            )
        case "numerical":
            return _numerical(r, j)
    return (
        f"{_swing(j, 'From')}, {_reaches(j)}; the driveline's eigenvalue says "
        f"{j.mode_growth:+.3g}, and the communication step does not explain the difference. Repeat "
        f"the run with half the step: growth that stays is physical. {_cause(j)}"
    )


def _numerical(r: Record, j: Any) -> str:
    """Return a swing that the step makes; it may hide judder as well."""
    grows = j.mode_growth > 0.0
    head = "Judder that the communication step falsifies" if grows else "Numerical, no judder"
    head = head if j.growth > 0.0 else "Judder hidden by the step"
    return (
        f"{head}: {_swing(j, 'from')}, {_reaches(j)}, but the driveline's eigenvalue says that it "
        f"should {'grow' if grows else 'decay'} by {abs(j.mode_growth):.3g}. Handing torques over "
        f"once per step of {say(j.step, 's', digits=4)} makes the difference: it is computed to "
        f"add {j.step_growth:+.3g}. Use a step of {say(j.good_step, 's', digits=2)} or less. "
        f"{_cause(j)}"
    )


def _swing(j: Any, first: str) -> str:
    """Return frequency and growth as measured."""
    return (
        f"{first} {j.start:.3g} s on the shaft torque swings at {j.frequency:.3g} Hz and "
        f"{'grows' if j.growth > 0.0 else 'decays'} by {abs(j.growth):.3g} per second"
    )


def _reaches(j: Any) -> str:
    """Return how far the torque swings, and whether the pack sticks in between."""
    text = f"up to {say(j.amplitude, 'N.m')}"
    if j.stick_slip:
        text += f", where the {j.pack} sticks and slips in turn ({j.locks} lock-ups)"
    return text


def _cause(j: Any) -> str:
    """Return the criterion: slope of friction against damping."""
    if j.slope >= 0.0:
        return (
            f"The {j.pack}'s torque rises by {j.slope:.3g} N·m per rad/s of slip, which damps the "
            "swing."
        )
    return (
        f"The {j.pack}'s torque falls by {-j.slope:.3g} N·m per rad/s of slip; the swing grows "
        f"below {say(j.limit_damping, 'N.m.s/rad')} of damping in the shaft, which has "
        f"{say(j.damping, 'N.m.s/rad')}."
    )


def chatter_texts(r: Record) -> list[str]:
    """Return a warning for each pack whose slip flips: that it is numerical, and what to change."""
    found = []
    for c in r.chatter:
        limit = "" if c.limit is None else f"; the master {r.master} is stable below {c.limit:g}"
        smoothing = say(c.smoothing * c.step / c.good_step, "rad/s", digits=2)
        found.append(
            f"Numerical: from {c.start:.4g} s on the slip of the {c.pack} changes its sign "
            f"{c.turns} times from one step to the next, where a real {c.pack} sticks. Its "
            f"friction passes through zero with {c.slope:.3g} N·m per rad/s, against an inertia of "
            f"{say(c.inertia, 'kg.m2')}: at a step of {say(c.step, 's', digits=4)} that is kappa = "
            f'{c.kappa:.3g}{limit}. Use coupling = "capacity", the master linearly-implicit, steps '
            f"of {say(c.good_step, 's', digits=2)} or a speed_smoothing of {smoothing}."
        )
    return found
