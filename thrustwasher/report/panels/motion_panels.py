"""Panels over time: speeds, torques, pressures, jerk, temperatures, energy, a swinging shaft."""

import numpy as np
from matplotlib.axes import Axes

from ..palette import BLACK, BLUE, CELSIUS, COLOURS, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..shift.heat_split import HeatSplit
from ..shift.shift_record import PACKS, Array, Record
from .panel_base import draw, draw_events, draw_phase_lines, draw_phases, finish, thin

LINING_LIMIT = 523.15  # [K] oil and lining fail above
WASHER_RISE = 200.0  # [K] mean rise above the oil at which the paper calls a washer distressed
JERK_TIME = 0.01  # s over which a change of acceleration counts


def elastic(record: Record) -> bool:
    """Return whether the output shaft twists; a rigid one only repeats carrier and load."""
    twist = record.series("transmission.shaft_twist")
    return twist is not None and bool(np.any(twist))


def draw_speeds(axis: Axes, record: Record) -> None:
    """Draw the speeds with phases shaded and events numbered; of a lone brake only the drum's."""
    draw_phases(axis, record, legend=True)
    lone_brake = record.alone and record.engaging == "brake"
    for name, words, colour, dashes in (
        ("transmission.engine_speed", "engine", BLUE, "-"),
        ("transmission.output_speed", "output (carrier)", GREEN, "-"),
        ("transmission.vehicle_speed", "vehicle", BLACK, ":"),
        ("transmission.drum_speed", "drum", PURPLE, "-"),
        ("transmission.clutch_speed", "clutch slip", RED, "--"),
        ("transmission.washer_speed", "planet on its pin", ORANGE, "-."),
    ):
        at_planets = "washer" in name
        if at_planets and not (record.part("washer") or record.part("mesh")):
            continue
        if "vehicle" in name and not elastic(record):
            continue
        if not lone_brake or "drum" in name:
            draw(axis, record, name, words, colour, dashes)
    draw_events(axis, record)
    finish(axis, _speed_title(record), "speed [rad/s]")


def _speed_title(record: Record) -> str:
    if record.alone:
        return f"Speed: the {record.engaging} brings it to rest"
    if not record.presses(record.releasing):
        return "Speeds"
    if record.engaging == "clutch":
        return "Speeds: the engine comes down to the output"
    return "Speeds: the engine goes up to its ratio"


def draw_torques(axis: Axes, record: Record) -> None:
    """Draw the large torques; one that is zero throughout is left out."""
    draw_phases(axis, record)
    for name, words, colour, dashes in (
        ("transmission.drive_torque", "engine", BLUE, "-"),
        ("transmission.clutch_reaction", "clutch", RED, "-"),
        ("clutch.torque_capacity", "clutch could hold", RED, ":"),
        ("transmission.brake_reaction", "brake", PURPLE, "-"),
        ("transmission.input_tooth_torque", "driven gear's teeth", GREY, "--"),
        ("transmission.resistance_torque", "load at the output", GREEN, "-"),
        ("transmission.shaft_torque", "output shaft", BLACK, "-"),
    ):
        values = record.series(name)
        hidden = (record.alone and "tooth" in name) or ("shaft" in name and not elastic(record))
        if values is not None and np.any(values != 0.0) and not hidden:
            draw(axis, record, name, words, colour, dashes)
    _draw_brake_capacity(axis, record)
    _draw_split(axis, record)
    pack, other = record.engaging, record.releasing
    words = f": the {pack} takes over from the {other}" if record.presses(other) else ""
    finish(axis, f"Torque of the {pack}" if record.alone else f"Torques{words}", "torque [N·m]")


def _draw_brake_capacity(axis: Axes, record: Record) -> None:
    """Draw what the brake could hold, on the side where it is needed."""
    held = record.series("transmission.brake_reaction")
    able = record.series("brake.torque_capacity")
    if held is None or able is None or not np.any(held):
        return
    side = -1.0 if -np.min(held) > np.max(held) else 1.0
    axis.plot(record.time, side * able, color=PURPLE, ls=":", label="brake could hold")


def _draw_split(axis: Axes, record: Record) -> None:
    """Draw what lining and oil each add to the torque of the engaging pack, where it is known."""
    pack = record.engaging
    for name, words, colour in (
        ("contact_torque", "in contact", ORANGE), ("viscous_torque", "in the oil", SKY),
    ):  # fmt: skip
        draw(axis, record, f"{pack}.{name}", f"{pack}'s friction {words}", colour, "-.", width=1.2)


def draw_drag(axis: Axes, record: Record) -> None:
    """Draw the small torques of one washer and of one gear mesh."""
    draw_phases(axis, record, words=False)
    draw(axis, record, "washer.friction_torque", "one thrust washer", ORANGE)
    draw(axis, record, "mesh.friction_torque", "one gear mesh", GREEN)
    finish(axis, "Drag at a planet", "torque [N·m]")


def draw_temperatures(axis: Axes, record: Record) -> None:
    """Draw the temperatures with the limits that are near."""
    draw_phases(axis, record)
    hottest = 1.0
    lines = [
        (f"{pack}.temperature", f"{pack} interface", COLOURS[pack], "-")
        for pack in PACKS if record.presses(pack)
    ]  # fmt: skip
    lines += [
        ("washer.temperature_max", "washer, hottest spot", ORANGE, ":"),
        ("washer.temperature", "washer, mean of the walls", ORANGE, "-"),
        ("mesh.temperature", "mesh, asperities", GREEN, ":"),
        ("mesh.surface_temperature", "mesh, tooth surface", GREEN, "-"),
        ("transmission.oil_supply_temperature", "oil", BLACK, "--"),
    ]
    for name, words, colour, dashes in lines:
        hottest = max(hottest, draw(axis, record, name, words, colour, dashes, zero=CELSIUS))
    limits = [("oil and lining fail", LINING_LIMIT, RED)]
    if record.series("washer.temperature") is not None:
        limits.append(("washer's mean: distress", record.oil_temperature + WASHER_RISE, ORANGE))
    for words, kelvin, colour in limits:
        far = kelvin - CELSIUS > 1.6 * hottest
        text = f"{words}: {kelvin - CELSIUS:.0f} °C" + (" (off scale)" if far else "")
        axis.axhline(np.nan if far else kelvin - CELSIUS, color=colour, lw=0.9, ls=(0, (1, 3)),
                     label=text)  # fmt: skip
    finish(axis, "Temperatures", "temperature [°C]")


def draw_energy(axis: Axes, record: Record) -> None:
    """Draw where the energy went as areas that fill up to what came in."""
    draw_phase_lines(axis, record)
    zero = np.zeros_like(record.time)

    def kilojoules(name: str) -> Array:
        values = record.series(f"transmission.{name}")
        return zero if values is None else values / 1e3

    parts = [
        (kilojoules(name), words, colour)
        for name, words, colour in (
            ("load_work", "work into the load", GREEN),
            ("clutch_heat", "heat in the clutch", RED),
            ("brake_heat", "heat in the brake", PURPLE),
            ("washer_heat", "heat in all washers", ORANGE),
            ("mesh_heat", "heat in all meshes", SKY),
            ("shaft_heat", "heat in the output shaft", GREY),
        )
    ]
    parts = [part for part in parts if np.any(part[0] != 0.0)]
    some = thin(record)
    if parts:
        axis.stackplot(record.time[some], *(p[0][some] for p in parts), lw=0, alpha=0.8,
                       labels=[p[1] for p in parts], colors=[p[2] for p in parts])  # fmt: skip
    # What the shaft's spring keeps counts as kinetic: it comes back.
    engine, kinetic = kilojoules("engine_work"), kilojoules("kinetic_change")
    kinetic = kinetic + kilojoules("shaft_energy")
    if np.any(engine):
        axis.plot(record.time, engine, color=BLUE, label="work of the engine")
        words = "engine, less kinetic energy gained" if kinetic[-1] > 0.0 else (
            "engine + kinetic energy given up"
        )  # fmt: skip
    else:
        words = "kinetic energy given up"
    axis.plot(record.time, engine - kinetic, color=BLACK, ls="--", lw=1.2, label=words)
    title = "Energy: the areas fill up to the dashed line if no joule is lost"
    finish(axis, title, "energy since the start [kJ]")


def draw_shaft(axis: Axes, record: Record) -> None:
    """Draw the torque of the shaft and of the load behind it."""
    draw_phases(axis, record)
    draw(axis, record, "transmission.shaft_torque", "output shaft", BLUE, width=1.0)
    draw(axis, record, "transmission.resistance_torque", "load at the vehicle", GREEN, "--")
    _mark(axis, record)
    finish(axis, "Torque of the output shaft", "torque [N·m]")


def draw_slip(axis: Axes, record: Record) -> None:
    """Draw the slip of the pack."""
    draw_phases(axis, record, words=False)
    pack = record.judder.pack
    draw(axis, record, f"transmission.{pack}_speed", pack, COLOURS[pack], width=1.0)
    _mark(axis, record)
    finish(axis, f"Slip of the {pack}", "slip [rad/s]")


def _mark(axis: Axes, record: Record) -> None:
    """Draw where the swing was judged."""
    for time in (record.judder.start, record.judder.end):
        axis.axvline(time, color=GREY, lw=0.9, ls="--")


def draw_acceleration(axis: Axes, record: Record) -> None:
    """Draw the acceleration of the vehicle."""
    draw_phases(axis, record)
    felt = (record.reach or 1.0) * record.signals["transmission.output_acceleration"]
    axis.plot(record.time, felt, color=GREEN, label="vehicle")
    finish(axis, "Acceleration of the vehicle", "acceleration [m/s²]")


def draw_jerk(axis: Axes, record: Record) -> None:
    """Draw the change of the vehicle's acceleration over the next 10 ms."""
    draw_phases(axis, record, words=False)
    felt = (record.reach or 1.0) * record.signals["transmission.output_acceleration"]
    change = np.interp(record.time + JERK_TIME, record.time, felt) - felt
    axis.plot(record.time, change / JERK_TIME, color=BLUE, lw=1.0, label="over the next 10 ms")
    finish(axis, "Jerk", "jerk [m/s³]")


def draw_pressures(axis: Axes, record: Record) -> None:
    """Draw the pressures at both pistons and the springs that they work against."""
    draw_phases(axis, record)
    gearbox = record.part("transmission")
    for pack in PACKS:
        pressure = record.signals[f"transmission.{pack}_piston_pressure"]
        axis.plot(record.time, pressure / 1e3, color=COLOURS[pack], label=f"{pack}'s piston")
        spring = getattr(gearbox.params(), f"{pack}_return_spring") if gearbox else 0.0
        axis.axhline(spring / 1e3, color=COLOURS[pack], lw=0.9, ls=":",
                     label=f"{pack}'s return spring")  # fmt: skip
    finish(axis, "Pressures", "pressure [kPa]")


def draw_pack_speeds(axis: Axes, record: Record) -> None:
    """Draw the speeds of both sides of the packs; slip is the difference."""
    draw_phases(axis, record, words=False)
    for name, words, colour, dashes in (
        ("brake_hub", "brake, hub", COLOURS["brake"], "-"),
        ("brake_drum", "brake, housing", COLOURS["brake"], "--"),
        ("clutch_hub", "clutch, hub", COLOURS["clutch"], "-"),
        ("clutch_drum", "clutch, drum", COLOURS["clutch"], "--"),
    ):
        draw(axis, record, f"transmission.{name}_speed", words, colour, dashes)
    finish(axis, "Speeds of both sides of the packs", "speed [rad/s]")


def draw_heat_split(axis: Axes, record: Record, split: HeatSplit) -> None:
    """Draw how much of a pack's heat is in its plates and how much in the oil."""
    draw_phases(axis, record)
    some, stored = thin(record), split.stored
    layers = [(split.to_oil, "in the oil", SKY)]
    layers += [] if stored is None else [(stored, "in the steel plates", ORANGE)]
    axis.stackplot(record.time[some], *(heat[some] / 1e3 for heat, *_ in layers), lw=0, alpha=0.8,
                   labels=[words for _, words, _ in layers],
                   colors=[colour for *_, colour in layers])  # fmt: skip
    axis.plot(record.time, split.made / 1e3, color=BLACK, ls="--", lw=1.2, label="made by friction")
    finish(axis, f"Heat of the {split.words}: where it is", "heat since the start [kJ]")


def draw_sump(axis: Axes, record: Record) -> None:
    """Draw the temperature of the oil in the sump."""
    draw_phases(axis, record, words=False)
    draw(axis, record, "sump.temperature", "oil in the sump", BLACK, zero=CELSIUS)
    axis.ticklabel_format(axis="y", useOffset=False)
    finish(axis, "Oil sump", "temperature [°C]")
