"""Steps and slopes at which a loop of two parts stops being stable: formulas, measured.

J is the inertia that the slip sees, c = d(torque)/d(slip), H the step, kappa = H c/J. In the loops
of ``rivals.loops`` each part is exact on its own, as the formulas take it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

ONE, TWO, THREE = (1.0,), (1.0, 1.0), (1.0, 0.0, 0.0)
STEP, SPRING, MASS = 1e-3, 1e4, 1.0  # s, N/m, kg
CONDUCTANCE, CAPACITY, HEAT_STEP = 20.0, 1.0, 0.05  # W/K, J/K, s
FRICTION, DRIVE = 100.0, 40.0  # N m on 1 kg m2
Make = Callable[[float], Any]


@dataclass(frozen=True)
class Limit:
    """One formula and what a run of its loop gives."""

    loop: str
    formula: str
    predicted: float
    measured: float

    @property
    def deviation(self) -> float:
        """Measured over predicted, less 1."""
        return self.measured / self.predicted - 1.0


def limits() -> list[Limit]:
    """Return all limits, each by bisection or by the growth over a run."""
    return [*_steps(), *_factors(), *_springs(), *_rest()]


def _steps() -> list[Limit]:
    """Bisect kappa."""
    from ..rivals import loops as s

    def stable(make: Make, start: tuple[float, ...], top: float) -> float:
        return s.edge(lambda k: s.dies_out(make(k), start), 1e-3, top)

    def smooth(make: Make, start: tuple[float, ...], top: float) -> float:
        return s.edge(lambda k: s.keeps_its_side(make(k), start), 1e-3, top)

    return [
        Limit("torque fresh, held (Gauss-Seidel)", "H < 2 J/c: stable", 2.0,
              stable(s.torque_held, ONE, 5.0)),
        Limit("torque fresh, held (Gauss-Seidel)", "H < J/c: no overshoot", 1.0,
              smooth(s.torque_held, ONE, 5.0)),
        Limit("torque a step old (Jacobi)", "H < J/c: stable", 1.0,
              stable(s.torque_late, TWO, 5.0)),
        Limit("torque a step old (Jacobi)", "H < J/(4 c): no overshoot", 0.25,
              smooth(s.torque_late, TWO, 5.0)),
        Limit("torque extrapolated", "H < J/c: stable", 1.0,
              stable(s.torque_drawn_on, TWO, 5.0)),
        Limit("T tanh(w/w_0), held", "H < 2 J w_0/T: stable", 2.0,
              stable(s.tanh_held, (1e-6,), 5.0)),
    ]  # fmt: skip


def _factors() -> list[Limit]:
    """Read growth per step."""
    from ..rivals import loops as s

    undamped = s.spring_held(SPRING, 0.0, STEP)
    return [
        Limit("torque with its slope, kappa 10", "factor 1/(1 + kappa) a step: always stable",
              1.0 / 11.0, s.factor(s.torque_implicit(10.0), ONE, 40)),
        Limit("falling friction, kappa -0.1", "grows by 1 + H abs(c)/J a step: physics",
              1.1, s.factor(s.torque_held(-0.1), ONE)),
        Limit("undamped spring, force held", "grows by sqrt(1 + k H^2/(2 m)) a step: never",
              math.sqrt(1.0 + SPRING * STEP**2 / (2.0 * MASS)),
              s.factor(undamped, (1.0, 0.0), 5000)),
    ]  # fmt: skip


def _springs() -> list[Limit]:
    """Bisect the damping that a spring needs and bears."""
    from ..rivals import loops as s

    start = (1.0, 0.0)

    def held(c: float) -> bool:
        return s.dies_out(s.spring_held(SPRING, c, STEP), start)

    def late(c: float, h: float = 1e-4) -> bool:
        return s.dies_out(s.spring_late(SPRING, c, h), THREE, 15_000)

    return [
        Limit("spring and damper, force held", "c > k H/2: stable", 0.5 * SPRING * STEP,
              s.edge(held, 50.0, 0.0)),
        Limit("spring and damper, force held", "c < 2 m/H: stable", 2.0 * MASS / STEP,
              s.edge(held, 50.0, 1e4)),
        Limit("spring and damper, force a step old", "c > 1.5 k H for small H: stable",
              1.5 * SPRING * 1e-4, s.edge(late, 50.0, 0.0)),
    ]  # fmt: skip


def _rest() -> list[Limit]:
    """Heat, and the reach of chatter."""
    from ..rivals import loops as s

    def settles(slope: float) -> bool:
        return s.dies_out(s.power_held(slope, CONDUCTANCE, HEAT_STEP), ONE)

    least = -CONDUCTANCE / math.tanh(0.5 * CONDUCTANCE * HEAT_STEP / CAPACITY)
    low, high = s.coulomb_reach(FRICTION, DRIVE, STEP)
    return [
        Limit("power held, G and C exact", "dq/dT < G: stable", CONDUCTANCE,
              s.edge(settles, 0.0, 100.0)),
        Limit("power held, G and C exact", "dq/dT > -G coth(G H/(2 C)): stable", least,
              s.edge(settles, 0.0, -200.0)),
        Limit("Coulomb friction, held", "slip up to (T + T_x) H/J: bounded chatter",
              (FRICTION + DRIVE) * STEP, high),
        Limit("Coulomb friction, held", "slip down to -(T - T_x) H/J: bounded chatter",
              -(FRICTION - DRIVE) * STEP, low),
    ]  # fmt: skip


def as_rows(found: list[Limit]) -> list[dict[str, Any]]:
    """Return limits as JSON types."""
    return [{**asdict(one), "deviation": one.deviation} for one in found]
