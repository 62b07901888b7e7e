"""Drivelines with packs, stepped exactly under held torques, and the same with ideal friction.

A driveline is linear: x' = A x + B u, with u the outside torques and then the packs' torques, and
the slips s = S x. A step with held torques is exact (matrix exponential). The ideal pack (Coulomb
friction that sticks) is stepped in fractions of a step; of one pack between two inertias the lock
is known in closed form, which a test compares.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np
from scipy.linalg import expm

SWEEPS = 60  # of the packs' torques per fraction of a step, at most
Array = np.ndarray


class Driveline:
    """Speeds and twists of a driveline; ``slip`` of each pack.

    ``matrix`` A (n, n), ``torques`` B (n, outside + packs), ``slips`` S (packs, n), ``state`` x.
    A pack's torque is positive where it slows a positive slip.
    """

    def __init__(self, matrix: Array, torques: Array, slips: Array, state: Sequence[float]) -> None:
        self.matrix, self.torques, self.slips = (
            np.asarray(m, dtype=float) for m in (matrix, torques, slips)
        )
        self.state = np.asarray(state, dtype=float).copy()
        self.packs = len(self.slips)
        self.outside = self.torques.shape[1] - self.packs
        self._maps: dict[float, tuple[Array, Array]] = {}

    def copy(self) -> Driveline:
        """Return the same driveline in the same state."""
        return Driveline(self.matrix, self.torques, self.slips, self.state)

    def map(self, h: float) -> tuple[Array, Array]:
        """Return the matrices of a step with held torques."""
        if h not in self._maps:
            n, m = self.torques.shape
            if not self.matrix.any():
                self._maps[h] = np.eye(n), self.torques * h
            else:
                whole = np.zeros((n + m, n + m))
                whole[:n, :n], whole[:n, n:] = self.matrix * h, self.torques * h
                whole = expm(whole)
                self._maps[h] = whole[:n, :n], whole[:n, n:]
        return self._maps[h]

    @property
    def slip(self) -> list[float]:
        """Return the slip of each pack [rad/s]."""
        return (self.slips @ self.state).tolist()

    def advance(self, outside: Sequence[float], packs: Sequence[float], h: float) -> None:
        """Step with torques held over it."""
        of_state, of_torques = self.map(h)
        self.state = of_state @ self.state + of_torques @ np.array([*outside, *packs])

    def advance_ideal(
        self, outside: Sequence[float], capacity: Sequence[float], h: float
    ) -> list[float]:
        """Step with Coulomb friction that sticks; return the packs' torques."""
        of_state, of_torques = self.map(h)
        free = of_state @ self.state + of_torques[:, : self.outside] @ np.asarray(outside, float)
        slip = self.slips @ free
        give = -self.slips @ of_torques[:, self.outside :]  # slip that a torque takes away
        torque = sticking(slip.tolist(), give.tolist(), capacity)
        self.state = free + of_torques[:, self.outside :] @ np.array(torque)
        return torque


def sticking(
    slip: Sequence[float], give: Sequence[Sequence[float]], capacity: Sequence[float]
) -> list[float]:
    """Return torques within capacity that take the slips away, or oppose what is left of them.

    ``give[i][j]``: slip of pack i that a unit torque of pack j takes away. Projected Gauss-Seidel.
    """
    n = len(slip)
    torque = [0.0] * n
    for _ in range(SWEEPS):
        last = list(torque)
        for i in range(n):
            rest = slip[i] - sum(give[i][j] * torque[j] for j in range(n) if j != i)
            torque[i] = min(max(rest / give[i][i], -capacity[i]), capacity[i])
        if n == 1 or torque == last:
            break
    return torque


def two_shafts(j1: float, j2: float, w1: float, w2: float, packs: int = 1) -> Driveline:
    """Two inertias, packs in parallel between them; outside torques drive 1 and brake 2."""
    torques = [[1 / j1, 0, *[-1 / j1] * packs], [0, -1 / j2, *[1 / j2] * packs]]
    return Driveline(np.zeros((2, 2)), torques, [[1, -1]] * packs, [w1, w2])


def elastic(
    engine: float, hub: float, vehicle: float, stiffness: float, damping: float, state: Array
) -> Driveline:
    """Engine, pack, hub, elastic shaft, vehicle: speeds and the shaft's twist."""
    k, d = stiffness, damping
    matrix = [
        [0, 0, 0, 0],
        [0, -d / hub, d / hub, -k / hub],
        [0, d / vehicle, -d / vehicle, k / vehicle],
        [0, 1, -1, 0],
    ]
    torques = [[1 / engine, 0, -1 / engine], [0, 0, 1 / hub], [0, -1 / vehicle, 0], [0, 0, 0]]
    return Driveline(matrix, torques, [[1, -1, 0, 0]], state)


def gearbox(motor: float, vehicle: float, ratios: Sequence[float], state: Array) -> Driveline:
    """Two-shaft gearbox: a pack closes each gear; outside torques drive motor, brake vehicle."""
    torques = [
        [1 / motor, 0, *[-1 / motor for _ in ratios]],
        [0, -1 / vehicle, *[i / vehicle for i in ratios]],
    ]
    return Driveline(np.zeros((2, 2)), torques, [[1, -i] for i in ratios], state)


def lock_time(inertia: float, slip: float, capacity: float, held: float) -> float:
    """Return when a pack of this capacity stops a slip > 0 under an outside torque [s]."""
    return inertia * slip / (capacity - held)


def ideal_slips(
    plant: Driveline,
    outside: Callable[[float], Sequence[float]],
    capacity: Callable[[float, Sequence[float]], Sequence[float]],
    times: Sequence[float],
    parts: int = 20,
) -> tuple[Array, Array]:
    """Return slips (points, packs) and torques of ideal packs at the times, from a copy."""
    if plant.packs == 1 and not plant.matrix.any():
        return _rigid_ideal(plant, outside, capacity, times)
    plant = plant.copy()
    slips, torques = [plant.slip], []
    for t, end in pairwise(times):
        push, h = outside(t), (end - t) / parts
        strength = capacity(t, plant.slip)
        for _ in range(parts):
            torque = plant.advance_ideal(push, strength, h)
        slips.append(plant.slip)
        torques.append(torque)
    return np.array(slips), np.array(torques)


def _rigid_ideal(
    plant: Driveline,
    outside: Callable[[float], Sequence[float]],
    capacity: Callable[[float, Sequence[float]], Sequence[float]],
    times: Sequence[float],
) -> tuple[Array, Array]:
    """Return the same of one pack between stiff shafts, in closed form."""
    gain = (plant.slips @ plant.torques)[0]
    drive, give = gain[: plant.outside].tolist(), -float(gain[plant.outside])
    slip = plant.slip[0]
    slips, torques = [[slip]], []
    for t, end in pairwise(times):
        push = sum(a * b for a, b in zip(drive, outside(t), strict=True))
        slip, torque = coulomb(slip, push, give, capacity(t, [slip])[0], end - t)
        slips.append([slip])
        torques.append([torque])
    return np.array(slips), np.array(torques)


def coulomb(
    slip: float, push: float, give: float, capacity: float, h: float
) -> tuple[float, float]:
    """Return slip and torque after a step with ideal friction.

    ``push``: acceleration of the slip without friction, ``give``: what a unit torque takes off it.
    """
    if slip:
        torque = math.copysign(capacity, slip)
        rate = push - give * torque
        if slip * rate >= 0 or -slip / rate >= h:
            return slip + rate * h, torque
        h += slip / rate
    if abs(push) <= give * capacity:
        return 0.0, push / give
    torque = math.copysign(capacity, push)
    return (push - give * torque) * h, torque


@lru_cache(maxsize=4096)
def steps_of(step: float, count: int, kind: str, seed: int) -> tuple[float, ...]:
    """Return the times of a run: equal steps, or x0.5, x1, x2 at random."""
    if kind == "equal":
        return tuple(step * k for k in range(count + 1))
    factors = np.random.default_rng(seed).choice([0.5, 1.0, 2.0], count)
    return (0.0, *np.cumsum(step * factors).tolist())
