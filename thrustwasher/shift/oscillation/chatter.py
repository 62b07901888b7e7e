"""Chatter: a slip that changes its sign from step to step, which no pack does.

With ``coupling`` = torque friction passes through zero over a narrow range of slip. Where the step
is too long for that slope, the torque of one step throws the slip to the other side.
"""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ...numerics.jit import Array
from ...transmission.mobility import planetary
from ..scene.connections import PACKS
from ..scene.scene import Scene

Signals = dict[str, Array]
MANY = 10  # changes of sign
LIMITS = {"gauss-seidel": 2.0, "jacobi": 1.0}  # kappa, with torques fresh or a step old
CLOSE = 5  # steps between two changes; with torques a step old a period takes six to eight


@dataclass(frozen=True, kw_only=True)
class Chatter:
    """A pack whose slip flips, and how far the step is over what its loop stands."""

    pack: str
    start: float  # [s]
    turns: int  # Changes of the slip's sign, each a few steps after the last
    slope: float  # [N m s/rad] of friction through zero: capacity over the smoothing
    inertia: float  # [kg m2] that the slip sees
    smoothing: float  # [rad/s] over which friction passes through zero
    step: float  # [s]
    limit: float | None
    """Of ``kappa``, where the loop becomes unstable with this master; None: it has none."""

    @property
    def kappa(self) -> float:
        """The step by slope over inertia: by how much a step's torque turns the slip round."""
        return self.step * self.slope / self.inertia

    @property
    def good_step(self) -> float:
        """Step [s] without oscillation: kappa 1, with torques a step old a quarter."""
        free = 0.25 if self.limit == LIMITS["jacobi"] else 1.0
        return free * self.inertia / self.slope

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as JSON can hold it."""
        return {**asdict(self), "kappa": self.kappa, "good_step": self.good_step}


def find_chatter(scene: Scene, time: Array, signals: Signals, step: float) -> list[Chatter]:
    """Return the packs that chatter; none with ``coupling`` = capacity, where packs stick."""
    params = scene.parts["transmission"].params
    if params.coupling != "torque":
        return []
    found = []
    for pack in PACKS:
        slip = signals[f"transmission.{pack}_speed"]
        turns = np.flatnonzero(slip[1:] * slip[:-1] < 0.0) + 1
        close = turns[1:][np.diff(turns) <= CLOSE]
        if len(close) < MANY:
            continue
        smoothing = scene.parts[pack].params.speed_smoothing
        capacity = float(np.median(signals[f"{pack}.torque_capacity"][close]))
        m = planetary(
            params.ratio,
            params.input_inertia,
            params.drum_inertia,
            params.carrier_inertia,
            params.vehicle_inertia,
            pack,
        )
        found.append(
            Chatter(
                pack=pack,
                start=float(time[close[0]]),
                turns=len(close),
                slope=capacity / smoothing,
                inertia=1.0 / m.slip,
                smoothing=smoothing,
                step=min(step, float(np.median(np.diff(time)[close - 1]))),  # where it chatters
                limit=LIMITS.get(scene.master),
            )
        )
    return found
