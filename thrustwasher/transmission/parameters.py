"""Parameters, inputs and outputs of the shift transmission: the one list of all interfaces."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import Any

from ..errors import ParameterError
from ..model.parameters import (
    check_ranges,
    check_rules,
    choice,
    count,
    extended,
    flag,
    other_names,
    quantity,
)
from ..model.spec import ModelSpec, Rule, Signal, Terminal, output
from .bearings import BEARINGS, bearing_fields, rubbing, two_ends

ARRANGEMENT = {
    "sun-input": "the sun is driven, the brake holds the ring: first gear 1 + z_r/z_s",
    "ring-input": "the ring is driven, the brake holds the sun: first gear 1 + z_s/z_r",
}
ACTUATION = {
    "command": "shift_command moves the load from the brake to the clutch",
    "pressure": "pistons press the packs: courses of pressure and pressure inputs",
}
COUPLING = {
    "capacity": "the packs send the torque they can hold; stick and slip are decided in here",
    "torque": "the packs send their friction torque: the plain loop, limited in step size",
}


def _planet_teeth(p: Any) -> str:
    return (
        f"planet_teeth = {p.planet_teeth!r}, allowed: half of ring_teeth - sun_teeth (here "
        f"{0.5 * (p.ring_teeth - p.sun_teeth):g}), within one tooth with profile_shifted, or 0"
    )


def _room(p: Any) -> str:
    free = (p.sun_teeth + p.planet_teeth) * math.sin(math.pi / p.planets) - 2.0
    return (
        f"planets = {p.planets!r}, allowed: so many that their tips do not meet: planet_teeth "
        f"({p.planet_teeth!r}) below (sun_teeth + planet_teeth) sin(pi/planets) - 2 = {free:.4g}"
    )


COURSES = {  # of points in time; what is out of use beside the engine's: its constant torque
    "clutch_pressure": ("Pa", 0.0, 1e8, "pressure of the clutch"),
    "brake_pressure": ("Pa", 0.0, 1e8, "pressure of the brake"),
    "engine_torque": ("N.m", -1e5, 1e5, "engine torque"),
}
POINTS = 10  # of a course at most


def course_fields(name: str, points: Sequence[tuple[float, float]]) -> dict[str, float]:
    """Return the parameters of a course of points (time [s], value in SI units).

    ParameterError if there are none or too many.
    """
    if not 1 <= len(points) <= POINTS:
        raise ParameterError(f"{name}: {len(points)} points, allowed: 1 .. {POINTS}")
    times = {f"{name}_time_{i}": t for i, (t, _) in enumerate(points, 1)}
    values = {f"{name}_{i}": x for i, (_, x) in enumerate(points, 1)}
    return {f"{name}_points": len(points), **times, **values}


def course_points(params: Any, name: str) -> list[tuple[float, float]]:
    """Return the points of a course: time [s] and value."""
    return [
        (getattr(params, f"{name}_time_{i}"), getattr(params, f"{name}_{i}"))
        for i in range(1, getattr(params, f"{name}_points") + 1)
    ]


def _order(name: str) -> Rule:
    def exact(p: Any) -> str:
        times = [t for t, _ in course_points(p, name)]
        i, a, b = next((i, a, b) for i, (a, b) in enumerate(pairwise(times), 2) if not b > a)
        return f"{name}_time_{i} = {b!r} s, allowed: above the time of the point before ({a!r} s)"

    return Rule(f"{name}_time_2 = {{{name}_time_2}} s, allowed: rising from point to point", exact)


RULES = (
    Rule("ring_teeth = {ring_teeth}, allowed: above sun_teeth ({sun_teeth})"),
    Rule(
        "planet_teeth = {planet_teeth}, allowed: half of ring_teeth - sun_teeth ({ring_teeth} - "
        "{sun_teeth}), within one tooth with profile_shifted, or 0",
        _planet_teeth,
    ),
    Rule(
        "shaft_damping = {shaft_damping} N.m.s/rad, allowed: 0 with a rigid shaft "
        "(shaft_stiffness = 0)"
    ),
    Rule(
        "initial_twist = {initial_twist} rad, allowed: 0 with a rigid shaft (shaft_stiffness = 0)"
    ),
    Rule(
        "planets = {planets}, allowed: numbers that divide sun_teeth + ring_teeth ({sun_teeth} + "
        "{ring_teeth}), or they cannot be put in"
    ),
    Rule(
        "planets = {planets}, allowed: so many that their tips do not meet: (sun_teeth + "
        "planet_teeth) sin(pi/planets) above planet_teeth + 2",
        _room,
    ),
    Rule(
        "piston_outer_radius = {piston_outer_radius} m, allowed: from piston_inner_radius "
        "({piston_inner_radius} m) on"
    ),
    Rule(
        "piston_supply_radius = {piston_supply_radius} m, allowed: up to piston_outer_radius "
        "({piston_outer_radius} m)"
    ),
    *map(_order, COURSES),
    *map(two_ends, BEARINGS),
    *map(rubbing, BEARINGS),
)


def _piston(pack: str) -> dict[str, Any]:
    its = f"the {pack}'s"
    given = {
        "piston_area": (8e-3, "m2", 0.0, 10.0, f"area of {its} piston"),
        "return_spring": (3e4, "Pa", 0.0, 1e8, f"pressure that holds {its} return spring"),
        "fill_volume": (0.0, "m3", 0.0, 0.1, f"oil that fills {its} piston (0: filled at once)"),
        "fill_flow": (1e-4, "m3/s", 1e-9, 1.0, f"flow that fills or empties the {pack}"),
        "pressure_lag": (
            0.0,
            "s",
            0.0,
            10.0,
            f"time constant of {its} pressure behind its command",
        ),
    }
    return {f"{pack}_{name}": quantity(*about) for name, about in given.items()}


def _course(name: str, unit: str, low: float, high: float, text: str) -> dict[str, Any]:
    time, value = f"{text}: time of point", f"{text}: value of point"
    n = range(1, POINTS + 1)
    return {
        f"{name}_points": count(0, 0, POINTS, f"number of points of the {text} over time"),
        **{f"{name}_time_{i}": quantity(0.0, "s", -1e6, 1e6, f"{time} {i}") for i in n},
        **{f"{name}_{i}": quantity(0.0, unit, low, high, f"{value} {i}") for i in n},
    }


def _force(text: str) -> Any:
    return quantity(5898.0, "N", 0.0, 1e6, text, read_by=(("actuation", "command"),))


@dataclass(frozen=True, kw_only=True)
class _TransmissionParams:
    """One planetary set: engine at the driven gear, a drum at the other, output at the carrier.

    The brake holds the drum (first gear, ratio 1 + drum teeth/driven teeth), the clutch locks
    both gears together (second gear, ratio 1). Assembly rules hold for sets with planet_teeth;
    without, the set is an ideal one. A stiffness puts a spring and a damper between carrier and
    vehicle; the load then acts on the vehicle. All defaults are estimates of a car-sized set.
    """

    arrangement: str = choice("sun-input", ARRANGEMENT, "Arrangement", "which gear is driven")
    sun_teeth: int = count(30, 1, 1000, "teeth of the sun gear")
    planet_teeth: int = count(18, 0, 1000, "teeth of a planet (0: half of ring minus sun)")
    ring_teeth: int = count(66, 2, 2000, "teeth of the ring gear")
    profile_shifted: bool = flag(False, "planet_teeth may be one off half of ring - sun")
    planets: int = count(4, 1, 24, "number of planets on the carrier")
    normal_module: float = quantity(1.5e-3, "m", 1e-4, 0.05, "normal module of the gears")
    helix_angle: float = quantity(
        0.3490658503988659, "rad", 0.0, 0.7853981633974483, "helix angle at the pitch"
    )
    input_inertia: float = quantity(
        0.25, "kg.m2", 1e-6, 1e4, "inertia of engine and driven gear", also="sun_inertia"
    )
    carrier_inertia: float = quantity(
        8.0, "kg.m2", 1e-6, 1e6, "inertia of the carrier, with a rigid shaft also of the vehicle"
    )
    drum_inertia: float = quantity(
        0.01, "kg.m2", 0.0, 1e4, "inertia of drum and braked gear (0 allowed)", also="ring_inertia"
    )
    initial_engine_speed: float = quantity(350.0, "rad/s", -5e3, 5e3, "engine speed at the start")
    initial_drum_speed: float = quantity(
        0.0, "rad/s", -5e3, 5e3, "drum speed at the start", also="initial_ring_speed"
    )
    engine_torque: float = quantity(150.0, "N.m", -1e5, 1e5, "engine torque once it is on")
    engine_start_time: float = quantity(0.0, "s", -1e9, 1e9, "time the engine torque is turned on")
    load_torque: float = quantity(250.0, "N.m", 0.0, 1e6, "load torque at load_speed, grows as w^2")
    load_speed: float = quantity(100.0, "rad/s", 1e-3, 1e4, "output speed load_torque belongs to")
    clutch_force: float = _force("clutch load at shift_command = 1")
    brake_force: float = _force("brake load at shift_command = 0")
    washers: int = count(8, 0, 100, "number of thrust washers on all planets together")
    washer_radius: float = quantity(0.0085, "m", 1e-3, 1.0, "radius the washer's load acts at")
    thrust_share: float = quantity(0.1, "1", 0.0, 1.0, "share of tilting couple washers take")
    planet_tilt: float = quantity(1.6e-3, "rad", 0.0, 0.01, "tilt of a planet on its pin")
    oil_temperature: float = quantity(297.15, "K", 233.15, 473.15, "temperature of the sump oil")
    coupling: str = choice("capacity", COUPLING, "Coupling", "what the packs' torque inputs carry")
    capacity_extrapolation: bool = flag(True, "capacities go on changing as in the step before")
    torque_age: int = count(0, 0, 2, "steps the received torques are old (1: parallel master)")
    tolerance: float = quantity(1e-11, "1", 1e-13, 1e-4, "relative error of the inner integration")
    shaft_stiffness: float = quantity(0.0, "N.m/rad", 0.0, 1e9, "output shaft (0: rigid)")
    shaft_damping: float = quantity(0.0, "N.m.s/rad", 0.0, 1e6, "damping of the output shaft")
    vehicle_inertia: float = quantity(8.0, "kg.m2", 1e-6, 1e6, "inertia behind an elastic shaft")
    initial_twist: float = quantity(0.0, "rad", -10.0, 10.0, "twist of the shaft at the start")
    actuation: str = choice("command", ACTUATION, "Actuation", "what presses the packs")
    piston_inner_radius: float = quantity(
        0.0, "m", 0.0, 1.0, "of the clutch's piston, which turns with the drum"
    )
    piston_outer_radius: float = quantity(
        0.0, "m", 0.0, 1.0, "of the clutch's piston (0: no centrifugal head)"
    )
    piston_supply_radius: float = quantity(
        0.0, "m", 0.0, 1.0, "where oil enters the turning piston"
    )
    balance_share: float = quantity(0.0, "1", 0.0, 1.0, "share of the head a balance chamber takes")
    oil_density: float = quantity(850.0, "kg/m3", 500.0, 1500.0, "density of the oil in the piston")
    rolling_torque: float = quantity(0.0, "N.m", 0.0, 1e6, "load against the motion at any speed")
    grade_torque: float = quantity(0.0, "N.m", -1e6, 1e6, "load at any speed and rest, of a slope")
    ring_mesh: bool = flag(
        False, "ring_mesh_torque is the ring meshes' loss (False: mesh_torque stands for both)"
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.dynamics import broken_rule

        check_rules(self, RULES, broken_rule)

    @property
    def ratio(self) -> float:
        """Teeth of the braked gear over those of the driven one; first gear is 1 + ratio."""
        if self.arrangement == "ring-input":
            return self.sun_teeth / self.ring_teeth
        return self.ring_teeth / self.sun_teeth

    @property
    def meshes(self) -> float:
        """Number of sun meshes with as much loss as all meshes that ``mesh_torque`` stands for."""
        if self.ring_mesh:
            return self.planets
        sun, ring = self.sun_teeth, self.ring_teeth
        planet = self.planet_teeth or 0.5 * (ring - sun)
        return self.planets * (1.0 + (1.0 / planet - 1.0 / ring) / (1.0 / planet + 1.0 / sun))


_MORE = {k: x for name in BEARINGS for k, x in bearing_fields(name).items()}
_MORE |= _piston("clutch") | _piston("brake")
for _name, _about in COURSES.items():
    _MORE |= _course(_name, *_about)
TransmissionParams = other_names(extended(_TransmissionParams, "TransmissionParams", _MORE))


def _input(name: str, unit: str, text: str, low: float, high: float, nominal: float) -> Signal:
    return Signal(name=name, unit=unit, help=text, low=low, high=high, nominal=nominal, start=0.0)


def _torque(name: str, text: str) -> Signal:
    return _input(name, "N.m", text, -1e6, 1e6, 100.0)


def _pressure(pack: str) -> Signal:
    text = f"pressure of the {pack} beside its course, at the step's end"
    return _input(f"{pack}_pressure", "Pa", text, 0.0, 1e8, 1e5)


INPUTS = (
    _torque("clutch_torque", "clutch's torque capacity (coupling torque: friction torque)"),
    _torque("brake_torque", "brake's torque capacity (coupling torque: friction torque)"),
    _torque("washer_torque", "friction torque of one thrust washer"),
    _torque("mesh_torque", "friction torque of one sun mesh, referred to the planet"),
    _input("shift_command", "1", "0 first gear, 1 second gear, at the step's end", 0.0, 1.0, 1.0),
    *map(_pressure, ("clutch", "brake")),
    _torque("engine_torque_input", "torque of an engine model, beside the engine's own"),
    _torque("load_torque_input", "torque of a vehicle model against the output, beside the load's"),
    _torque("ring_mesh_torque", "friction torque of one ring mesh, referred to the planet"),
)
_ENGINE, _LOAD = ("engine_torque_input",), ("load_torque_input",)
_TORQUES = (*(signal.name for signal in INPUTS[:4]), *_ENGINE, *_LOAD, "ring_mesh_torque")
# Drag decides only who holds a clutch beyond its capacity, not how much.
_PACKS = (*_TORQUES[:2], *_ENGINE, *_LOAD)
_PRESSED = {pack: ("shift_command", f"{pack}_pressure") for pack in ("clutch", "brake")}


def _flag(name: str, text: str, events: str, depends: tuple[str, ...]) -> Signal:
    rises, _, falls = events.partition(", ")
    return Signal(
        name=name, unit="1", kind="boolean", help=text, depends=depends, events=(rises, falls)
    )


def _of_piston(pack: str) -> tuple[Signal, ...]:
    return (
        output(
            f"{pack}_piston_pressure",
            "Pa",
            1e5,
            f"pressure at the {pack}'s piston",
            (f"{pack}_pressure",),
        ),
        output(f"{pack}_filled_time", "s", 1.0, f"time the {pack} was last filled (-1: never)"),
        output(f"{pack}_kiss_time", "s", 1.0, f"time the {pack}'s piston last touched (-1: never)"),
    )


def _bearing_torque(gear: str) -> Signal:
    text = f"friction of the {gear}'s thrust bearing against its first shaft"
    return output(f"{gear}_bearing_torque", "N.m", 0.1, text, _TORQUES)


def _filled(pack: str) -> Signal:
    text = f"the {pack}'s piston has all its oil and can press"
    return _flag(f"{pack}_filled", text, f"{pack} filled, {pack} empties", (f"{pack}_pressure",))


OUTPUTS = (
    output("clutch_load", "N", 5e3, "axial force on the clutch pack", _PRESSED["clutch"]),
    output("clutch_speed", "rad/s", 100.0, "slip of the clutch, driven gear minus drum"),
    output("brake_load", "N", 5e3, "axial force on the brake pack", _PRESSED["brake"]),
    output("brake_speed", "rad/s", 100.0, "slip of the brake, speed of the drum"),
    output("washer_load", "N", 100.0, "axial load on one thrust washer", _TORQUES),
    output("washer_speed", "rad/s", 100.0, "speed of a planet on its pin"),
    output("washer_tilt", "rad", 1e-3, "tilt of a planet against the carrier"),
    output("mesh_load", "N.m", 10.0, "torque of one planet in its sun and its ring mesh", _TORQUES),
    output("mesh_speed", "rad/s", 100.0, "speed of a planet against the carrier"),
    output("engine_speed", "rad/s", 100.0, "speed of engine and driven gear"),
    output("output_speed", "rad/s", 100.0, "speed of carrier and output"),
    output("drum_speed", "rad/s", 100.0, "speed of drum and braked gear"),
    output("drive_torque", "N.m", 100.0, "torque of the engine now", _ENGINE),
    output("resistance_torque", "N.m", 100.0, "torque of the load now", _LOAD),
    output("clutch_reaction", "N.m", 100.0, "torque the clutch really transmits", _PACKS),
    output("brake_reaction", "N.m", 100.0, "torque the brake really holds", _TORQUES),
    output("input_tooth_torque", "N.m", 100.0, "torque in the driven gear's teeth", _TORQUES),
    output("drag_torque", "N.m", 1.0, "drag of washers and meshes at the driven gear", _TORQUES),
    output("tooth_force", "N", 1e3, "tangential force in one mesh", _TORQUES),
    output("tilting_couple", "N.m", 10.0, "couple of the axial tooth forces on a planet", _TORQUES),
    output("sun_thrust", "N", 1e3, "axial force on the sun gear, against the ring's", _TORQUES),
    output("engine_work", "J", 1e4, "work of the engine since the start"),
    output("load_work", "J", 1e4, "work into the load since the start"),
    output("kinetic_energy", "J", 1e4, "kinetic energy of the driveline"),
    output("kinetic_change", "J", 1e4, "kinetic energy gained since the start"),
    output("clutch_heat", "J", 1e4, "heat of the clutch since the start, mechanical side"),
    output("brake_heat", "J", 1e4, "heat of the brake since the start, mechanical side"),
    output("washer_heat", "J", 100.0, "heat of all washers since the start"),
    output("mesh_heat", "J", 100.0, "heat of all meshes since the start"),
    output("energy_residual", "J", 1.0, "energy that the book cannot account for"),
    output("lock_time", "s", 1.0, "time the clutch last locked (-1: it never did)"),
    output("lock_speed", "rad/s", 100.0, "engine speed when the clutch last locked"),
    output("release_time", "s", 1.0, "time the brake last broke away (-1: it never did)"),
    output("oil_supply_temperature", "K", 300.0, "temperature of the oil sent to every part"),
    output("vehicle_speed", "rad/s", 100.0, "speed of the vehicle behind the output shaft"),
    output("shaft_torque", "N.m", 100.0, "torque of the output shaft (rigid: of the load)", _LOAD),
    output("shaft_twist", "rad", 0.1, "twist of the output shaft, carrier before vehicle"),
    output("shaft_heat", "J", 100.0, "heat of the shaft's damping since the start"),
    output("shaft_energy", "J", 100.0, "energy the shaft's spring gained since the start"),
    output("output_torque", "N.m", 100.0, "torque of gears and bearings on the carrier", _TORQUES),
    output(
        "output_acceleration",
        "rad/s2",
        10.0,
        "acceleration of the vehicle, at the output",
        _TORQUES,
    ),
    output("clutch_hub_speed", "rad/s", 100.0, "speed of the clutch's hub, the driven gear"),
    output("clutch_drum_speed", "rad/s", 100.0, "speed of the clutch's drum"),
    output("brake_hub_speed", "rad/s", 100.0, "speed of the brake's hub, the drum"),
    output("brake_drum_speed", "rad/s", 100.0, "speed of the brake's housing: 0"),
    *chain.from_iterable(zip(*map(_of_piston, ("clutch", "brake")), strict=True)),
    *map(_bearing_torque, ("sun", "ring")),
    output("bearing_power", "W", 100.0, "heat of both thrust bearings, mean of the step", _TORQUES),
    output("bearing_heat", "J", 100.0, "heat of both thrust bearings since the start"),
    _flag(
        "clutch_locked",
        "the clutch sticks, its slip is exactly zero",
        "clutch locked, clutch broke away",
        _TORQUES,
    ),
    _flag(
        "brake_locked",
        "the brake sticks, the drum stands still",
        "brake locked, brake broke away",
        _TORQUES,
    ),
    *map(_filled, ("clutch", "brake")),
    Signal(name="events", unit="1", kind="integer", help="lock-ups and break-aways located so far"),
    Signal(
        name="solver_status",
        unit="1",
        kind="enumeration",
        type="SolverStatus",
        depends=_TORQUES,
        help="how the last step was solved",
    ),
)


def _plug(name: str, kind: str, text: str, **members: str) -> Terminal:
    """Return a terminal: torques flow in, all else are signals; ``members``: their variables."""
    found = tuple((v, m, "inflow" if m == "tau" else "signal") for m, v in members.items())
    return Terminal(name=name, kind=f"thrustwasher.{kind}", help=text, members=found)


def _pack_plug(pack: str) -> Terminal:
    text = f"Slip speed and load of the {pack} out, its torque in"
    return _plug(
        pack, "PackFlange", text, w=f"{pack}_speed", tau=f"{pack}_torque", load=f"{pack}_load"
    )


# An upshift, from row to row: the brake lets go while the clutch takes over and locks.
_COURSE = (
    (0.0, 0.0, 400.0, 0.05, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.2, 0.0, 400.0, 0.05, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.5, 150.0, 0.0, 0.05, 0.2, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.7, 300.0, 0.0, 0.05, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (1.0, 300.0, 0.0, 0.05, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
)

SPEC = ModelSpec(
    key="transmission",
    name="ShiftTransmission",
    help="Planetary set with engine, load, clutch and brake: speeds, lock-up and the energy book",
    params=TransmissionParams,
    fidelities={"rigid": "rigid gears, lock-up located inside the step"},
    default_fidelity="rigid",
    inputs=INPUTS,
    outputs=OUTPUTS,
    kernel="thrustwasher.transmission.kernels.step",
    rules=RULES,
    terminals=(
        *map(_pack_plug, ("clutch", "brake")),
        _plug(
            "mesh",
            "MeshFlange",
            "Speed and torque of a planet in the sun mesh out, its friction torque in",
            w="mesh_speed",
            tau="mesh_torque",
            load="mesh_load",
        ),
        _plug(
            "washer",
            "WasherFlange",
            "Speed, load and tilt of one washer out, its torque in",
            w="washer_speed",
            tau="washer_torque",
            load="washer_load",
            tilt="washer_tilt",
        ),
        _plug(
            "input_shaft",
            "ShaftFlange",
            "Speed of the engine out, its torque in",
            w="engine_speed",
            tau="engine_torque_input",
        ),
        _plug(
            "output_shaft",
            "ShaftFlange",
            "Speed of the vehicle at the output out, its torque against it in",
            w="vehicle_speed",
            tau="load_torque_input",
        ),
    ),
    course=_COURSE,
)
