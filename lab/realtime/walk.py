"""Inputs, step sizes and restarts at random: a walk over a box with jumps to anywhere and corners.

What a step takes depends on what came before: inputs creep, jump, stay, cross zero and stand at the
ends of their ranges; step sizes go from 0.1 to 10 ms; now and then the instance begins anew.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from thrustwasher.model.spec import ModelSpec

Floats = NDArray[np.float64]
CREEP = 0.02  # of the range, by which an input creeps in a step
JUMPS, STAYS, ENDS = 0.02, 0.3, 0.01  # shares of steps: to anywhere, as before, to an end or zero
SHORTEST, LONGEST = 1e-4, 1e-2  # s
NEW_SIZE = 0.01  # share of steps from which on another size holds
LIFE = 2000  # steps from one restart to the next, in the mean


class Piece(NamedTuple):
    """Some steps of a walk: inputs (n, inputs), step sizes [s] (n,), 1 at restarts (n,)."""

    inputs: Floats
    sizes: Floats
    restarts: NDArray[np.int64]


@cache
def ranges() -> Mapping[str, Mapping[str, tuple[float, float, str]]]:
    """Return model -> input -> (low, high, law)."""
    found: Mapping[str, Mapping[str, tuple[float, float, str]]]
    found = tomllib.loads(Path(__file__).with_name("walks.toml").read_text("utf-8"))
    return found


class Walk:
    """An endless walk of a model's inputs; one seed, one path."""

    def __init__(self, spec: ModelSpec, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        known = ranges().get(spec.key, {})
        self._laws = [
            known.get(s.name, (s.start or 0.0, s.start or 0.0, "stay")) for s in spec.inputs
        ]
        self._place = self._random.random(len(self._laws))
        self._size = 1e-3

    def piece(self, n: int) -> Piece:
        """Return the next ``n`` steps; the first one is a restart."""
        random, many = self._random, (n, len(self._laws))
        move = random.normal(0.0, CREEP, many)
        move[random.random(many) < STAYS] = 0.0
        move[random.random(n) < STAYS] = 0.0
        jumps = random.random(many) < JUMPS
        move[jumps] = random.uniform(-1.0, 1.0, int(jumps.sum()))
        unfolded = self._place + np.cumsum(move, axis=0)
        places = np.abs((unfolded + 1.0) % 2.0 - 1.0)  # reflected at both ends
        self._place = places[-1].copy()
        ends = random.random(many) < ENDS
        places[ends] = random.choice([0.0, 0.5, 1.0], int(ends.sum()))
        columns = [value_at(places[:, k], *law) for k, law in enumerate(self._laws)]
        inputs = np.stack(columns, axis=1) if columns else np.zeros((n, 0))
        restarts = (random.random(n) < 1.0 / LIFE).astype(np.int64)
        restarts[0] = 1
        return Piece(np.ascontiguousarray(inputs), self._sizes(n), restarts)

    def _sizes(self, n: int) -> Floats:
        random = self._random
        drawn = SHORTEST * (LONGEST / SHORTEST) ** random.random(n)
        new = random.random(n) < NEW_SIZE
        latest = np.maximum.accumulate(np.where(new, np.arange(n), -1))
        sizes = np.where(latest >= 0, drawn[latest], self._size)
        self._size = float(sizes[-1])
        return np.ascontiguousarray(sizes)


def value_at(place: Floats, low: float, high: float, law: str) -> Floats:
    """Return the values at places from 0 to 1 of a range."""
    if law == "stay":
        return np.full(place.shape, low)
    if law == "linear":
        return low + (high - low) * place
    if law == "log":
        return np.asarray(low * (high / low) ** place)
    side = 2.0 * place - 1.0
    values = np.copysign(low * (high / low) ** np.abs(side), side)
    return np.where(side == 0.0, 0.0 if law == "signed" else low, values)
