"""The list of key figures: name, what it says, unit. Values come from ``key_figures``.

``{pack}`` stands for the pack that engages, ``{other}`` for the one that lets go.
"""

from typing import NamedTuple

# [rad/s] of a planet on its pin. A film vanishes with speed: its least ratio is looked for above
# this speed only, else it would be that of the last sample before standstill.
FILM_SPEED = 10.0


class Figure(NamedTuple):
    """What a key figure says; ``difference``: of temperatures, no absolute temperature."""

    text: str
    unit: str
    difference: bool = False


class KeyFigure(NamedTuple):
    """A key figure of a run: value in SI units, None where there is no such thing, and its time."""

    name: str
    text: str
    unit: str
    value: float | None
    time: float | None
    difference: bool


# name -> (value, time [s] it belongs to)
Found = dict[str, tuple[float | None, float | None]]

FIGURES: dict[str, Figure] = {
    "release_time": Figure("{other} lets go", "s"),
    "lock_time": Figure("{pack} locks", "s"),
    "lock_after_ramp_start": Figure("{pack} locks, after the shift began", "s"),
    "lock_after_half_ramp": Figure("{pack} locks, after the middle of the ramp", "s"),
    "lock_speed": Figure("engine speed at lock-up", "rad/s"),
    "greatest_slip": Figure("greatest slip of the {pack}", "rad/s"),
    "slip_energy": Figure("heat in the {pack}", "J"),
    "slip_energy_per_area": Figure("heat in the {pack} per area of lining", "J/m2"),
    "stopped_inertia": Figure("inertia brought to rest, from heat and speed", "kg.m2"),
    "peak_power": Figure("{pack}, greatest power", "W"),
    "friction_start": Figure("{pack}'s friction coefficient, slip begins", "1"),
    "friction_middle": Figure("{pack}'s friction coefficient, half the slip", "1"),
    "friction_lock": Figure("{pack}'s friction coefficient, before lock-up", "1"),
    "friction_mean": Figure("{pack}'s mean friction coefficient, of torque over time", "1"),
    "full_friction_speed": Figure("slip below which friction is full", "rad/s"),
    "clutch_heat_per_area": Figure("clutch, heat per area of lining", "J/m2"),
    "peak_clutch_heat_flux": Figure("clutch, greatest heat flux into a face", "W/m2"),
    "peak_clutch_temperature": Figure("clutch, interface at most", "K"),
    "peak_clutch_torque": Figure("clutch, greatest torque", "N.m"),
    "least_clutch_film_ratio": Figure("clutch, least film ratio", "1"),
    "clutch_viscous_share": Figure("clutch, share of heat made in the oil", "1"),
    "clutch_oil_heat": Figure("clutch, heat that went into the oil", "J"),
    "clutch_stored_heat": Figure("clutch, heat left in the plates at the end", "J"),
    "brake_heat_per_area": Figure("brake, heat per area of lining", "J/m2"),
    "peak_brake_heat_flux": Figure("brake, greatest heat flux into a face", "W/m2"),
    "peak_brake_temperature": Figure("brake, interface at most", "K"),
    "peak_brake_torque": Figure("brake, greatest torque", "N.m"),
    "least_brake_film_ratio": Figure("brake, least film ratio", "1"),
    "brake_viscous_share": Figure("brake, share of heat made in the oil", "1"),
    "brake_oil_heat": Figure("brake, heat that went into the oil", "J"),
    "brake_stored_heat": Figure("brake, heat left in the plates at the end", "J"),
    "tie_up_duration": Figure("both packs against each other, for", "s"),
    "tie_up_torque": Figure("{other}, greatest torque against the {pack}", "N.m"),
    "tie_up_heat": Figure("{other}, heat while both work against each other", "J"),
    "filled_time": Figure("{pack}'s piston is full", "s"),
    "torque_phase": Figure("torque phase, from the kiss point to where the {other} is free", "s"),
    "inertia_phase": Figure("inertia phase, from there to lock-up", "s"),
    "peak_jerk": Figure("vehicle, greatest change of acceleration over 10 ms", "m/s3"),
    "torque_hole": Figure("vehicle, least acceleration below that after the shift", "m/s2"),
    "flare": Figure("engine, greatest speed above that of first gear", "rad/s"),
    "judder_frequency": Figure("shaft torque swings at", "Hz"),
    "judder_mode_frequency": Figure("the same, from the driveline's eigenvalue", "Hz"),
    "judder_growth": Figure("growth of the swing (below 0: it decays)", "1/s"),
    "judder_mode_growth": Figure("the same, from the driveline's eigenvalue", "1/s"),
    "judder_step_growth": Figure("growth that the communication step adds", "1/s"),
    "judder_amplitude": Figure("greatest swing of the shaft torque about its mean", "N.m"),
    "judder_slope": Figure("change of the pack's torque over its slip", "N.m.s/rad"),
    "judder_damping": Figure("damping of the output shaft", "N.m.s/rad"),
    "judder_limit_damping": Figure("damping below which the swing grows", "N.m.s/rad"),
    "peak_sun_thrust": Figure("greatest thrust of the sun", "N"),
    "peak_washer_load": Figure("washer, greatest load", "N"),
    "peak_washer_temperature": Figure("washer, mean film at most", "K"),
    "peak_washer_temperature_max": Figure("washer, hottest spot", "K"),
    "least_washer_film_ratio": Figure(
        f"washer, least film ratio above {FILM_SPEED:g} rad/s of the planet", "1"
    ),
    "washer_distress_time": Figure("time with the washers' film lost", "s"),
    "peak_mesh_load": Figure("mesh, greatest torque of a planet", "N.m"),
    "peak_flash_temperature": Figure("mesh, asperities at most", "K"),
    "peak_flash_rise": Figure("mesh, greatest flash rise", "K", True),
    "peak_mesh_temperature": Figure("mesh, tooth surface at most", "K"),
    "least_mesh_film_ratio": Figure(
        f"mesh, least film ratio above {FILM_SPEED:g} rad/s of the planet", "1"
    ),
    "peak_mesh_stress": Figure("mesh, greatest contact stress", "Pa"),
    "peak_mesh_thermal_stress": Figure("mesh, greatest thermal stress", "Pa"),
    "least_allowable_ratio": Figure("mesh, least allowable ratio of stress", "1"),
    "stress_margin_aisi1020": Figure("mesh, least stress margin of AISI 1020", "1"),
    "stress_margin_aisi4340": Figure("mesh, least stress margin of AISI 4340", "1"),
    "least_pitting_safety": Figure("meshes, least safety against pitting", "1"),
    "least_scuffing_safety": Figure("meshes, least safety against scuffing", "1"),
    "mesh_loss": Figure("heat of all meshes", "J"),
}


def assemble(found: Found, pack: str, other: str) -> list[KeyFigure]:
    """Return the figures that were found, in the order of the list, in words for these packs."""
    return [
        KeyFigure(
            name, f.text.format(pack=pack, other=other), f.unit, *found[name], f.difference
        )
        for name, f in FIGURES.items()
        if name in found
    ]  # fmt: skip
