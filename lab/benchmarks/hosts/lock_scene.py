"""The scene of a pack that locks between two inertias, and what is measured in it."""

import json
import re
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

STEP, STOP = 1e-3, 2.0  # s
STARTS = {"oil_temperature": 363.15}  # inputs of the clutch that nothing is wired to
# output of the plant, input of the clutch; the clutch's torque goes back to the plant
WIRES = (("slip", "speed"), ("load", "load"))
TORQUE = "friction_torque"
EXTRAS = ("locked", "plant_inertia", "plant_age")  # what a clutch that holds by itself tells
LOCKED = 1e-3  # rad/s, below which the pack counts as locked
STAYS = 0.05  # s, that it must stay so until the end
REVERSAL = 1e-3  # of the first slip, from which a change of sign counts
LATE = 0.3  # s, at the end


def measured(
    times: Sequence[float],
    slips: Sequence[float],
    torque: float,
    messages: Sequence[str] = (),
    **more: Any,
) -> dict[str, Any]:
    """Return what a run came to.

    Slip reversals, when the pack locked for good, torque at the end, largest slip late in the run,
    what was logged as a warning or an error.
    """
    signs = [slip > 0 for slip in slips if abs(slip) > REVERSAL * abs(slips[0])]
    loose = [k for k, slip in enumerate(slips) if not abs(slip) < LOCKED]
    after = loose[-1] + 1 if loose else 0
    held = after < len(times) and times[-1] - times[after] >= STAYS
    late = [abs(slip) for t, slip in zip(times, slips, strict=True) if t > times[-1] - LATE - 1e-9]
    return {
        "reversals": sum(a != b for a, b in pairwise(signs)),
        "lock": times[after] if held else None,
        "torque": torque,
        "late": max(late),
        "end": times[-1],
        "messages": warnings(messages),
        **more,
    }


def warnings(lines: Sequence[str]) -> list[str]:
    """Return the different lines that tell of warnings and errors, and how often each came."""
    found: dict[str, int] = {}
    for line in lines:
        if re.search("error|warn|fatal|discard", line, re.I):
            text = re.sub(r"^(\[\d{4}-[^]]*\] |\[0x[^]]*\] )+", "", line.strip())[:300]
            found[text] = found.get(text, 0) + 1
    return [f"{text} ({count}x)" if count > 1 else text for text, count in found.items()]


def told(**what: Any) -> None:
    """Print a run as a line of JSON."""
    print(json.dumps(what, allow_nan=True))
