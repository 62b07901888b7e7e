"""A surface that its own oil heats: hotter oil is thinner and heats less.

T = T_B + dT_0 (mu(T)/mu(T_B))^n: n = 1 if the film keeps its height, 0.3 if it thins with the oil.
The right side falls with T, so there is one root, always between T_B and T_B + dT_0. Substitution
converges only while the slope there is above -1; beyond, it swings between two temperatures.
Viscosity law and numbers: Atan (2005), Eq 13. ``heat_loop`` judges the methods.
"""

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels.flank_temperature import heated_flank

from .failure_cells import LIES, OK, SAYS, SLOW, Cell, Group, table

B, C = 755.0, 70.0  # degC
WRONG_KELVIN = 0.1
MANY_TURNS = 20


@dataclass(frozen=True)
class Loop:
    """Bulk temperature [degC], rise at the bulk's viscosity [K], power of the viscosity."""

    bulk: float
    rise: float
    power: float

    def right(self, t: float) -> float:
        """Return the temperature that oil of ``t`` [degC] makes."""
        thin = math.exp(self.power * B * (1.0 / (t + C) - 1.0 / (self.bulk + C)))
        return self.bulk + self.rise * thin

    def slope(self, t: float) -> float:
        """Return d right/dt [-], negative."""
        return -(self.right(t) - self.bulk) * self.power * B / (t + C) ** 2

    def root(self) -> float:
        """Return the root by bisection, which cannot fail."""
        low, high = self.bulk, self.bulk + self.rise
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.right(middle) > middle else (low, middle)
        return 0.5 * (low + high)


Answer = tuple[float, Status, int]


def substitute_often(loop: Loop, turns: int = 50) -> Answer:
    """Substitute a fixed number of times."""
    t = loop.bulk
    for _ in range(turns):
        t = loop.right(t)
    return t, Status.OK, turns


def substitute(loop: Loop, share: float = 1.0, most: int = 200) -> Answer:
    """Substitute until the temperature stays; ``share`` of each step is taken."""
    t = loop.bulk
    for turn in range(most):
        new = t + share * (loop.right(t) - t)
        if abs(new - t) <= 1e-9:
            return new, Status.OK, turn + 1
        t = new
    return t, Status.MAX_ITERATIONS, most


def newton(loop: Loop, most: int = 50) -> Answer:
    """Take Newton's steps from the temperature without thinning, undamped."""
    t = loop.bulk + loop.rise
    for turn in range(most):
        step = (loop.right(t) - t) / (1.0 - loop.slope(t))
        t += step
        if abs(step) <= 1e-9:
            return t, Status.OK, turn + 1
    return t, Status.MAX_ITERATIONS, most


def heat_loop() -> Group:
    """Judge methods to find the temperature of a flank heated by its own oil."""
    hazards = {
        "little heat": Loop(40.0, 5.0, 1.0),
        "film thins with the oil": Loop(40.0, 100.0, 0.3),
        "film keeps its height": Loop(40.0, 100.0, 1.0),
        "much heat": Loop(40.0, 1000.0, 1.0),
        "cold oil, -40 degC": Loop(-40.0, 100.0, 1.0),
        "no heat": Loop(40.0, 0.0, 1.0),
    }

    def ours(loop: Any) -> tuple[float, Status, int]:
        # a stress of 1 at the bulk's viscosity, so that the factor is the rise
        t, _, _, status, turns = heated_flank(
            loop.bulk + 273.15, loop.rise, 1.0, 1e300, loop.power, B, C
        )
        return t - 273.15, Status(status), turns

    methods = {
        "substituted 50 times": substitute_often,
        "substituted until it stays": substitute,
        "half of each step": partial(substitute, share=0.5),
        "Newton, undamped": newton,
        "Newton in a bracket, the package's": ours,
    }

    def judge(method: Any, loop: Any) -> Cell:
        t, status, turns = method(loop)
        if status.is_failure:
            return Cell(SAYS, "", status.name)
        error = t - loop.root()
        if not abs(error) <= WRONG_KELVIN:
            return Cell(LIES, f"{error:+.0f} K", f"slope there {loop.slope(loop.root()):.2f}")
        words = f"off by {abs(error):.1g} K, slope there {loop.slope(loop.root()):.2f}"
        return Cell(SLOW if turns > MANY_TURNS else OK, f"{turns} turn" + "s" * (turns != 1), words)

    judged = f"off by more than {WRONG_KELVIN:g} K"
    return table("a flank that its oil heats", judged, methods, hazards, judge)
