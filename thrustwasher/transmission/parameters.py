"""Parameters, inputs and outputs of the shift transmission: the one list of all interfaces."""

from dataclasses import dataclass

from ..model.parameters import check_ranges, check_rules, choice, count, flag, quantity
from ..model.spec import ModelSpec, Rule, Signal, Terminal, output

COUPLING = {
    "capacity": "the packs send the torque they can hold; stick and slip are decided in here",
    "torque": "the packs send their friction torque: the plain loop, limited in step size",
}


def _planet_teeth(p: "TransmissionParams") -> str:
    return (
        f"planet_teeth = {p.planet_teeth!r}, allowed: half of ring_teeth - sun_teeth, within one "
        f"tooth (here {0.5 * (p.ring_teeth - p.sun_teeth):g}), or 0"
    )


RULES = (
    Rule("ring_teeth = {ring_teeth}, allowed: above sun_teeth ({sun_teeth})"),
    Rule("planet_teeth = {planet_teeth}, allowed: half of ring_teeth - sun_teeth ({ring_teeth} - "
         "{sun_teeth}), within one tooth, or 0", _planet_teeth),
    Rule("shaft_damping = {shaft_damping} N.m.s/rad, allowed: 0 with a rigid shaft "
         "(shaft_stiffness = 0)"),
    Rule("initial_twist = {initial_twist} rad, allowed: 0 with a rigid shaft "
         "(shaft_stiffness = 0)"),
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class TransmissionParams:
    """One planetary set with engine at the sun, drum at the ring and output at the carrier.

    The brake holds the ring (first gear, ratio 1 + z_r/z_s), the clutch locks sun to ring (second
    gear, ratio 1). A stiffness puts a spring and a damper between carrier and vehicle; the load
    then acts on the vehicle. All defaults are engineering estimates of a car-sized set.
    """

    sun_teeth: int = count(30, 1, 1000, "teeth of the sun gear")
    planet_teeth: int = count(18, 0, 1000, "teeth of a planet (0: half of ring minus sun)")
    ring_teeth: int = count(66, 2, 2000, "teeth of the ring gear")
    planets: int = count(4, 1, 24, "number of planets on the carrier")
    normal_module: float = quantity(1.5e-3, "m", 1e-4, 0.05, "normal module of the gears")
    helix_angle: float = quantity(0.3490658503988659, "rad", 0.0, 0.8, "helix angle at the pitch")
    sun_inertia: float = quantity(0.25, "kg.m2", 1e-6, 1e4, "inertia of engine and sun")
    carrier_inertia: float = quantity(
        8.0, "kg.m2", 1e-6, 1e6, "inertia of the carrier, with a rigid shaft also of the vehicle"
    )
    ring_inertia: float = quantity(0.01, "kg.m2", 0.0, 1e4, "inertia of ring and drum (0 allowed)")
    initial_engine_speed: float = quantity(350.0, "rad/s", -5e3, 5e3, "engine speed at the start")
    initial_ring_speed: float = quantity(0.0, "rad/s", -5e3, 5e3, "ring speed at the start")
    engine_torque: float = quantity(150.0, "N.m", -1e5, 1e5, "engine torque once it is on")
    engine_start_time: float = quantity(0.0, "s", -1e9, 1e9, "time the engine torque is turned on")
    load_torque: float = quantity(250.0, "N.m", 0.0, 1e6, "load torque at load_speed, grows as w^2")
    load_speed: float = quantity(100.0, "rad/s", 1e-3, 1e4, "output speed load_torque belongs to")
    clutch_force: float = quantity(5898.0, "N", 0.0, 1e6, "clutch load at shift_command = 1")
    brake_force: float = quantity(5898.0, "N", 0.0, 1e6, "brake load at shift_command = 0")
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

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.dynamics import broken_rule

        check_rules(self, RULES, broken_rule)


def _torque(name: str, text: str) -> Signal:
    return Signal(name=name, unit="N.m", help=text, low=-1e6, high=1e6, nominal=100.0, start=0.0)


INPUTS = (
    _torque("clutch_torque", "clutch's torque capacity (coupling torque: friction torque)"),
    _torque("brake_torque", "brake's torque capacity (coupling torque: friction torque)"),
    _torque("washer_torque", "friction torque of one thrust washer"),
    _torque("mesh_torque", "friction torque of one sun mesh, referred to the planet"),
    Signal(name="shift_command", unit="1", help="0 first gear, 1 second gear, at the step's end",
           low=0.0, high=1.0, nominal=1.0, start=0.0),
)  # fmt: skip
_TORQUES = tuple(signal.name for signal in INPUTS[:4])
_PACKS = _TORQUES[:2]  # drag decides only who holds a clutch beyond its capacity, not how much
_COMMAND = ("shift_command",)

OUTPUTS = (
    output("clutch_load", "N", 5e3, "axial force on the clutch pack", _COMMAND),
    output("clutch_speed", "rad/s", 100.0, "slip of the clutch, sun minus ring"),
    output("brake_load", "N", 5e3, "axial force on the brake pack", _COMMAND),
    output("brake_speed", "rad/s", 100.0, "slip of the brake, speed of the ring"),
    output("washer_load", "N", 100.0, "axial load on one thrust washer", _TORQUES),
    output("washer_speed", "rad/s", 100.0, "speed of a planet on its pin"),
    output("washer_tilt", "rad", 1e-3, "tilt of a planet against the carrier"),
    output("mesh_load", "N.m", 10.0, "torque of one planet in the sun mesh", _TORQUES),
    output("mesh_speed", "rad/s", 100.0, "speed of a planet against the carrier"),
    output("engine_speed", "rad/s", 100.0, "speed of engine and sun"),
    output("output_speed", "rad/s", 100.0, "speed of carrier and output"),
    output("ring_speed", "rad/s", 100.0, "speed of ring and drum"),
    output("drive_torque", "N.m", 100.0, "torque of the engine now"),
    output("resistance_torque", "N.m", 100.0, "torque of the load now"),
    output("clutch_reaction", "N.m", 100.0, "torque the clutch really transmits", _PACKS),
    output("brake_reaction", "N.m", 100.0, "torque the brake really holds", _TORQUES),
    output("sun_torque", "N.m", 100.0, "torque in the sun's teeth", _TORQUES),
    output("drag_torque", "N.m", 1.0, "drag of all washers and meshes at the sun", _TORQUES),
    output("tooth_force", "N", 1e3, "tangential force in one mesh", _TORQUES),
    output("tilting_couple", "N.m", 10.0, "couple of the axial tooth forces on a planet", _TORQUES),
    output("sun_thrust", "N", 1e3, "axial force on the sun gear", _TORQUES),
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
    output("shaft_torque", "N.m", 100.0, "torque of the output shaft (rigid: of the load)"),
    output("shaft_twist", "rad", 0.1, "twist of the output shaft, carrier before vehicle"),
    output("shaft_heat", "J", 100.0, "heat of the shaft's damping since the start"),
    output("shaft_energy", "J", 100.0, "energy the shaft's spring gained since the start"),
    Signal(name="clutch_locked", unit="1", kind="boolean", depends=_TORQUES,
           help="the clutch sticks, its slip is exactly zero",
           events=("clutch locked", "clutch broke away")),
    Signal(name="brake_locked", unit="1", kind="boolean", depends=_TORQUES,
           help="the brake sticks, the ring stands still",
           events=("brake locked", "brake broke away")),
    Signal(name="events", unit="1", kind="integer",
           help="lock-ups and break-aways located so far"),
    Signal(name="solver_status", unit="1", kind="enumeration", type="SolverStatus",
           depends=_TORQUES, help="how the last step was solved"),
)  # fmt: skip

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
        *(Terminal(name=pack, kind="thrustwasher.PackFlange",
                   help=f"Slip speed and load of the {pack} out, its torque in",
                   members=((f"{pack}_speed", "w", "signal"), (f"{pack}_torque", "tau", "inflow"),
                            (f"{pack}_load", "load", "signal")))
          for pack in ("clutch", "brake")),
        Terminal(name="mesh", kind="thrustwasher.MeshFlange",
                 help="Speed and torque of a planet in the sun mesh out, its friction torque in",
                 members=(("mesh_speed", "w", "signal"), ("mesh_torque", "tau", "inflow"),
                          ("mesh_load", "load", "signal"))),
        Terminal(name="washer", kind="thrustwasher.WasherFlange",
                 help="Speed, load and tilt of one washer out, its torque in",
                 members=(("washer_speed", "w", "signal"), ("washer_torque", "tau", "inflow"),
                          ("washer_load", "load", "signal"), ("washer_tilt", "tilt", "signal"))),
    ),
    # An upshift: the brake lets go while the clutch takes over and locks.
    course=((0.0, 0.0, 400.0, 0.05, 0.2, 0.0), (0.2, 0.0, 400.0, 0.05, 0.2, 0.0),
            (0.5, 150.0, 0.0, 0.05, 0.2, 0.6), (0.7, 300.0, 0.0, 0.05, 0.2, 1.0),
            (1.0, 300.0, 0.0, 0.05, 0.2, 1.0)),
)  # fmt: skip
