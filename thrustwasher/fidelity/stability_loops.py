"""Where ways to find a temperature that acts back on itself fail, and formulas at their ends."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from .stability_cells import LIES, OK, SAYS, SLOW, Cell, Group, off, table

WRONG_KELVIN = 0.1
MANY_TURNS = 20
WRONG_DIGITS = 1e-6
RADIUS, WIDTH, GAP = 0.02, 2.0**-30, 1e-5  # m, of a narrow ring
RIM = RADIUS + 0.5 * WIDTH


def heat_loop() -> Group:
    """Judge ways to find the temperature of a flank heated by its own oil."""
    from ..errors import Status
    from ..kernels.gear_heat import surface_temperature
    from ..rivals import heat_loop as h

    hazards = {
        "little heat": h.Loop(40.0, 5.0, 1.0),
        "film thins with the oil": h.Loop(40.0, 100.0, 0.3),
        "film keeps its height": h.Loop(40.0, 100.0, 1.0),
        "much heat": h.Loop(40.0, 1000.0, 1.0),
        "cold oil, -40 degC": h.Loop(-40.0, 100.0, 1.0),
        "no heat": h.Loop(40.0, 0.0, 1.0),
    }

    def ours(loop: Any) -> tuple[float, Status, int]:
        # a stress of 1 at the bulk's viscosity, so that the factor is the rise
        t, _, status, turns = surface_temperature(
            loop.bulk + 273.15, loop.rise, 1.0, 1e300, loop.power, h.B, h.C
        )
        return t - 273.15, Status(status), turns

    methods = {
        "substituted 50 times": h.substitute_often,
        "substituted until it stays": h.substitute,
        "half of each step": h.relaxed,
        "Newton, undamped": h.newton,
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


def closed_forms() -> Group:
    """Judge closed forms at the ends of their ranges, as printed and as the package has them."""
    from ..kernels.lumped_body import exponential_weights
    from ..kernels.washer_wedge import lift
    from ..reference.thin_film import narrow_ring_load

    def printed(tilt: float) -> float:
        largest = GAP + tilt * (RIM + RADIUS - 0.5 * WIDTH)
        least = GAP + 0.5 * tilt * WIDTH
        return narrow_ring_load(1.0, 1.0, RADIUS - 0.5 * WIDTH, RIM, least, largest)

    def ours(tilt: float) -> float:
        # a roughness so small that it does not count
        return lift(GAP, 0.0, tilt, 0.0, 1.0, 0.0, RADIUS - 0.5 * WIDTH, RIM, 1e-12)[0]

    def weight(z: float) -> float:
        return (1.0 - (1.0 - math.exp(-z)) / z) / z

    Form = tuple[Callable[[float], float], Callable[[float], float], dict[str, float]]
    tilts = {"usual": 1e-4, "far": 1e-12, "end": 1e-17, "zero": 0.0}
    times = {"usual": 1.0, "far": 1e-6, "end": 1e-9, "zero": 0.0}
    forms: dict[str, Form] = {
        "load of a narrow ring, 1/h_1^2 - 1/h_2^2": (printed, _ring, tilts),
        "the same, as the package has it": (ours, _ring, tilts),
        "mean of a heated body, (1 - (1 - exp(-z))/z)/z": (weight, _weight, times),
        "the same, the package's": (lambda z: exponential_weights(z)[2], _weight, times),
    }
    hazards = {
        "middle of its range": "usual", "differences of near numbers": "far",
        "the end of its range": "end", "zero itself": "zero",
    }  # fmt: skip

    def judge(form: Form, place: str) -> Cell:
        formula, true, places = form
        x = places[place]
        found, exact = formula(x), true(x)
        error = found / exact - 1.0 if exact else found
        if not abs(error) <= WRONG_DIGITS:
            return Cell(LIES, off(error), f"at {x:g}")
        return Cell(OK, f"{abs(error):.0e}" if error else "", f"at {x:g}")

    judged = f"off by more than {WRONG_DIGITS:g}, relative"
    return table("closed forms at the ends of their ranges", judged, forms, hazards, judge)


def _ring(tilt: float) -> float:
    """Return the load of a tilted narrow ring, in fractions."""
    radius, width, rim, gap, g = (Fraction(x) for x in (RADIUS, WIDTH, RIM, GAP, tilt))
    least = gap + g * width / 2
    largest = gap + g * (rim + radius - width / 2)
    return float(radius * width**3 / 4 * (1 / least**2 - 1 / largest**2))


def _weight(z: float) -> float:
    """Return the sum of (-z)^k/(k + 2)!, of which nothing is lost for z up to some ten."""
    total, term = 0.0, 0.5
    for k in range(60):
        total += term
        term *= -z / (k + 3.0)
    return total
