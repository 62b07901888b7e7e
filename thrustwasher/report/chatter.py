"""What to say where the slip of a pack flips from step to step."""

from __future__ import annotations

from typing import Any

from ..units import format_quantity as say
from .shift_record import Record


def chatter_text(record: Record) -> list[str]:
    """Return one warning for each pack that chatters: that it is numerical, and what to change."""
    return [_words(found, record.master) for found in record.chatter]


def _words(c: Any, master: str) -> str:
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
