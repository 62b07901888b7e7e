"""An undamped shaft that swings for many steps, and who keeps its energy.

J x'' = -k x. Each method returns the energy at the end over that at the start, which ought to be 1.
The shaft's torque k x is what two parts of a co-simulation hand to each other.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np


@dataclass(frozen=True)
class Shaft:
    """Steps of ``turn`` rad of the swing's circle each (omega h), ``steps`` of them."""

    turn: float
    steps: int


Advance = Callable[[float, float, float, float], tuple[float, float, float]]
OVERFLOW = 1e150
TOLERANCE = 1e-4  # of step doubling


def _walk(advance: Advance, shaft: Shaft) -> float:
    """Step in the swing's own units (k = J = 1); ``advance(x, v, kept, h)``."""
    x, v, kept = 1.0, 0.0, 1.0
    for _ in range(shaft.steps):
        x, v, kept = advance(x, v, kept, shaft.turn)
        if abs(x) > OVERFLOW:
            return math.inf
    return x * x + v * v


def _stages(x: float, v: float, kept: float, h: float) -> tuple[float, float, float]:
    """Take a classical Runge-Kutta step."""
    c, s = 1.0 - h * h / 2.0 + h**4 / 24.0, h - h**3 / 6.0
    return c * x + s * v, c * v - s * x, kept


def lsoda(shaft: Shaft) -> float:
    """One equation for all, error controlled."""
    from scipy.integrate import odeint

    end = shaft.turn * shaft.steps
    found = odeint(
        lambda y, t: (y[1], -y[0]),
        (1.0, 0.0),
        (0.0, end),
        rtol=1e-10,
        atol=1e-10,
        mxstep=10_000_000,
    )
    return float(np.sum(found[-1] ** 2))


def _push(x: float, v: float, torque: float, h: float) -> tuple[float, float]:
    """Step exactly under a torque that is held."""
    return x + h * v - 0.5 * h * h * torque, v - h * torque


def _implicit(x: float, v: float, kept: float, h: float) -> tuple[float, float, float]:
    """Step under a torque with its slope, taken at the step's end."""
    new = (v - h * x) / (1.0 + h * h)
    return x + h * new, new, kept


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


runge_kutta, linearly_implicit = partial(_walk, _stages), partial(_walk, _implicit)
# torque fresh in each step and held over it; one step old; held, steps halved until they agree
gauss_seidel = partial(_walk, lambda x, v, kept, h: (*_push(x, v, x, h), kept))
jacobi = partial(_walk, lambda x, v, kept, h: (*_push(x, v, kept, h), x))
step_doubling = partial(_walk, _doubled)
