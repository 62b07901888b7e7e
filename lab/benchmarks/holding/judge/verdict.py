"""What counts as held, what as told, and what no unit may do."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from .drive import Scene, Trace

REVERSALS, LATE, LATE_OTHERS, SETTLE = 3, 3, 40, 20
TORQUE, SLIP = 1e-3, 0.02  # of capacity; of the first slip
FALL = 1e-9  # of all heat, by which booked heat may fall in a step: rounding


@dataclass
class Verdict:
    """One run: right, told, and why not."""

    ok: bool
    told: bool
    why: str = ""
    broken: str = ""  # what no unit may do
    numbers: dict[str, float] = field(default_factory=dict)

    @property
    def silent(self) -> bool:
        """Wrong, and nothing was said."""
        return not self.ok and not self.told


def reversals(slip: np.ndarray, band: float) -> int:
    """Return how often a slip changes its sign beyond a band."""
    signs = np.sign(slip[np.abs(slip) > band])
    return int(np.count_nonzero(signs[1:] != signs[:-1]))


def stays(slip: np.ndarray, band: float) -> int:
    """Return the point from which a slip stays within a band (its length: never)."""
    loose = np.flatnonzero(~(np.abs(slip) <= band))
    return int(loose[-1]) + 1 if len(loose) else 0


def engagement(scene: Scene, trace: Trace) -> Verdict:
    """Judge a lock by that of ideal packs."""
    j = scene.judged
    slips, torques = scene.ideal
    right_slip, right = slips[:, j], torques.sum(1) if j < 0 else torques[:, j]
    torque = trace.torque.sum(1) if j < 0 else trace.torque[:, j]
    slip = np.append(trace.slip[:, j], trace.final[j])
    ds, n = scene.per_step, len(trace.times)
    band = max(SLIP * abs(scene.first), 0.45 * ds, 3 * scene.quantum, 6 * scene.sigma)
    small = 1e-6 * abs(scene.first)
    lock = stays(right_slip, small if scene.exact else 0.5 * band)
    mine = stays(slip, 0.5 * ds if scene.exact else band)
    if scene.watched:  # slip after a jump of the outside torque is as large as the jump's step
        mine = stays(slip[: scene.watched[0]], 0.5 * ds)
    late = mine - lock - scene.age
    tail = float(np.max(np.abs(slip[n - n // 10 :])))
    turns = reversals(slip, 0.02 * ds)
    error = np.abs(torque - right) / scene.capacity
    settled = np.zeros(n, bool)
    edges = [lock, *scene.watched, n]
    for a, b in pairwise(edges):
        settled[a + SETTLE + scene.age : b] = True
    wrong = float(error[settled].max()) if settled.any() else 0.0
    numbers = {"late": late, "reversals": turns, "torque": wrong, "slip": tail / band}
    why = []
    if trace.failed:
        why.append(f"{trace.failed} steps failed")
    if not np.isfinite(torque).all():
        why.append("not finite")
    if scene.exact:
        if late > LATE + scene.late:
            why.append(f"{late} steps late")
        if turns > REVERSALS * (1 + len(scene.watched)):
            why.append(f"{turns} reversals")
        if not wrong <= TORQUE:
            why.append(f"torque off by {wrong:.2g} C")
    elif late > LATE_OTHERS:
        why.append(f"{late} steps late")
    if tail > band:
        why.append(f"slip at the end {tail / band:.2g} of the band")
    broken = "; ".join(forbidden(scene, trace))
    return Verdict(not why, trace.told, "; ".join(why), broken, numbers)


def forbidden(scene: Scene, trace: Trace) -> list[str]:
    """Return what no unit may do: create energy, book less heat, lock at slip.

    Created: how far the work of the unit's torque on the slip that it sees ever falls back. A
    held torque drives in one step and brakes in the next; less than the heat of a step at capacity
    and 1 % of all is none.
    """
    found = []
    exact = scene.sensor is None
    power = trace.acted * trace.mean if exact else trace.torque * trace.seen
    work = np.cumsum(power * trace.steps[:, None], axis=0)
    created = float((np.maximum.accumulate(work, axis=0) - work).max())
    made = float(np.abs(work).max())
    if created > 0.01 * made + scene.per_step * scene.capacity * trace.steps.max():
        found.append(f"creates {created / max(made, 1e-300):.2g} of the heat")
    fall = np.diff(trace.energy, axis=0)
    total = float(trace.energy.max())
    if fall.min() < -FALL * total:
        found.append(f"energy falls by {-fall.min() / max(total, 1e-300):.2g} of all")
    bound = np.where(np.isnan(trace.bound), 0.1 * abs(scene.first), trace.bound)
    lies = trace.locked & (np.abs(trace.seen) > bound * (1 + 1e-9))
    if lies.any():
        found.append(f"locked at slip in {int(lies.sum())} steps")
    return found
