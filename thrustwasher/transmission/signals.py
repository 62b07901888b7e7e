"""Inputs, outputs and plugs of the shift transmission, and a profile to try it with."""

from dataclasses import replace
from itertools import chain

from ..model.spec import Signal, Terminal, output


def _input(name: str, unit: str, text: str, low: float, high: float, nominal: float) -> Signal:
    return Signal(name=name, unit=unit, help=text, low=low, high=high, nominal=nominal, start=0.0)


def _torque(name: str, text: str) -> Signal:
    return _input(name, "N.m", text, -1e6, 1e6, 100.0)


def _pressure(pack: str) -> Signal:
    text = f"pressure of the {pack} in addition to its profile, at the step's end"
    return _input(f"{pack}_pressure", "Pa", text, 0.0, 1e8, 1e5)


LOSSES = {
    "input": "the input shaft",
    "drum": "the drum",
    "output": "the output shaft",
    "planet": "one planet",
}


def _loss(shaft: str, words: str) -> Signal:
    text = f"loss torque of bearings, oil, pump and seals at {words}; only its size counts"
    return replace(_torque(f"{shaft}_loss_torque", text), late=True)


_FRICTION = {
    "clutch_torque": "clutch's torque capacity (coupling torque: friction torque)",
    "brake_torque": "brake's torque capacity (coupling torque: friction torque)",
    "washer_torque": "friction torque of one thrust washer",
    "mesh_torque": "friction torque of one sun mesh, referred to the planet",
}
INPUTS = (
    *(_torque(name, text) for name, text in _FRICTION.items()),
    _input("shift_command", "1", "0 first gear, 1 second gear, at the step's end", 0.0, 1.0, 1.0),
    *map(_pressure, ("clutch", "brake")),
    _torque("engine_torque_input", "torque of an engine model, in addition to the engine's own"),
    _torque(
        "load_torque_input",
        "torque of a vehicle model against the output, in addition to the load's",
    ),
    _torque("ring_mesh_torque", "friction torque of one ring mesh, referred to the planet"),
    *(_loss(shaft, words) for shaft, words in LOSSES.items()),
)
_ENGINE, _LOAD = ("engine_torque_input",), ("load_torque_input",)
_LOSSES = tuple(f"{shaft}_loss_torque" for shaft in LOSSES)
_TORQUES = (*_ENGINE, *_LOAD, *_FRICTION, "ring_mesh_torque", *_LOSSES)


def _without(*left_out: str) -> tuple[str, ...]:
    return tuple(name for name in _TORQUES if name not in left_out)


# Drag decides only who holds a clutch beyond its capacity, not how much.
_SHAFTS = tuple(name for name in _LOSSES if name != "planet_loss_torque")
_PACKS = ("clutch_torque", "brake_torque", *_ENGINE, *_LOAD, *_SHAFTS)
_HELD = _without("drum_loss_torque")  # a held drum has none
_PRESSED = {pack: ("shift_command", f"{pack}_pressure") for pack in ("clutch", "brake")}


def _flag(
    name: str, text: str, events: str, depends: tuple[str, ...], instants: tuple[str, str]
) -> Signal:
    rises, _, falls = events.partition(", ")
    return Signal(
        name=name,
        unit="1",
        kind="boolean",
        help=text,
        depends=depends,
        events=(rises, falls),
        instants=instants,
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
    events, instants = f"{pack} filled, {pack} empties", (f"{pack}_filled_time", "")
    return _flag(f"{pack}_filled", text, events, (f"{pack}_pressure",), instants)


OUTPUTS = (
    output("clutch_load", "N", 5e3, "axial force on the clutch pack", _PRESSED["clutch"]),
    output("clutch_speed", "rad/s", 100.0, "slip of the clutch, driven gear minus drum"),
    output("brake_load", "N", 5e3, "axial force on the brake pack", _PRESSED["brake"]),
    output("brake_speed", "rad/s", 100.0, "slip of the brake, speed of the drum"),
    output("washer_load", "N", 100.0, "axial load on one thrust washer", _TORQUES),
    output("washer_speed", "rad/s", 100.0, "speed of a planet on its pin"),
    output("washer_tilt", "rad", 1e-3, "tilt of a planet against the carrier", _TORQUES),
    output("mesh_load", "N.m", 10.0, "torque of one planet in its sun and its ring mesh", _TORQUES),
    output("mesh_speed", "rad/s", 100.0, "speed of a planet against the carrier"),
    output("engine_speed", "rad/s", 100.0, "speed of engine and driven gear"),
    output("output_speed", "rad/s", 100.0, "speed of carrier and output"),
    output("drum_speed", "rad/s", 100.0, "speed of drum and braked gear"),
    output("drive_torque", "N.m", 100.0, "engine torque at this instant", _ENGINE),
    output("resistance_torque", "N.m", 100.0, "load torque at this instant", _LOAD),
    output("clutch_reaction", "N.m", 100.0, "transmitted torque of the clutch", _PACKS),
    output("brake_reaction", "N.m", 100.0, "transmitted torque of the brake", _HELD),
    output("input_tooth_torque", "N.m", 100.0, "torque in the driven gear's teeth", _TORQUES),
    output(
        "drag_torque",
        "N.m",
        1.0,
        "drag of washers and meshes at the driven gear",
        _without("planet_loss_torque"),
    ),
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
    output("energy_residual", "J", 1.0, "energy that the balance cannot account for"),
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
        ("lock_time", ""),
    ),
    _flag(
        "brake_locked",
        "the brake sticks, the drum stands still",
        "brake locked, brake broke away",
        _TORQUES,
        ("", "release_time"),
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
    output(
        "advised_step",
        "s",
        1e-3,
        "step over which torques of slipping packs are off by 1 %, by the last one (0: none yet)",
        low=0.0,
    ),
    output("loss_power", "W", 100.0, "heat of the loss torques, mean of the step", _LOSSES),
    output("loss_heat", "J", 1e4, "heat of the loss torques since the start"),
)


def _plug(name: str, kind: str, text: str, flow: str = "inflow", **members: str) -> Terminal:
    """Return a terminal; ``members``: their variables.

    A torque flows in or out as ``flow`` says, all else are signals.
    """
    found = tuple((v, m, flow if m.startswith("tau") else "signal") for m, v in members.items())
    return Terminal(name=name, kind=f"thrustwasher.{kind}", help=text, members=found)


def _pack_plug(pack: str) -> Terminal:
    text = f"Slip speed and load of the {pack} out, its torque in"
    return _plug(
        pack, "PackFlange", text, w=f"{pack}_speed", tau=f"{pack}_torque", load=f"{pack}_load"
    )


TERMINALS = (
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
        "ring_mesh",
        "MeshFlange",
        "Speed and torque of a planet in the ring mesh out, its friction torque in",
        w="mesh_speed",
        tau="ring_mesh_torque",
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
        "losses",
        "LossFlange",
        "Speeds of shafts and planets, force of a mesh out, loss torques in",
        w_input="engine_speed",
        w_drum="drum_speed",
        w_output="output_speed",
        w_planet="mesh_speed",
        force="tooth_force",
        tau_input="input_loss_torque",
        tau_drum="drum_loss_torque",
        tau_output="output_loss_torque",
        tau_planet="planet_loss_torque",
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
        "Speed of the vehicle at the output out, torque that the vehicle takes in",
        "outflow",
        w="vehicle_speed",
        tau="load_torque_input",
    ),
)

_LOST = (3.0, 0.1, 1.0, 0.02)  # what losses take from input, drum, output and planet
# An upshift, from row to row: the brake lets go while the clutch takes over and locks.
PROFILE = (
    (0.0, 0.0, 400.0, 0.05, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *_LOST),
    (0.2, 0.0, 400.0, 0.05, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *_LOST),
    (0.5, 150.0, 0.0, 0.05, 0.2, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, *_LOST),
    (0.7, 300.0, 0.0, 0.05, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, *_LOST),
    (1.0, 300.0, 0.0, 0.05, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, *_LOST),
)
