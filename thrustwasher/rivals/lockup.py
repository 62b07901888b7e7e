"""A clutch that locks, stepped in six ways: the least problem in which co-simulation goes wrong.

Slip w of a reduced inertia J: J dw/dt = T_d - T_f sign(w), sticking while |T_d| <= T_f. Friction
and drive are constant, so that lock-up and slip energy have a closed form. Friction is smoothed
over a slip of w_s where a way needs it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Clutch:
    """The problem; SI units."""

    inertia: float = 0.2
    friction: float = 100.0
    drive: float = 40.0
    slip: float = 150.0  # at the start
    width: float = 0.05  # w_s of smoothed friction
    span: float = 1.0

    @property
    def lock_time(self) -> float:
        """[s]."""
        return self.slip * self.inertia / (self.friction - self.drive)

    @property
    def slip_energy(self) -> float:
        """[J] turned into heat until lock-up."""
        return 0.5 * self.friction * self.slip * self.lock_time

    def smooth(self, w: float) -> float:
        """Return the smoothed friction torque [N m]."""
        return self.friction * math.tanh(w / self.width)


@dataclass(frozen=True)
class Course:
    """Slip over time and the heat at the end."""

    slip: np.ndarray[tuple[int], np.dtype[np.float64]]
    energy: float

    def chatter(self, clutch: Clutch) -> int:
        """Return how often the slip turns round after lock-up."""
        n = len(self.slip)
        first = min(n - 1, math.ceil(clutch.lock_time / clutch.span * (n - 1)))
        after = self.slip[first:]
        moving = np.sign(after[np.abs(after) > 0.2 * clutch.width])
        return int(np.count_nonzero(np.diff(moving)))


def _walk(
    clutch: Clutch, step: float, advance: Callable[[float, float], tuple[float, float]]
) -> Course:
    """Step with ``advance(w, h)``, which returns the new slip and the heat made."""
    n = round(clutch.span / step)
    slip, energy = [clutch.slip], 0.0
    for _ in range(n):
        w, heat = advance(slip[-1], step)
        slip.append(w)
        energy += heat
    return Course(np.array(slip), energy)


def runge_kutta(clutch: Clutch, step: float) -> Course:
    """Classical Runge-Kutta steps of fixed length on smoothed friction."""

    def rate(w: float) -> float:
        return (clutch.drive - clutch.smooth(w)) / clutch.inertia

    def advance(w: float, h: float) -> tuple[float, float]:
        a = rate(w)
        b = rate(w + 0.5 * h * a)
        c = rate(w + 0.5 * h * b)
        d = rate(w + h * c)
        new = w + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        middle = 0.5 * (w + new)
        power = (
            clutch.smooth(w) * w + 4.0 * clutch.smooth(middle) * middle + clutch.smooth(new) * new
        )
        return new, h / 6.0 * power

    return _walk(clutch, step, advance)


def adaptive(clutch: Clutch, step: float) -> Course:
    """LSODA on smoothed friction, tolerance 1e-8; ``step`` is what it is looked at with."""
    from scipy.integrate import solve_ivp

    def rate(_: float, y: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
        torque = clutch.smooth(y[0])
        return [(clutch.drive - torque) / clutch.inertia, torque * y[0]]

    times = np.linspace(0.0, clutch.span, round(clutch.span / step) + 1)
    found = solve_ivp(
        rate, (0.0, clutch.span), [clutch.slip, 0.0], method="LSODA", t_eval=times, rtol=1e-8,
        atol=1e-8,
    )  # fmt: skip
    return Course(found.y[0], float(found.y[1, -1]))


def located(clutch: Clutch, step: float) -> Course:
    """Stick and slip as modes, lock-up located inside the step, as the package's driveline does."""
    stuck = abs(clutch.drive) <= clutch.friction

    def advance(w: float, h: float) -> tuple[float, float]:
        if w == 0.0 and stuck:
            return 0.0, 0.0
        torque = math.copysign(clutch.friction, w)
        rate = (clutch.drive - torque) / clutch.inertia
        new = w + h * rate
        if new * w <= 0.0 and stuck:
            until = -w / rate
            return 0.0, 0.5 * torque * w * until
        return new, h * torque * 0.5 * (w + new)

    return _walk(clutch, step, advance)


def gauss_seidel(clutch: Clutch, step: float) -> Course:
    """Friction torque handed over, fresh in each step, held while the driveline steps."""

    def advance(w: float, h: float) -> tuple[float, float]:
        torque = clutch.smooth(w)
        new = w + h * (clutch.drive - torque) / clutch.inertia
        return new, h * torque * 0.5 * (w + new)

    return _walk(clutch, step, advance)


def jacobi(clutch: Clutch, step: float) -> Course:
    """Friction torque handed over, one step old."""
    old = clutch.smooth(clutch.slip)

    def advance(w: float, h: float) -> tuple[float, float]:
        nonlocal old
        torque, old = old, clutch.smooth(w)
        new = w + h * (clutch.drive - torque) / clutch.inertia
        return new, h * torque * 0.5 * (w + new)

    return _walk(clutch, step, advance)


def linearly_implicit(clutch: Clutch, step: float) -> Course:
    """Friction torque with its slope over the slip, both handed over."""

    def advance(w: float, h: float) -> tuple[float, float]:
        torque = clutch.smooth(w)
        slope = clutch.friction / clutch.width * (1.0 - (torque / clutch.friction) ** 2)
        change = h * (clutch.drive - torque) / (clutch.inertia + h * slope)
        return w + change, h * (torque + 0.5 * slope * change) * (w + 0.5 * change)

    return _walk(clutch, step, advance)
