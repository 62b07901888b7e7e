"""Five methods to solve a cavitating film, on a pad small enough to try them all.

div(h^3 grad p) = dh/dx for sliding along x, p = 0 on the rim, p >= 0 where the film is full: a
linear complementarity problem. ``active_set`` meets it exactly: what the others are evaluated by.

================  ================================================================================
``cut``           solve without cavitation, set negative pressures to zero (half-Sommerfeld)
``clamp``         cut them inside back substitution, before they are used again
``relax_change``  projected over-relaxation until the change of a sweep is small
``relax_rest``    the same until the residual is small
``active_set``    guess where it cavitates, solve, correct the guess
================  ================================================================================
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from thrustwasher.errors import Status

from .compiled import rival

Array = NDArray[np.float64]
RELAXATION = 1.7
MOST_SWEEPS = 20000
MOST_SOLVES = 200
CHANGE, REST = 1e-4, 1e-6
# Heights of films over (x, y); the first closes all the way, the second has no wedge.
SHAPES: dict[str, Callable[[Any, Any], Any]] = {
    "slider": lambda x, y: 2.0 - x + 0.0 * y,
    "level": lambda x, y: 1.0 + 0.0 * x * y,
    "one wave": lambda x, y: 1.0 + 0.6 * np.cos(2.0 * math.pi * x) + 0.0 * y,
    "two waves": lambda x, y: 1.0 + 0.6 * np.cos(4.0 * math.pi * x) + 0.0 * y,
    "waves and tilt": lambda x, y: 1.0 + 0.5 * np.cos(6.0 * math.pi * x) + 0.4 * y,
    "dimple": lambda x, y: 1.0 + 0.8 * np.exp(-((x - 0.4) ** 2 + (y - 0.5) ** 2) / 0.02),
}


@dataclass(frozen=True)
class Pad:
    """The equations of a film on a square of ``n`` x ``n`` inner nodes."""

    east: Array  # (n + 1, n) conductance between x-neighbours, rim included
    north: Array  # (n, n + 1) between y-neighbours
    source: Array  # (n, n)

    @property
    def diagonal(self) -> Array:
        """(n, n) sum of a node's conductances."""
        found: Array = self.east[1:] + self.east[:-1] + self.north[:, 1:] + self.north[:, :-1]
        return found


@dataclass(frozen=True)
class Film:
    """Pressures as a method left them, what it says, and how much it did."""

    pressure: Array
    status: Status
    work: int  # sweeps, or solves

    @property
    def load(self) -> float:
        """Sum of the pressures."""
        return float(self.pressure.sum())


def pad(shape: str, n: int = 31, direction: float = 1.0) -> Pad:
    """Return the equations of a film of a shape on the unit square, sliding along +-x."""
    d, height = 1.0 / (n + 1), SHAPES[shape]
    inner = d * np.arange(1, n + 1)
    faces = d * (np.arange(n + 1) + 0.5)
    at_east = np.asarray(height(faces[:, None], inner[None, :]), np.float64)
    at_north = np.asarray(height(inner[:, None], faces[None, :]), np.float64)
    source = -direction * d * (at_east[1:] - at_east[:-1])
    return Pad(at_east**3, at_north**3, source)


def _band(p: Pad) -> Array:
    """Return the lower band of the matrix, columns first: row k, entry b is A[k, k - b]."""
    n = len(p.source)
    band = np.zeros((n * n, n + 1))
    band[:, 0] = p.diagonal.ravel()
    west, south = band[:, n].reshape(n, n), band[:, 1].reshape(n, n)
    west[1:], south[:, 1:] = -p.east[1:-1], -p.north[:, 1:-1]
    return band


@rival
def _factor(band: Array) -> None:
    """Cholesky's factor of a lower band, in place."""
    size, width = band.shape
    for k in range(size):
        for b in range(min(k, width - 1), -1, -1):
            total = band[k, b]
            for c in range(b + 1, min(k, width - 1) + 1):
                if c - b < width:
                    total -= band[k, c] * band[k - b, c - b]
            band[k, b] = math.sqrt(total) if b == 0 else total / band[k - b, 0]


@rival
def _substitute(band: Array, x: Array, clamped: bool) -> None:
    """Solve with the factor, in place; ``clamped``: nothing negative is handed on backwards."""
    size, width = band.shape
    for k in range(size):
        for b in range(1, min(k, width - 1) + 1):
            x[k] -= band[k, b] * x[k - b]
        x[k] /= band[k, 0]
    for k in range(size - 1, -1, -1):
        for b in range(1, min(size - 1 - k, width - 1) + 1):
            x[k] -= band[k + b, b] * x[k + b]
        x[k] /= band[k, 0]
        if clamped and x[k] < 0.0:
            x[k] = 0.0


def _direct(p: Pad, clamped: bool) -> Film:
    band, x = _band(p), p.source.ravel().copy()
    _factor(band)
    _substitute(band, x, clamped)
    return Film(np.maximum(x, 0.0).reshape(p.source.shape), Status.OK, 1)


def cut(p: Pad) -> Film:
    """Solve, then set negative pressures to zero."""
    return _direct(p, False)


def clamp(p: Pad) -> Film:
    """Set negative pressures to zero while they are found, from the far end of x on."""
    return _direct(p, True)


@rival
def _relax(
    east: Array,
    north: Array,
    source: Array,
    p: Array,
    relaxation: float,
    change: float,
    rest: float,
    most: int,
) -> int:
    """Projected over-relaxation; stop at a small change of a sweep or a small residual."""
    n = source.shape[0]
    for sweep in range(most):
        moved, total, worst, most_source = 0.0, 0.0, 0.0, 0.0
        for i in range(n):
            for j in range(n):
                a, b, c, d = east[i + 1, j], east[i, j], north[i, j + 1], north[i, j]
                value = source[i, j]
                if i + 1 < n:
                    value += a * p[i + 1, j]
                if i > 0:
                    value += b * p[i - 1, j]
                if j + 1 < n:
                    value += c * p[i, j + 1]
                if j > 0:
                    value += d * p[i, j - 1]
                left = value - (a + b + c + d) * p[i, j]
                if p[i, j] > 0.0 or left > 0.0:
                    worst = max(worst, abs(left))
                most_source = max(most_source, abs(source[i, j]))
                new = max(p[i, j] + relaxation * left / (a + b + c + d), 0.0)
                moved += abs(new - p[i, j])
                total += new
                p[i, j] = new
        if change > 0.0 and moved <= change * total:
            return sweep + 1
        if rest > 0.0 and worst <= rest * most_source:
            return sweep + 1
    return most


def _relaxed(p: Pad, relaxation: float, change: float, rest: float) -> Film:
    found = np.zeros_like(p.source)
    sweeps = _relax(p.east, p.north, p.source, found, relaxation, change, rest, MOST_SWEEPS)
    status = Status.OK if sweeps < MOST_SWEEPS else Status.MAX_ITERATIONS
    return Film(found, status, int(sweeps))


def relax_change(p: Pad, relaxation: float = 1.0) -> Film:
    """Relax until a sweep changes the sum of pressures by less than 1e-4."""
    return _relaxed(p, relaxation, CHANGE, 0.0)


def relax_rest(p: Pad, relaxation: float = RELAXATION) -> Film:
    """Over-relax until the residual is below 1e-6 of the largest source."""
    return _relaxed(p, relaxation, 0.0, REST)


def active_set(p: Pad, start: NDArray[np.bool_] | None = None) -> Film:
    """Solve on a guessed full film, correct the guess, until it stays."""
    n = len(p.source)
    dry = np.zeros(n * n, bool) if start is None else start.ravel().copy()
    diagonal, band = p.diagonal.ravel(), _band(p)
    for turn in range(MOST_SOLVES):
        held, x = band.copy(), p.source.ravel().copy()
        held[dry, 1:] = 0.0
        for b in (1, n):
            held[b:, b][dry[:-b]] = 0.0
        held[dry, 0], x[dry] = 1.0, 0.0
        _factor(held)
        _substitute(held, x, False)
        rest = _rest(p, x.reshape(n, n)).ravel()
        now = x + rest / diagonal <= 0.0
        if (now == dry).all():
            return Film(x.reshape(n, n), Status.OK, turn + 1)
        dry = now
    return Film(np.maximum(x, 0.0).reshape(n, n), Status.MAX_ITERATIONS, MOST_SOLVES)


def _rest(p: Pad, x: Array) -> Array:
    """Return source less matrix times pressures."""
    rest = p.source - p.diagonal * x
    rest[:-1] += p.east[1:-1] * x[1:]
    rest[1:] += p.east[1:-1] * x[:-1]
    rest[:, :-1] += p.north[:, 1:-1] * x[:, 1:]
    rest[:, 1:] += p.north[:, 1:-1] * x[:, :-1]
    return rest


def nested(p_of: Callable[[int], Pad], n: int) -> Film:
    """Solve by active sets on ever finer pads, each guessed from the one before."""
    film, work = active_set(p_of(n // 4)), 0
    for m in (n // 2, n):
        where = np.minimum((np.arange(m) * len(film.pressure)) // m, len(film.pressure) - 1)
        guess = film.pressure[np.ix_(where, where)] <= 0.0
        film = active_set(p_of(m), guess)
        work = film.work
    return Film(film.pressure, film.status, work)
