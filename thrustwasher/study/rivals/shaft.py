"""An undamped shaft that swings for many steps, and who keeps its energy.

J x'' = -k x. Each method returns the energy at the end over that at the start, which ought to be 1.
The shaft's torque k x is what two parts of a co-simulation hand to each other.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Shaft:
    """Steps of ``turn`` rad of the swing's circle each (omega h), ``steps`` of them."""

    turn: float
    steps: int


Advance = Callable[[float, float, float, float], tuple[float, float, float]]
OVERFLOW = 1e150
TOLERANCE = 1e-4  # of step doubling


def _walk(shaft: Shaft, advance: Advance) -> float:
    """Step in the swing's own units (k = J = 1); ``advance(x, v, kept, h)``."""
    x, v, kept = 1.0, 0.0, 1.0
    for _ in range(shaft.steps):
        x, v, kept = advance(x, v, kept, shaft.turn)
        if abs(x) > OVERFLOW:
            return math.inf
    return x * x + v * v


def runge_kutta(shaft: Shaft) -> float:
    """Classical Runge-Kutta steps of fixed length."""
    h = shaft.turn
    c, s = 1.0 - h * h / 2.0 + h**4 / 24.0, h - h**3 / 6.0
    return _walk(shaft, lambda x, v, kept, h: (c * x + s * v, c * v - s * x, kept))


def lsoda(shaft: Shaft) -> float:
    """One equation for all, error controlled."""
    from scipy.integrate import odeint

    end = shaft.turn * shaft.steps
    found = odeint(
        lambda y, t: (y[1], -y[0]), (1.0, 0.0), (0.0, end), rtol=1e-10, atol=1e-10,
        mxstep=10_000_000,
    )  # fmt: skip
    return float(np.sum(found[-1] ** 2))


def _push(x: float, v: float, torque: float, h: float) -> tuple[float, float]:
    """Step exactly under a torque that is held."""
    return x + h * v - 0.5 * h * h * torque, v - h * torque


def gauss_seidel(shaft: Shaft) -> float:
    """Torque fresh in each step, held over it."""
    return _walk(shaft, lambda x, v, kept, h: (*_push(x, v, x, h), kept))


def jacobi(shaft: Shaft) -> float:
    """Torque one step old."""
    return _walk(shaft, lambda x, v, kept, h: (*_push(x, v, kept, h), x))


def linearly_implicit(shaft: Shaft) -> float:
    """Torque with its slope, taken at the step's end."""

    def advance(x: float, v: float, kept: float, h: float) -> tuple[float, float, float]:
        new = (v - h * x) / (1.0 + h * h)
        return x + h * new, new, kept

    return _walk(shaft, advance)


def step_doubling(shaft: Shaft) -> float:
    """Held torque, a step against two half ones; halved until they agree."""
    return _walk(shaft, _doubled)


def _doubled(x: float, v: float, kept: float, h: float) -> tuple[float, float, float]:
    """Take one macro step in as many equal parts as the tolerance asks for; keep their number."""
    parts = int(kept)
    while True:
        size, a, b, worst = h / parts, x, v, 0.0
        limit = TOLERANCE * max(abs(x), abs(v))
        for _ in range(parts):
            once = _push(a, b, a, size)
            half = _push(a, b, a, 0.5 * size)
            a, b = _push(*half, half[0], 0.5 * size)
            worst = max(worst, abs(b - once[1]))
        if worst <= limit or parts > 1000:
            return a, b, max(1, parts // 2) if worst < 0.2 * limit else parts
        parts *= 2
