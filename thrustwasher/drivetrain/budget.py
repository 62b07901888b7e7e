"""How often a guard may look, so that its looks stay a small share of a run.

Reckoned with the costs in the shipped cards, not with the clock: a run repeats itself to the bit on
any machine.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..models._spec import ModelSpec
from ..store.cards import load_cards

SHARE = 0.1  # of a run's wall time, for all looks together
FIRST = 0.2  # of a run; its first look is made there at the latest, whatever it costs
# A washer solved far from its last solution walks there: 3 ms with a thick film, 15 ms in the mixed
# regime, against 0.3 ms a step away.
FAR = {"washer": 50.0}
LOOK = 30e-6  # s; coming back to Python for a look
MASTER = 0.5e-6  # s; the loop itself, a step
# Seconds a step where no card tells: the models' orders of magnitude.
NOMINAL: Mapping[str, Mapping[str, float]] = {
    "washer": {"closed": 1e-6, "stribeck": 3e-6, "map": 3e-6, "coarse": 6e-5, "field": 3e-4,
               "fine": 2e-3},
    "clutch": {"closed": 1e-6, "boundary": 1e-6, "stribeck": 1e-6, "field": 3e-6, "fine": 6e-5},
    "gearmesh": {"closed": 1e-6, "stribeck": 1e-6, "field": 1e-6, "fine": 3e-5},
    "transmission": {},
}  # fmt: skip
OTHERWISE = 2e-6


def seconds_of(spec: ModelSpec, rung: str) -> float:
    """Return what a step of a rung costs, as its cards or else the table above have it [s]."""
    told = [c.cost.call_median_s for c in load_cards(spec.key) if c.fidelity == rung]
    return max(told) if told else NOMINAL.get(spec.key, {}).get(rung, OTHERWISE)


def strides(
    step: float, base: float, above: float, *, far: float = 1.0, guards: int = 1
) -> tuple[int, int]:
    """Return the steps between two looks while the base serves, and while the rung above does.

    Parameters
    ----------
    step : seconds a step of the whole run with the base
    base, above : seconds a step of the two rungs
    far : how many times a step's cost a solve after a long stride takes
    guards : how many parts share the budget
    """
    share = SHARE / max(guards, 1)
    up = step - base + above
    return (
        max(1, math.ceil((far * above + LOOK) / (share * step))),
        max(1, math.ceil((base + LOOK) / (share * up))),
    )


def first_look(steps: int, every: int) -> int:
    """Return the point of the first look in a run of so many steps."""
    return max(1, min(every, round(FIRST * steps)))


def step_seconds(rungs: Mapping[str, tuple[ModelSpec, str]]) -> float:
    """Return what a communication step costs with these rungs [s]."""
    return MASTER + sum(seconds_of(spec, rung) for spec, rung in rungs.values())
