"""Wet clutch: coefficient of boundary friction, and a pack that slips at a constant speed."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, SolveError, Status
from ..face_load import Face, OnFaces
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.levels import level_named
from ..model.parameters import check_number
from ..model.prepare import Recent, filled
from ..model.record import Sweep
from ..model.sensitivity import Differentiable
from ..model.solutions import Asked
from ..model.spec import REGIMES, ModelSpec
from ..native.load import bound
from ..numerics.jit import Array
from ..units import format_quantity
from .kernels import layout as k
from .kernels import pack_friction, steady
from .parameters import DRUM, LOAD, OIL, SPEC, SPEED, ClutchParams

BEYOND_LAW = (
    "the lining is pressed beyond the reach of the law of contact; lower the load or check the "
    "lining's modulus"
)
PRESSED = "film_ratio = {:.3g}: " + BEYOND_LAW
LININGS = {  # law of friction -> lining that it stands for, Pa on the land that it bears
    "table": ("an organic lining", 3e6),
    "wang": ("a lining of sintered bronze", 6e6),
}
LINING = (  # texts of warnings; the page of a scene has them too
    "load = {load:g} N presses the land of the faces with {pressure:.3g} MPa; above {most:g} MPa "
    "{kind} does not last (a rule of thumb; its maker's limit decides)"
)
WARMTH = (
    "interface at {at}: friction over temperature is known for {low:.0f} .. {high:.0f} degC; "
    "beyond, it stays as it is there"
)
CORRECTED = (
    "friction_coefficient = {here:.3g} at {at}, {own:.3g} at reference_temperature = {warm}: the "
    "numbers given are changed by friction_temperature_slope = {slope}; 0 leaves them as they are"
)
NO_SLOPE = (
    "friction_temperature_slope = {slope} is not used: friction_temperature = auto lets it act on "
    "the start values' table and on law wang; friction_temperature = slope, on any law"
)
NO_CONSTANT = (
    "constant_friction = {value:g} is not used: friction_temperature = points, whose coefficients "
    "stand in its place"
)
UNCOOLED = "heat_transfer = 0 W/(m2.K), allowed: above 0 where a steady temperature is requested"
LESS_COOLING = "heat_transfer = {given}, {here} here: {why}"
INPUTS = (LOAD, SPEED, OIL, DRUM)
NUMBERS = (  # of a result, in the order of a row of the kernel
    "friction_torque",
    "friction_coefficient",
    "temperature",
    "film_thickness",
    "film_ratio",
    "shear_ratio",
    "torque_capacity",
    "friction_power",
    "contact_torque",
    "viscous_torque",
    "contact_share",
)
MUCH = 0.01  # of a number given: a change that is said
LEAST_PRESSURE = 2e4  # Pa, an estimate: lightest pressure that friction over slip is measured at
ROUNDED = 1e-6  # K
__all__ = ["ClutchParams", "ClutchResult", "boundary_friction", "solve_clutch"]


@dataclass(frozen=True, slots=True)
class ClutchResult(Differentiable, OnFaces):
    """A pack slipping at constant load and speed: torque and steady temperatures, SI units."""

    friction_torque: float  # [N m] with the sign of the slip; 0 at slip 0; NaN where TOO_HOT
    friction_coefficient: float
    temperature: float  # [K] interface after a very long time at this slip; compare with status HOT
    film_thickness: float
    """[m] separation of the mean surfaces, settled; below 0 the roughness is pressed flat."""
    film_ratio: float
    shear_ratio: float  # [-] shear strength of the interface over that of the material, s/s_m
    torque_capacity: float  # [N m] largest torque the pack holds at this load and slip
    friction_power: float  # [W] heat made in the whole pack
    contact_torque: float  # [N m] share of friction_torque that the asperities make
    viscous_torque: float  # [N m] share of friction_torque that shear of the oil makes
    contact_share: float  # [-] share of the faces' area that is in contact
    regime: str
    status: Status
    iterations: int
    fidelity: str
    _request: Asked = field(repr=False, compare=False)
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""

    def _on_faces(self) -> tuple[Face, float, float]:
        _, params, point = self._request
        return params.face, point["load"], point["speed"]


def _in_range(name: str, values: ArrayLike, low: float, high: float) -> Any:
    try:
        array = np.asarray(values, float)
    except (TypeError, ValueError):
        raise ParameterError(
            f"{name} = {values!r}, numbers are required, allowed: {low:g} .. {high:g}"
        ) from None
    bad = ~((array >= low) & (array <= high))
    if bad.any():
        first = float(array[bad].flat[0])
        raise ParameterError(f"{name} = {first!r}, allowed: {low:g} .. {high:g}")
    return array


def boundary_friction(
    x: ArrayLike,
    shear_ratio: ArrayLike,
    plough_weight: ArrayLike = 1.0,
    hardness_ratio: ArrayLike = 6.0,
) -> Any:
    """Return the coefficient of boundary friction [-] of Wang, Wei & Wu (2012), Eq 12.

    Parameters
    ----------
    x : width of the indentation over the asperity's diameter, W/2R, above 0 up to 1
    shear_ratio : shear strength of the interface over the material's, s/s_m, 0 .. 1
    plough_weight : weight k of the ploughing share, 0 .. 1
    hardness_ratio : hardness over shear strength N (6 after Tresca, 5.2 after von Mises)

    Returns
    -------
    float, or an array of the common shape of the arguments

    Notes
    -----
    As printed the equation loses all digits for small x; the form used here is good to rounding
    for every x.

    Examples
    --------
    >>> round(boundary_friction(0.1, 0.5, 0.5), 8)
    0.07446961
    """
    given = (
        _in_range("x", x, 1e-300, 1.0),
        _in_range("shear_ratio", shear_ratio, 0.0, 1.0),
        _in_range("plough_weight", plough_weight, 0.0, 1.0),
        _in_range("hardness_ratio", hardness_ratio, 1.0, 20.0),
    )
    try:
        arrays = np.broadcast_arrays(*given)
    except ValueError:
        shapes = ", ".join(str(a.shape) for a in given)
        raise ParameterError(
            f"x, shear_ratio, plough_weight, hardness_ratio: shapes {shapes} do not go together"
        ) from None
    values = [pack_friction.friction(*map(float, point)) for point in zip(*map(np.ravel, arrays))]  # noqa: B905 (broadcast: equal lengths)
    return np.array(values).reshape(arrays[0].shape) if arrays[0].ndim else values[0]


def prepare(params: ClutchParams, fidelity: str) -> Any:
    """Return the parameter array of the kernel, constants included."""
    return filled(SPEC, params, fidelity, k.NPAR, steady.derive)


class _Ready:
    """A pack at a level, ready to be solved again."""

    def __init__(self, params: ClutchParams, fidelity: str) -> None:
        self.params, self.fidelity, self.level = params, fidelity, level_named(SPEC, fidelity)
        self.par = prepare(params, fidelity)

    @cached_property
    def doubts(self) -> tuple[str, ...]:
        """What is to be said at every point."""
        return doubts_of_pack(self.params, self.fidelity)


_ready = Recent(_Ready)


@cache
def _start() -> ClutchParams:
    """Return the pack whose values nobody gave."""
    return ClutchParams()


def solve_clutch(
    params: ClutchParams,
    *,
    load: float,
    speed: float,
    oil_temperature: float = 297.15,
    drum_speed: float = 0.0,
    interface_temperature: float | None = None,
    fidelity: str = "field",
    start: ClutchResult | None = None,
    throw: bool = True,
) -> ClutchResult:
    """Return torque and steady temperature of a pack that slips at a constant speed.

    Parameters
    ----------
    params : the pack
    load : axial force on the pack [N]
    speed : slip [rad/s], with its sign
    oil_temperature : [K]
    drum_speed : [rad/s] of the drum, with its sign; the hub turns by the slip faster
    interface_temperature : [K] of the faces, up to 600 degC, of a slip that is over before it warms
        them; by default where cooling balances friction
    fidelity : "closed" (constant coefficient), "stribeck" (coefficient over slip speed), "field"
        (shear of the oil too) or "fine" (the same in rings, ``temperature`` their mean by area)
    start : an earlier result to start the search for the film from
    throw : False returns a result with its status instead of raising SolveError

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : no film or temperature was found, or one above 600 degC (TOO_HOT), whose numbers
        are NaN

    Notes
    -----
    The film is settled (the asperities carry the load; an open pack has its clearance), the
    temperature is where cooling balances friction. For slip that lasts it soon lies far above
    what a lining survives: status HOT says so, above 600 degC there is no answer. A shift is over
    long before; ``engage_clutch`` and the FMU give film and temperature over time,
    ``interface_temperature`` a moment of it.

    Examples
    --------
    >>> r = solve_clutch(ClutchParams(), load=9000.0, speed=0.0)
    >>> r.friction_torque, r.regime
    (0.0, 'adhesive')
    >>> round(r.torque_capacity, 2)
    326.25
    """
    load = check_number("load", load, "N", *LOAD.range)
    speed = check_number("speed", speed, "rad/s", *SPEED.range)
    oil = check_number("oil_temperature", oil_temperature, "K", *OIL.range)
    drum = check_number("drum_speed", drum_speed, "rad/s", *DRUM.range)
    point = {"load": load, "speed": speed, "oil_temperature": oil, "drum_speed": drum}
    held: float | None = None
    if interface_temperature is not None:
        ends = (OIL.range[0], k.EXTRAPOLATED_LIMIT)
        held = check_number("interface_temperature", interface_temperature, "K", *ends)
        point["interface_temperature"] = held
    ready = _ready(params, fidelity)
    guess = start.film_ratio if start else steady.GUESS
    out, at = np.empty(steady.N_STEADY), steady.NOT_HELD if held is None else held
    steady.steady_row(ready.par, load, speed, oil, drum, at, guess, out)
    row: list[float] = out.tolist()
    status = Status(int(row[steady.S_STATUS]))
    if status is Status.BAD_INPUT:
        raise ParameterError(UNCOOLED)
    if status.is_failure and throw:
        raise SolveError(f"load = {load:g} N, speed = {speed:g} rad/s: {status.advice}")
    request = Asked(SPEC.key, params, {**point, "fidelity": fidelity})
    return ClutchResult.later(
        lambda: _fields(ready, row, status, request),
        lambda: _warnings(ready, row, status, params, point),
        status,
    )


def _fields(ready: _Ready, row: list[float], status: Status, request: Asked) -> dict[str, Any]:
    """Return the fields of a result; of a pack that is TOO_HOT the numbers are NaN."""
    numbers = dict(zip(NUMBERS, row, strict=False))
    if status is Status.TOO_HOT:
        numbers = dict.fromkeys(numbers, math.nan)
    return {
        **numbers,
        "regime": list(REGIMES)[int(row[steady.S_REGIME]) - 1],
        "status": status,
        "iterations": int(row[steady.S_ITERATIONS]),
        "fidelity": ready.level,
        "_request": request,
    }


def _warnings(
    ready: _Ready,
    row: list[float],
    status: Status,
    params: ClutchParams,
    point: Mapping[str, float],
) -> tuple[str, ...]:
    """Return the warnings of a result; one that is TOO_HOT says its status alone."""
    if status is Status.TOO_HOT:
        return (f"{status.name}: {status.advice}",)
    temperature, hottest = row[steady.S_TEMPERATURE], row[steady.S_HOTTEST]
    load, speed, cooled = point["load"], point["speed"], "interface_temperature" not in point
    cooling, fidelity = row[steady.S_COOLING], ready.fidelity
    return (
        *ready.doubts,
        *_corrected(params, ready.par, fidelity, speed, row),
        *(_less_cooling(params, ready.par, cooling) if speed and cooled else ()),
        *_light(params, load, fidelity),
        *doubts_of_lining(params, load),
        *doubts_of_warmth(params, temperature, hottest, fidelity),
        *pack_warnings(status, row[steady.S_RATIO], temperature, hottest),
    )


def heat_status(hottest: float) -> Status:
    """Return the status of a pack over time whose hottest interface [K] this was."""
    if hottest > k.EXTRAPOLATED_LIMIT:
        return Status.EXTRAPOLATED
    return Status.HOT if hottest > k.HOT_LIMIT else Status.OK


def doubts_of_pack(
    params: ClutchParams, fidelity: str, usual: Mapping[str, Any] | None = None
) -> tuple[str, ...]:
    """Return what contradicts itself in parameters, and what has no effect next to the others."""
    radius, faces = params.effective_radius, (params.inner_radius, params.outer_radius)
    found = list(idle_warnings(SPEC.key, params, fidelity, usual))
    if radius and not faces[0] <= radius <= faces[1] and fidelity != "closed":
        found.append(
            f"effective_radius = {radius:g} m is off the faces of {faces[0]:g} .. {faces[1]:g} m: "
            "torque and slip speed are those of another pack; give one between, or 0"
        )
    return (*found, *_not_used(params, fidelity))


def _not_used(params: ClutchParams, fidelity: str) -> Iterator[str]:
    """Yield a line for a number that was given and ``friction_temperature`` leaves unread."""
    start, slope = _start(), params.friction_temperature_slope
    idle = params.friction_temperature == "auto" and not params.temperature_law(fidelity)
    if idle and slope not in (0.0, start.friction_temperature_slope):
        yield NO_SLOPE.format(slope=format_quantity(slope, "1/K"))
    own = params.constant_friction
    constant = params.friction_law == "constant" or fidelity == "closed"
    points = params.friction_temperature == "points"
    if points and constant and own != start.constant_friction:
        yield NO_CONSTANT.format(value=own)


def _corrected(
    params: ClutchParams, par: Any, fidelity: str, speed: float, row: list[float]
) -> Iterator[str]:
    """Yield a line for a number that was given and a default changes, with what it is here."""
    wang = params.friction_law == "wang" and params.friction_temperature == "auto"
    if not wang or not params.temperature_law(fidelity):
        return
    here, warm = row[steady.S_COEFFICIENT], params.reference_temperature
    own = float(pack_friction.coefficient_slopes(par, speed, warm)[0])
    if abs(here - own) > MUCH * own:
        yield CORRECTED.format(
            here=here,
            at=format_quantity(row[steady.S_TEMPERATURE], "K"),
            own=own,
            warm=format_quantity(warm, "K"),
            slope=format_quantity(params.friction_temperature_slope, "1/K"),
        )


def _less_cooling(params: ClutchParams, par: Any, cooling: float) -> Iterator[str]:
    """Yield a line if less than the given ``heat_transfer`` cools the faces; ``cooling`` [W/K]."""
    given, start = params.heat_transfer, _start()
    here = cooling / params.lining_area
    if given == start.heat_transfer or abs(here - given) <= MUCH * given:
        return
    why = f"oil_flow = {format_quantity(params.oil_flow, 'm3/s')} takes no more (0: all)"
    if par[k.D_CLOSED_COOLING] != given:
        why = "oil in the grooves cools closed faces (groove_count = 0: heat_transfer alone)"
    texts = (format_quantity(x, "W/(m2.K)") for x in (given, here))
    yield LESS_COOLING.format(given=next(texts), here=next(texts), why=why)


def _light(params: ClutchParams, load: float, fidelity: str) -> list[str]:
    """Return a line if friction of a pressed pack stands for one that is hardly pressed."""
    pressure = load * params.faces / params.lining_area
    held = params.friction_data == "total" and fidelity in ("field", "fine")
    if not held or not k.OPEN_PRESSURE <= pressure < LEAST_PRESSURE:
        return []
    return [
        f"load = {load:g} N is {pressure:.3g} Pa on the faces: friction of settled packs is "
        f"measured above some {LEAST_PRESSURE:g} Pa; the shear of the oil that adds to it "
        f"is left out, "
        "with friction_data = 'boundary' it counts"
    ]


def doubts_of_lining(params: ClutchParams, load: float) -> Iterator[str]:
    """Yield a line if a load presses the land of the faces more than their lining bears."""
    kind, most = LININGS.get(params.friction_law, LININGS["table"])
    pressure = load * params.faces / params.lining_area / params.land_share
    if pressure > most:
        yield LINING.format(load=load, pressure=pressure / 1e6, most=most / 1e6, kind=kind)


def range_of_warmth(params: ClutchParams, fidelity: str) -> tuple[float, float] | None:
    """Return the range [K] of friction over temperature, None where it does not change with it."""
    if params.temperature_law(fidelity) == "points":
        given = [p for p in range(1, k.N_POINTS + 1) if getattr(params, f"point_friction_{p}")]
        first, last = (getattr(params, f"point_temperature_{p}") for p in (given[0], given[-1]))
        return first, last
    return k.TEMPERATE if params.temperature_law(fidelity) else None


def doubts_of_warmth(
    params: ClutchParams, coldest: float, hottest: float, fidelity: str = ""
) -> Iterator[str]:
    """Yield a line if interfaces [K] leave the range of friction over temperature."""
    known = range_of_warmth(params, fidelity)
    if known is None or hottest > k.HOT_LIMIT:
        return
    low, high = known
    if low - ROUNDED <= coldest and hottest <= high + ROUNDED:
        return
    at = hottest if hottest > high else coldest
    yield WARMTH.format(at=format_quantity(at, "K"), low=low - 273.15, high=high - 273.15)


def pack_warnings(
    status: Status, ratio: float, temperature: float, hottest: float
) -> tuple[str, ...]:
    """Return the warnings of a pack: film ratio, interface [K] and hottest ring of it [K]."""
    more = [PRESSED.format(ratio)] if ratio < k.LEAST_RATIO else []
    if temperature <= k.HOT_LIMIT < hottest:
        more.append(f"hottest ring = {format_quantity(hottest, 'K')}: {Status.HOT.advice}")
    return warnings_of(SPEC, status, {}, {"temperature": temperature}, more)


def walk_steady(
    spec: ModelSpec,
    params: ClutchParams,
    fidelity: str,
    inputs: Array,
    numbers: Array,
    flags: NDArray[np.int32],
    starts: Sequence[int],
) -> None:
    """Fill the rows of a sweep's lines with the steady state of a pack that slips."""
    given, good = _in_ranges(inputs)
    rows = np.full((len(inputs), steady.N_STEADY), np.nan)
    rows[:, steady.S_STATUS], rows[:, steady.S_REGIME] = Status.BAD_INPUT, 0.0
    places = np.concatenate([[0], np.cumsum(good)])[list(starts)]
    rows[good] = _lines(_ready(params, fidelity).par, given, places.tolist())
    names = [name for name in spec.real_outputs if name not in SWEEP.not_shown]
    numbers[:] = rows[:, [NUMBERS.index(name) for name in names]]
    flags[:, 0], flags[:, -1] = rows[:, steady.S_REGIME], rows[:, steady.S_STATUS]


def _lines(par: Array, inputs: Array, starts: Sequence[int]) -> Array:
    """Return rows (n, N_STEADY) of lines, each of which begins anew."""
    found = np.empty((len(inputs), steady.N_STEADY))
    point, row = np.empty((1, inputs.shape[1])), np.empty((1, steady.N_STEADY))
    alone = bound(steady.steady_rows, par=par, inputs=point, out=row)
    for a, b in pairwise(starts):
        if b == a + 1:  # handing over arrays takes longer than a row
            point[0] = inputs[a]
            alone()
            found[a] = row[0]
        elif b > a:
            steady.steady_rows(par, inputs[a:b], found[a:b])
    return found


def _in_ranges(inputs: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return the rows of load, speed, oil and drum that are in their ranges, and which they are."""
    low, high = np.transpose([s.range for s in INPUTS])
    good = ((inputs >= low) & (inputs <= high)).all(axis=1)
    if good.all():
        return np.ascontiguousarray(inputs), good
    given = np.array(inputs)
    for i in np.flatnonzero(~good).tolist():
        with suppress(ParameterError):  # only rounding may have put it outside
            row = zip(INPUTS, given[i].tolist(), strict=True)
            given[i] = [check_number(s.name, x, s.unit, *s.range) for s, x in row]
            good[i] = True
    return given[good], good


SWEEP = Sweep(
    walk=walk_steady,
    # It slips for ever: its heat has no end.
    not_shown=(
        "energy",
        "heat_flux",
        "viscosity",
        "oil_heat",
        "stored_heat",
        "oil_energy",
        "advised_step",
        "plant_inertia",
        "locked",
        "plant_age",
        "slip_bound",
    ),
    least={"film_ratio": (k.LEAST_RATIO, BEYOND_LAW)},
)
