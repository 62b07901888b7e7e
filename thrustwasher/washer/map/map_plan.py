"""What a map covers and how finely: box, patches, pieces; and its header."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...errors import ParameterError
from ...model.parameters import as_numbers
from ...numerics.chebyshev import N_NODES, nodes_of
from ...numerics.jit import Array
from ...tribology.viscosity import viscosity
from ..kernel_arguments import constants
from ..kernels.layout import D_SIGMA1, N_STEADY
from ..kernels.map import map_layout as L
from ..parameters import SPEC, WasherParams

INPUTS = ("load", "speed", "tilt", "oil_temperature")
DEFAULT_BOX = {
    "load": (20.0, 1850.0), "speed": (0.0, 1400.0), "tilt": (1e-3, 3e-3),
    "oil_temperature": (290.0, 400.0),
}  # fmt: skip
BEND = 20.0  # [rad/s] below it nodes lie evenly in speed, above it evenly in its logarithm
ONSET = 5.0  # film ratio; the contact load there is some mN
PATCH = {"speed": 0.82, "tilt": 0.56, "oil_temperature": 27.5}  # widths on the scaled axes
LEAST_WIDTH = {"speed": 1e-3, "tilt": 1e-4, "oil_temperature": 0.05}  # less counts as fixed
COARSE = (10, 32)  # grid of everything that needs no accuracy
SPARE = 1.05  # how much of the load range lies beyond its ends


@dataclass(frozen=True, kw_only=True)
class MapPlan:
    """Box [SI], scaled axes (low, high, patches) and the contact loads between the pieces."""

    params: WasherParams
    box: dict[str, tuple[float, float]]
    axes: tuple[tuple[float, float, int], ...]
    marks: tuple[float, float, float]  # N, ascending

    @property
    def shape(self) -> tuple[int, int, int]:
        """Nodes of the three axes."""
        first, second, third = (nodes_of(patches) for _, _, patches in self.axes)
        return first, second, third

    def nodes(self) -> tuple[list[float], list[float], list[float]]:
        """Return speeds [rad/s], tilts [rad] and oil temperatures [K] of the nodes."""
        speed, tilt, oil = (_axis_nodes(*axis) for axis in self.axes)
        return [BEND * math.sinh(x) for x in speed], [math.exp(x) for x in tilt], oil

    def viscosity(self, oil_temperature: float) -> float:
        """Return the viscosity [Pa s] of the oil at its own temperature."""
        p = self.params
        law = p.viscosity_scale, p.viscosity_constant, p.viscosity_exponent
        return float(viscosity(oil_temperature, *law)[0])

    def header(self, reach: float) -> Array:
        """Return the map's header; ``reach`` sets where the thick films end (see the layout)."""
        head = np.zeros(L.DATA)
        numbers = as_numbers(self.params)[:N_STEADY]
        head[L.KIND], head[L.SIZE] = L.MAGIC, L.DATA + math.prod(self.shape) * L.LINE
        head[L.PARAMS : L.PARAMS + len(numbers)] = numbers
        head[L.AXES : L.AXES + 9] = [x for axis in self.axes for x in axis]
        head[L.BEND], head[L.ONSET], head[L.REACH] = BEND, ONSET, reach
        head[L.LOAD_MIN], head[L.LOAD_MAX] = self.box["load"]
        head[L.MARKS : L.MARKS + 3] = self.marks
        head[L.SPEED_MAX] = self.box["speed"][1]
        head[L.SIGMA] = constants(self.params, COARSE)[D_SIGMA1]
        return head


def plan_map(params: WasherParams, box: dict[str, tuple[float, float]] | None = None) -> MapPlan:
    """Return how a box is cut up, or say what is wrong with it.

    ``box`` holds (low, high) of load [N], speed [rad/s], tilt [rad], oil_temperature [K]; inputs
    not named are as in ``DEFAULT_BOX``; equal ends fix an input (not the load).
    """
    ends = dict(DEFAULT_BOX)
    for name, pair in (box or {}).items():
        if name not in ends:
            raise ParameterError(f"box: {name!r}, allowed: {', '.join(INPUTS)}")
        ends[name] = _checked(name, pair)
    speed = ends["speed"]
    low = max(speed[0], 0.5 * L.FLOOR_SPEED)
    axes = (
        _cut("speed", math.asinh(low / BEND), math.asinh(max(speed[1], low) / BEND)),
        _cut("tilt", math.log(ends["tilt"][0]), math.log(ends["tilt"][1])),
        _cut("oil_temperature", *ends["oil_temperature"]),
    )
    return MapPlan(params=params, box=ends, axes=axes, marks=_marks(params, ends["load"][1]))


def _checked(name: str, pair: Any) -> tuple[float, float]:
    signal = next(s for s in SPEC.inputs if s.name == name)
    least = {"load": 1.0, "speed": 0.0, "tilt": 1e-5}.get(name, float(signal.low or 0.0))
    try:
        low, high = (float(x) for x in pair)
    except (TypeError, ValueError):
        raise ParameterError(f"box: {name} = {pair!r}, allowed: two numbers, low, high") from None
    if not least <= low <= high <= float(signal.high or 0.0):
        raise ParameterError(
            f"box: {name} = {low:g} .. {high:g} {signal.unit}, allowed: {least:g} .. "
            f"{signal.high:g} {signal.unit}, low not above high"
        )
    if name == "load" and high < 1.2 * low:
        raise ParameterError(f"box: load = {low:g} .. {high:g} N, allowed: high above 1.2 x low")
    return low, high


def _cut(name: str, low: float, high: float) -> tuple[float, float, int]:
    """Return one scaled axis: its ends and number of patches, 0 for a fixed input."""
    if high - low < LEAST_WIDTH[name]:
        return low, low, 0
    return low, high, max(1, math.ceil((high - low) / PATCH[name] - 1e-9))


def _axis_nodes(low: float, high: float, patches: int) -> list[float]:
    """Return the nodes of a scaled axis, ascending."""
    if patches == 0:
        return [low]
    width = (high - low) / patches
    places = (0.0, 0.25, 0.75)  # -1, -1/2, 1/2 of a patch
    inner = [low + width * (p + x) for p in range(patches) for x in places]
    if len(inner) + 1 != patches * (N_NODES - 1) + 1:
        raise AssertionError("nodes of a patch")  # the layout has changed
    return [*inner, high]


def _marks(params: WasherParams, load_max: float) -> tuple[float, float, float]:
    """Return contact loads that cut the curve: the ends of the dry friction law where they lie."""
    top = SPARE * load_max
    corners = [params.friction_load_min, params.friction_load_max]
    inside = [x for x in corners if params.friction_law == "load" and 0.02 * top < x < 0.98 * top]
    if len(inside) == 2:
        return inside[0], inside[1], top
    if len(inside) == 1:
        other = math.sqrt(inside[0] * top) if inside[0] < 0.3 * top else 0.3 * inside[0]
        first, second = sorted((inside[0], other))
        return first, second, top
    return 0.1 * top, 0.4 * top, top
