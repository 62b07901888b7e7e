"""Parameters of the shift transmission; with ``signals`` the one list of all interfaces."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
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
from ..model.spec import ModelSpec, Rule
from .bearings import BEARINGS, bearing_fields, rubbing, two_ends
from .signals import INPUTS, OUTPUTS, PROFILE, TERMINALS

ARRANGEMENT = {
    "sun-input": "the sun is driven, the brake holds the ring: first gear 1 + z_r/z_s",
    "ring-input": "the ring is driven, the brake holds the sun: first gear 1 + z_s/z_r",
}
ACTUATION = {
    "command": "shift_command moves the load from the brake to the clutch",
    "pressure": "pistons press the packs: profiles of pressure and pressure inputs",
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


PROFILES = {  # of points in time; what is out of use next to the engine's: its constant torque
    "clutch_pressure": ("Pa", 0.0, 1e8, "pressure of the clutch"),
    "brake_pressure": ("Pa", 0.0, 1e8, "pressure of the brake"),
    "engine_torque": ("N.m", -1e5, 1e5, "engine torque"),
}
POINTS = 10  # of a profile at most
# What lets other parameters be read.
NO_POINTS = (("engine_torque_points", 0),)
WITH_HEAD = (("piston_outer_radius", ">", 0.0),)
HELICAL = (("helix_angle", ">", 0.0),)
NO_NEEDLES, NEEDLES = (("needle_count", 0),), (("needle_count", ">", 0),)


def profile_fields(name: str, points: Sequence[tuple[float, float]]) -> dict[str, float]:
    """Return the parameters of a profile of points (time [s], value in SI units).

    ParameterError if there are none or too many.
    """
    if not 1 <= len(points) <= POINTS:
        raise ParameterError(f"{name}: {len(points)} points, allowed: 1 .. {POINTS}")
    times = {f"{name}_time_{i}": t for i, (t, _) in enumerate(points, 1)}
    values = {f"{name}_{i}": x for i, (_, x) in enumerate(points, 1)}
    return {f"{name}_points": len(points), **times, **values}


def profile_points(params: object, name: str) -> list[tuple[float, float]]:
    """Return the points of a profile: time [s] and value."""
    return [
        (getattr(params, f"{name}_time_{i}"), getattr(params, f"{name}_{i}"))
        for i in range(1, getattr(params, f"{name}_points") + 1)
    ]


def _order(name: str) -> Rule:
    text = f"{name}_time_2 = {{{name}_time_2}} s, allowed: rising from point to point"
    return Rule(text, partial(_not_rising, name))


def _not_rising(name: str, p: object) -> str:
    times = [t for t, _ in profile_points(p, name)]
    i, a, b = next((i, a, b) for i, (a, b) in enumerate(pairwise(times), 2) if not b > a)
    return f"{name}_time_{i} = {b!r} s, allowed: above the time of the point before ({a!r} s)"


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
    *map(_order, PROFILES),
    *map(two_ends, BEARINGS),
    *map(rubbing, BEARINGS),
)


def _piston(pack: str) -> dict[str, Any]:
    its = f"the {pack}'s"
    pressed = (("actuation", "pressure"),)
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
    by = {"fill_flow": ((f"{pack}_fill_volume", ">", 0.0),)}
    return {
        f"{pack}_{name}": quantity(*about, read_by=by.get(name, pressed))
        for name, about in given.items()
    }


def _profile(
    name: str, unit: str, low: float, high: float, text: str, **more: Any
) -> dict[str, Any]:
    """Return the parameters of a profile; one point alone holds at all times."""
    time, value = f"{text}: time of point", f"{text}: value of point"
    n, points = range(1, POINTS + 1), f"{name}_points"
    return {
        points: count(
            0,
            0,
            POINTS,
            f"number of points of the {text} over time, which counts from the run's start",
            **more,
        ),
        **{
            f"{name}_time_{i}": quantity(
                0.0,
                "s",
                -1e6,
                1e6,
                f"{time} {i}",
                read_by=((points, ">=", max(i, 2)),),
                instant=True,
            )
            for i in n
        },
        **{
            f"{name}_{i}": quantity(
                0.0, unit, low, high, f"{value} {i}", read_by=((points, ">=", i),)
            )
            for i in n
        },
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
    engine_torque: float = quantity(
        150.0, "N.m", -1e5, 1e5, "engine torque once it is on", read_by=NO_POINTS
    )
    engine_start_time: float = quantity(
        0.0,
        "s",
        -1e9,
        1e9,
        "time the engine torque is turned on, from the run's start",
        read_by=NO_POINTS,
        instant=True,
    )
    load_torque: float = quantity(250.0, "N.m", 0.0, 1e6, "load torque at load_speed, grows as w^2")
    load_speed: float = quantity(100.0, "rad/s", 1e-3, 1e4, "output speed load_torque belongs to")
    clutch_force: float = _force("clutch load at shift_command = 1")
    brake_force: float = _force("brake load at shift_command = 0")
    washers: int = count(8, 0, 100, "number of thrust washers on all planets together")
    washer_radius: float = quantity(
        0.0085, "m", 1e-3, 1.0, "radius the washer's load acts at", read_by=HELICAL
    )
    thrust_share: float = quantity(
        0.1,
        "1",
        0.0,
        1.0,
        "share of tilting couple washers take",
        read_with=(*NO_NEEDLES, *HELICAL),
    )
    planet_tilt: float = quantity(
        1.6e-3, "rad", 0.0, 0.01, "tilt of a planet on its pin", read_by=NO_NEEDLES
    )
    oil_temperature: float = quantity(297.15, "K", 233.15, 473.15, "temperature of the sump oil")
    coupling: str = choice("capacity", COUPLING, "Coupling", "what the packs' torque inputs carry")
    capacity_extrapolation: bool = flag(
        True,
        "capacities go on changing as in the step before",
        read_by=(("coupling", "capacity"),),
    )
    torque_age: int = count(
        0,
        0,
        2,
        "steps the received torques are old (1: parallel master)",
        read_by=(("capacity_extrapolation", True),),
    )
    tolerance: float = quantity(1e-11, "1", 1e-13, 1e-4, "relative error of the inner integration")
    shaft_stiffness: float = quantity(0.0, "N.m/rad", 0.0, 1e9, "output shaft (0: rigid)")
    shaft_damping: float = quantity(0.0, "N.m.s/rad", 0.0, 1e6, "damping of the output shaft")
    vehicle_inertia: float = quantity(
        8.0,
        "kg.m2",
        1e-6,
        1e6,
        "inertia behind an elastic shaft",
        read_by=(("shaft_stiffness", ">", 0.0),),
    )
    initial_twist: float = quantity(0.0, "rad", -10.0, 10.0, "twist of the shaft at the start")
    actuation: str = choice("command", ACTUATION, "Actuation", "what presses the packs")
    piston_inner_radius: float = quantity(
        0.0, "m", 0.0, 1.0, "of the clutch's piston, which turns with the drum", read_by=WITH_HEAD
    )
    piston_outer_radius: float = quantity(
        0.0,
        "m",
        0.0,
        1.0,
        "of the clutch's piston (0: no centrifugal head)",
        read_by=(("actuation", "pressure"),),
    )
    piston_supply_radius: float = quantity(
        0.0, "m", 0.0, 1.0, "where oil enters the turning piston", read_by=WITH_HEAD
    )
    balance_share: float = quantity(
        0.0, "1", 0.0, 1.0, "share of the head a balance chamber takes", read_by=WITH_HEAD
    )
    oil_density: float = quantity(
        850.0, "kg/m3", 500.0, 1500.0, "density of the oil in the piston", read_by=WITH_HEAD
    )
    rolling_torque: float = quantity(0.0, "N.m", 0.0, 1e6, "load against the motion at any speed")
    grade_torque: float = quantity(0.0, "N.m", -1e6, 1e6, "load at any speed and rest, of a slope")
    ring_mesh: bool = flag(
        False, "ring_mesh_torque is the ring meshes' loss (False: mesh_torque stands for both)"
    )
    needle_count: int = count(0, 0, 100, "needles under a planet (0: thrust_share, planet_tilt)")
    needle_length: float = quantity(
        0.02, "m", 1e-3, 1.0, "length of a needle, both rows together", read_by=NEEDLES
    )
    needle_clearance: float = quantity(
        15e-6, "m", 0.0, 1e-3, "radial clearance of the needles", read_by=NEEDLES
    )
    needle_slices: int = count(
        10, 1, 50, "slices of a needle that are pressed apart", read_by=NEEDLES
    )
    planet_mass: float = quantity(
        0.1, "kg", 0.0, 1e4, "of a planet, which its needles hold", read_by=NEEDLES
    )
    washer_outer_radius: float = quantity(
        0.0115, "m", 1e-3, 1.0, "where a tilted planet touches", read_by=NEEDLES
    )
    end_play: float = quantity(
        3e-4, "m", 0.0, 0.1, "of a planet between its washers, in all", read_by=NEEDLES
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
for _name, _about in PROFILES.items():
    _pressed: dict[str, Any] = {"read_by": (("actuation", "pressure"),)}
    _MORE |= _profile(_name, *_about, **({} if _name == "engine_torque" else _pressed))
TransmissionParams = other_names(extended(_TransmissionParams, "TransmissionParams", _MORE))


SPEC = ModelSpec(
    key="transmission",
    name="ShiftTransmission",
    help="Planetary set with engine, load, clutch and brake: speeds, lock-up and the energy "
    "balance",
    params=TransmissionParams,
    fidelities={"rigid": "rigid gears, lock-up located inside the step"},
    default_fidelity="rigid",
    inputs=INPUTS,
    outputs=OUTPUTS,
    kernel="thrustwasher.transmission.kernels.step",
    rules=RULES,
    terminals=TERMINALS,
    profile=PROFILE,
)
