"""What a map covers and how finely: box, patches, pieces; and its header."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from ...errors import ParameterError
from ...model.parameters import as_numbers, check_number
from ...numerics.chebyshev import lines_of
from ...numerics.jit import Array
from ...tribology.viscosity import viscosity
from ..kernel_arguments import constants
from ..kernels.layout import D_SIGMA1, N_STEADY
from ..kernels.map import map_layout as L
from ..parameters import SPEC, WasherParams, face_of

INPUTS = ("load", "speed", "tilt", "oil_temperature")
DEFAULT_BOX = {
    "load": (20.0, 1850.0),
    "speed": (0.0, 1400.0),
    "tilt": (1e-3, 3e-3),
    "oil_temperature": (290.0, 400.0),
}
HEAVY = 50.0  # times the usual least load: a load from which on light ones matter little
TOLERANCE = 5e-3  # relative, of the torque
TOLERANCES = (5e-4, 0.1)  # allowed
FIELD_FROM = 6e-3  # a map of this tolerance stands for the mesh of "field", a finer one for "fine"
BEND = 2.0  # [rad/s] below it nodes lie evenly in speed, above it evenly in its logarithm
ONSET = 5.7  # film ratio; the contact load there is below a mN
LEAST_WIDTH = {"speed": 1e-3, "tilt": 1e-4, "oil_temperature": 0.05}  # less counts as fixed
COARSE = (10, 32)  # grid of everything that needs no accuracy
SPARE = 1.05  # how much of the load range lies beyond its ends
WIDTHS = (1.1, 1.0, 1.6)  # of a patch on the scaled axes, typically, at ``TOLERANCE``
BESIDE = 350  # lines: what survey, lines on a finer mesh and check cost
PLACES = (0.0, 0.25, 0.75)  # nodes of a patch, its last one excepted: -1, -1/2, 1/2

Place = tuple[float, float, float]  # speed [rad/s], tilt [rad], oil temperature [K]


@dataclass(frozen=True, kw_only=True)
class MapPlan:
    """Box [SI], patches of the axes, coefficients, and the contact loads between the pieces."""

    params: WasherParams
    box: dict[str, tuple[float, float]]
    marks: tuple[float, float, float]  # N, ascending
    tolerance: float = TOLERANCE
    bend: float = BEND  # rad/s
    patches: tuple[int, int, int] = (1, 1, 1)  # 0 for a fixed input
    terms: tuple[int, ...] = (8,) * L.N_PIECES  # coefficients of the main curves in each piece
    more_terms: tuple[int, ...] = (6,) * L.N_PIECES  # of the other curves

    @property
    def axes(self) -> tuple[tuple[float, float], ...]:
        """Return the ends of the scaled axes."""
        speed, tilt, oil = (self.box[name] for name in INPUTS[1:])
        low = max(speed[0], 0.5 * L.FLOOR_SPEED)
        return (
            (math.asinh(low / self.bend), math.asinh(max(speed[1], low) / self.bend)),
            (math.log(tilt[0]), math.log(tilt[1])),
            (-math.log(self.viscosity(oil[0])), -math.log(self.viscosity(oil[1]))),
        )

    @property
    def size(self) -> int:
        """Numbers of the map."""
        return L.DATA + lines_of(*self.patches) * self.line

    @property
    def line(self) -> int:
        """Numbers of a line."""
        return int(pieces_at(self.terms, self.more_terms)[-1])

    def at(self, speed: float, tilt: float, oil: float) -> Place:
        """Return the inputs at a place on the scaled axes."""
        return self.bend * math.sinh(speed), math.exp(tilt), self.oil_of(-oil)

    def scaled(self, place: Place) -> tuple[float, float, float]:
        """Return where a place lies on the scaled axes."""
        speed, tilt, oil = place
        return math.asinh(speed / self.bend), math.log(tilt), -math.log(self.viscosity(oil))

    def places(self) -> list[Place]:
        """Return where the lines lie, in the map's order."""
        nodes = [_axis_nodes(*ends, n) for ends, n in zip(self.axes, self.patches, strict=True)]
        speeds = [self.bend * math.sinh(x) for x in nodes[0]]
        tilts, oils = [math.exp(x) for x in nodes[1]], [self.oil_of(-x) for x in nodes[2]]
        within = [x for k, x in enumerate(tilts) if k % 3]
        outer = [(speed, tilt, oil) for speed in speeds for oil in oils for tilt in tilts[::3]]
        inner = product(within, speeds[::3], oils[::3])
        return outer + [(speed, tilt, oil) for tilt, speed, oil in inner]

    def viscosity(self, oil_temperature: float) -> float:
        """Return the viscosity [Pa s] of the oil at its own temperature."""
        p = self.params
        law = p.viscosity_scale, p.viscosity_constant, p.viscosity_exponent
        return float(viscosity(oil_temperature, *law)[0])

    def oil_of(self, log_viscosity: float) -> float:
        """Return the oil temperature [K] in the box with a viscosity."""
        from scipy.optimize import brentq  # late: only who makes a map needs it

        def above(oil: float) -> float:
            return math.log(self.viscosity(oil)) - log_viscosity

        low, high = self.box["oil_temperature"]
        for end in (low, high):
            if abs(above(end)) < 1e-12:
                return end
        return float(brentq(above, low, high, xtol=1e-12))

    def header(self, reach: float) -> Array:
        """Return the map's header; ``reach`` sets where the thick films end (see the layout)."""
        head = np.zeros(L.DATA)
        numbers = as_numbers(self.params)[:N_STEADY]
        head[L.KIND], head[L.SIZE] = L.MAGIC, self.size
        head[L.PARAMS : L.PARAMS + len(numbers)] = numbers
        axes = zip(self.axes, self.patches, strict=True)
        head[L.AXES : L.AXES + 9] = [x for ends, n in axes for x in (*ends, n)]
        head[L.BEND], head[L.ONSET], head[L.REACH] = self.bend, ONSET, reach
        head[L.BOX : L.BOX + 8] = [x for name in INPUTS for x in self.box[name]]
        if head[L.BOX + 2] <= L.FLOOR_SPEED:
            head[L.BOX + 2] = 0.0
        head[L.MARKS : L.MARKS + 3] = self.marks
        head[L.SIGMA] = constants(self.params, COARSE)[D_SIGMA1]
        head[L.TERMS : L.TERMS + L.N_PIECES] = self.terms
        head[L.MORE_TERMS : L.MORE_TERMS + L.N_PIECES] = self.more_terms
        head[L.PIECE_AT : L.IDENTITY] = pieces_at(self.terms, self.more_terms)
        return head


def pieces_at(terms: Sequence[float], more_terms: Sequence[float]) -> Array:
    """Return where the pieces begin in a line, and behind them its length."""
    sizes = L.N_MAIN * np.asarray(terms) + L.N_MORE * np.asarray(more_terms) + L.N_TILTS
    return np.asarray(np.cumsum([L.N_LINE_HEAD, *sizes]))


def plan_map(
    params: WasherParams,
    box: dict[str, tuple[float, float]] | None = None,
    tolerance: float = TOLERANCE,
) -> MapPlan:
    """Return a plan with the fewest patches, or say what is wrong with box and tolerance.

    ``box`` holds (low, high) of load [N], speed [rad/s], tilt [rad], oil_temperature [K]; inputs
    not named are as in ``DEFAULT_BOX``; equal ends fix an input (not the load). ``tolerance`` is
    that of the torque, relative.
    """
    if params.oil_supply_temperature != 0.0:
        raise ParameterError(
            f"oil_supply_temperature = {params.oil_supply_temperature:g} K, allowed for a map: 0 "
            "(as oil_temperature)"
        )
    if params.gear_far_face == "bulk":
        raise ParameterError(
            "gear_far_face = 'bulk', allowed for a map: 'oil' or 'insulated' (a map has no "
            "far_face_temperature)"
        )
    check_number("tolerance", tolerance, "1", *TOLERANCES)
    ends = dict(DEFAULT_BOX)
    for name, pair in (box or {}).items():
        if name not in ends:
            raise ParameterError(f"box: {name!r}, allowed: {', '.join(INPUTS)}")
        ends[name] = _checked(name, pair)
    marks = _marks(params, ends["load"][1])
    plan = MapPlan(params=params, box=ends, marks=marks, tolerance=tolerance)
    moved = (
        plan.box["tilt"][1] / plan.box["tilt"][0] - 1.0,
        plan.box["oil_temperature"][1] - plan.box["oil_temperature"][0],
    )
    low, high = plan.axes[0]
    first, second, third = (
        int(width >= LEAST_WIDTH[name])
        for name, width in zip(INPUTS[1:], (high - low, *moved), strict=True)
    )
    return replace(plan, patches=(first, second, third))


def _checked(name: str, pair: Any) -> tuple[float, float]:
    signal = next(s for s in SPEC.inputs if s.name == name)
    least = least_of(name)
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


def least_of(name: str) -> float:
    """Return the minimum value of an input that a map can cover."""
    signal = next(s for s in SPEC.inputs if s.name == name)
    return {"load": 1.0, "speed": 0.0, "tilt": 1e-5}.get(name, float(signal.low or 0.0))


def coverable(box: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Return a box cut at what a map can cover, without what a map has no axis for."""
    return {n: (first_of(n, ends), ends[1]) for n, ends in box.items() if n in INPUTS}


def first_of(name: str, ends: tuple[float, float]) -> float:
    """Return where a map of a part with this box begins.

    From rest to heavy loads that is the usual load: lighter ones are solved by the field.
    """
    low, usual = ends[0], DEFAULT_BOX["load"][0]
    if name == "load" and low <= 0.0 and ends[1] > HEAVY * usual:
        return usual
    return max(low, least_of(name))


def lines_about(params: WasherParams, box: dict[str, tuple[float, float]], tolerance: float) -> int:
    """Return about how many lines a map costs, with all else; errors as there."""
    plan = plan_map(params, box, tolerance)
    more = (TOLERANCE / tolerance) ** 0.25
    wide = [abs(b - a) / width for (a, b), width in zip(plan.axes, WIDTHS, strict=True)]
    patches = [math.ceil(more * w) if n else 0 for w, n in zip(wide, plan.patches, strict=True)]
    return BESIDE + lines_of(*patches)


def _axis_nodes(low: float, high: float, patches: int) -> list[float]:
    """Return the nodes of a scaled axis, ascending."""
    if patches == 0:
        return [low]
    width = (high - low) / patches
    return [*(low + width * (p + x) for p in range(patches) for x in PLACES), high]


def _marks(params: WasherParams, load_max: float) -> tuple[float, float, float]:
    """Return contact loads that cut the curve: the ends of the dry friction law where they lie."""
    top = SPARE * load_max
    face = face_of(params.inner_radius, params.outer_radius)
    corners = [face * params.friction_pressure_min, face * params.friction_pressure_max]
    inside = [x for x in corners if params.friction_law == "load" and 0.02 * top < x < 0.98 * top]
    if len(inside) == 2:
        return inside[0], inside[1], top
    if len(inside) == 1:
        other = math.sqrt(inside[0] * top) if inside[0] < 0.3 * top else 0.3 * inside[0]
        first, second = sorted((inside[0], other))
        return first, second, top
    return 0.1 * top, 0.4 * top, top
