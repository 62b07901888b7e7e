"""The oil of a scene: one table, turned into the parameters of every part that knows an oil.

A viscosity is measured at two or three temperatures; the models have laws of three constants. Three
points give these exactly. To two a third is added on the line of ASTM D341 through both,
log log(nu + 0.7 mm2/s) over log T, half their distance below the colder one.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import fields
from itertools import pairwise
from typing import Any

from ...errors import ParameterError
from ...model.spec import ModelSpec

Points = Sequence[tuple[float, float]]  # temperature [K] and viscosity [Pa s], the coldest first
# Key -> (unit, least, largest, parameter of the parts).
NUMBERS = {
    "density": ("kg/m3", 500.0, 1500.0, "oil_density"),
    "heat_capacity": ("J/(kg.K)", 500.0, 5e3, "oil_heat_capacity"),
    "conductivity": ("W/(m.K)", 0.01, 1.0, "oil_conductivity"),
    "pressure_viscosity": ("1/Pa", 1e-9, 1e-7, "pressure_viscosity"),
}
VISCOSITY = ("viscosity", "kinematic_viscosity")
DENSITY = 850.0  # kg/m3 of an oil that does not say it
ZERO = 273.15  # K
ROELANDS = ("viscosity_scale", "viscosity_constant", "viscosity_exponent")
VOGEL = ("viscosity_scale", "viscosity_b", "viscosity_c")
EXPONENTS = (0.05, 6.0)  # of Roelands' law, looked through
HALVINGS = 60


def three_points(points: Points, density: float) -> Points:
    """Return three points of a viscosity; to two ASTM D341 gives the third.

    ParameterError unless it falls as the oil warms up.
    """
    known = sorted(points)
    if not 2 <= len(known) <= 3:
        raise ParameterError(f"viscosity: {len(known)} points, allowed: 2 or 3")
    for (cold, thick), (warm, thin) in pairwise(known):
        if not (warm > cold and thick > thin > 0.0):
            raise ParameterError(
                f"viscosity = {thin:.6g} Pa.s at {warm - ZERO:.6g} degC, allowed: above 0 and "
                f"below that at {cold - ZERO:.6g} degC ({thick:.6g} Pa.s)"
            )
    if len(known) == 3:
        return known
    (cold, thick), (warm, thin) = known
    third = cold - 0.5 * (warm - cold)
    if not thin / density > 0.3e-6:
        raise ParameterError(
            f"viscosity = {thin:.6g} Pa.s at {warm - ZERO:.6g} degC, allowed with two points: "
            f"above {0.3e-6 * density:.3g} Pa.s (ASTM D341); give three"
        )
    y_cold, y_warm = (math.log10(math.log10(1e6 * x / density + 0.7)) for x in (thick, thin))
    slope = (y_cold - y_warm) / math.log10(cold / warm)
    y = y_cold + slope * math.log10(third / cold)
    return [(third, 1e-6 * density * (10.0 ** (10.0**y) - 0.7)), *known]


def roelands(points: Points) -> tuple[float, float, float]:
    """Return scale [Pa s], G_o and S_o of mu = scale 10^(G_o x^-S_o), x = 1 + T/135 degC."""
    x = [1.0 + (t - ZERO) / 135.0 for t, _ in points]
    y = [math.log(viscosity) for _, viscosity in points]
    wanted = (y[0] - y[1]) / (y[1] - y[2])

    def ratio(s: float) -> float:
        return float((x[0] ** -s - x[1] ** -s) / (x[1] ** -s - x[2] ** -s))

    s = _bisect(lambda s: ratio(s) - wanted, *EXPONENTS) if x[0] > 0.0 else math.nan
    if not s > 0.0:
        raise _no_law(points)
    height = (y[0] - y[1]) / (x[0] ** -s - x[1] ** -s)
    return math.exp(y[0] - height * x[0] ** -s), height / math.log(10.0), s


def vogel(points: Points) -> tuple[float, float, float]:
    """Return scale [Pa s], b [K] and c [K] of mu = scale exp(b/(T + c)), T in degC."""
    t = [temperature - ZERO for temperature, _ in points]
    y = [math.log(viscosity) for _, viscosity in points]
    q = (y[0] - y[1]) * (t[2] - t[1]) / ((y[1] - y[2]) * (t[1] - t[0]))
    if not q > 1.0:
        raise _no_law(points)
    c = (t[2] - q * t[0]) / (q - 1.0)
    b = (y[0] - y[1]) * (t[0] + c) * (t[1] + c) / (t[1] - t[0])
    return math.exp(y[0] - b / (t[0] + c)), b, c


def _bisect(rising: Callable[[float], float], low: float, high: float) -> float:
    """Return the zero of a rising function, nan if it has none in between."""
    if not rising(low) <= 0.0 <= rising(high):
        return math.nan
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if rising(middle) > 0.0 else (middle, high)
    return 0.5 * (low + high)


def _no_law(points: Points) -> ParameterError:
    said = ", ".join(f"{x:.6g} Pa.s at {t - ZERO:.6g} degC" for t, x in points)
    return ParameterError(
        f"viscosity = {said}, allowed: points of an oil, log viscosity falls ever more slowly"
    )


def parameters_of(oil: dict[str, Any], spec: ModelSpec) -> dict[str, float]:
    """Return what an oil says of a part; ``oil``: numbers in SI units, viscosity as points."""
    names = {f.name for f in fields(spec.params)}
    found = {NUMBERS[k][3]: oil[k] for k in NUMBERS if k in oil and NUMBERS[k][3] in names}
    if "viscosity" in oil and "viscosity_scale" in names:
        points = three_points(oil["viscosity"], oil.get("density", DENSITY))
        law, of = (vogel, VOGEL) if "viscosity_b" in names else (roelands, ROELANDS)
        found |= dict(zip(of, law(points), strict=True))
    return found
