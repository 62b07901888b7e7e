"""The least loops of two parts that only meet at communication points, stepped as masters do.

Each part is exact on its own: what a loop does wrong comes from holding a signal over a step. A
stepper takes all that the loop knows and returns what it knows a step later.
"""

from __future__ import annotations

import math
from collections.abc import Callable

State = tuple[float, ...]
Stepper = Callable[[State], State]
MANY = 3000  # steps that tell if a deviation grows
HUGE, TINY = 1e6, 1e-6


def torque_held(kappa: float) -> Stepper:
    """Return slip under a torque c w that is fresh in each step; ``kappa`` = H c/J."""
    return lambda s: ((1.0 - kappa) * s[0],)


def torque_late(kappa: float) -> Stepper:
    """Return slip under a torque that is one step old."""
    return lambda s: (s[0] - kappa * s[1], s[0])


def torque_drawn_on(kappa: float) -> Stepper:
    """Return slip under a torque that goes on as it did in the last step."""
    return lambda s: (s[0] - kappa * (1.5 * s[0] - 0.5 * s[1]), s[0])


def torque_implicit(kappa: float) -> Stepper:
    """Return slip under a torque handed over with its slope, taken at the step's end."""
    return lambda s: (s[0] - kappa * s[0] / (1.0 + kappa),)


def tanh_held(kappa: float, width: float = 1e-3) -> Stepper:
    """Return slip under T tanh(w/w_0), held; ``kappa`` = H T/(J w_0), ``width`` w_0."""
    return lambda s: (s[0] - kappa * width * math.tanh(s[0] / width),)


def spring_held(k: float, c: float, h: float) -> Stepper:
    """Return a mass of 1 under the force k x + c v of another part, fresh in each step."""

    def step(s: State) -> State:
        force = k * s[0] + c * s[1]
        return s[0] + h * s[1] - 0.5 * h * h * force, s[1] - h * force

    return step


def spring_late(k: float, c: float, h: float) -> Stepper:
    """Return the same with the force of a step ago."""

    def step(s: State) -> State:
        force = k * s[0] + c * s[1]
        return s[0] + h * s[1] - 0.5 * h * h * s[2], s[1] - h * s[2], force

    return step


def power_held(slope: float, conductance: float, step: float) -> Stepper:
    """Return a body of capacity 1 that is cooled, and heated by ``slope`` times its rise."""
    kept = math.exp(-conductance * step)
    return lambda s: (kept * s[0] + (1.0 - kept) * slope * s[0] / conductance,)


def dies_out(step: Stepper, start: State, steps: int = MANY) -> bool:
    """Tell if a deviation is less in the second half of a run than in the first."""
    now, sizes = start, [0.0, 0.0]
    for i in range(2 * steps):
        now = step(now)
        size = max(map(abs, now))
        sizes[i >= steps] = max(sizes[i >= steps], size)
        if not size < HUGE:
            return False
    return sizes[1] < sizes[0] or sizes[1] < TINY


def keeps_its_side(step: Stepper, start: State) -> bool:
    """Tell if the first number of a state that dies out never changes sign."""
    now = start
    for _ in range(200):
        now = step(now)
        if now[0] < -1e-12 * abs(start[0]):
            return False
    return True


def factor(step: Stepper, start: State, steps: int = 200) -> float:
    """Return the mean growth of the size per step, the first half of the steps left out."""
    now, sizes = start, []
    for _ in range(steps):
        now = step(now)
        sizes.append(math.hypot(*now))
    half = steps // 2
    grown = sizes[-1] / sizes[half - 1]
    return math.exp(math.log(grown) / (steps - half))


def coulomb_reach(friction: float, drive: float, h: float) -> tuple[float, float]:
    """Return the lowest and the highest slip of a unit inertia under held Coulomb friction."""
    low, high = 0.0, 0.0
    for start in range(500):
        w = h * start / 500.0 * (friction + drive)
        for i in range(200):
            w += h * (drive - math.copysign(friction, w))
            if i >= 20:
                low, high = min(low, w), max(high, w)
    return low, high


def edge(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return by bisection where ``holds`` ends between two values."""
    for _ in range(40):
        middle = 0.5 * (inside + outside)
        if holds(middle):
            inside = middle
        else:
            outside = middle
    return 0.5 * (inside + outside)
