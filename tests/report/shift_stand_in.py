"""A made-up shift with the face of a real one: fast input for plots and pages."""

from __future__ import annotations

import numpy as np

from thrustwasher.model.registry import find_spec
from thrustwasher.report.shift.shift_record import Event, KeyFigure, Part, Phase, Record
from thrustwasher.shift.shift_result import Cost

UNITS = {
    "time": "s",
    "speed": "rad/s",
    "energy": "J",
    "area": "J/m2",
    "power": "W",
    "thrust": "N",
    "torque": "N.m",
    "temperature": "K",
    "max": "K",
}


def key_figures(values: dict[str, float | None]) -> list[KeyFigure]:
    """Return figures whose text and unit follow from their names."""
    return [
        KeyFigure(name, name.replace("_", " "), UNITS.get(name.split("_")[-1], "1"), value)
        for name, value in values.items()
    ]


def record(washer: bool = True, mesh: bool = False) -> Record:
    """Return a shift of 2.5 s: pressure ramp 0.1 to 0.4 s, lock-up at 1.75 s."""
    t = np.linspace(0.0, 2.5, 2501)
    command = np.clip((t - 0.1) / 0.3, 0.0, 1.0)
    done = np.clip((t - 0.25) / 1.5, 0.0, 1.0)
    slip = 350.0 * (1.0 - done)
    output = 109.0 - 10.0 * np.minimum(t / 1.75, 1.0)
    engine = np.where(t < 0.25, 350.0, output + (350.0 - 109.0) * (1.0 - done))
    capacity = 389.0 * command * (0.4 + 0.6 * done**3)
    locked = t >= 1.75
    reaction = np.where(locked, 160.0, capacity)
    dt = np.diff(t, prepend=0.0)
    s: dict[str, np.ndarray] = {
        "transmission.engine_speed": engine,
        "transmission.output_speed": output,
        "transmission.drum_speed": output - (engine - output) / 2.2,
        "transmission.clutch_speed": slip,
        "transmission.washer_speed": 401.0 * (1.0 - done),
        "transmission.drive_torque": np.full_like(t, 150.0),
        "transmission.resistance_torque": 250.0 * (output / 100.0) ** 2,
        "transmission.clutch_reaction": reaction,
        "transmission.brake_reaction": np.where(t < 0.25, 330.0 - 2 * reaction, 0.0),
        "transmission.input_tooth_torque": np.where(
            t < 0.25, 150.0 - reaction, 60.0 + 60 * done**3
        ),
        "transmission.oil_supply_temperature": np.full_like(t, 297.15),
        "clutch.torque_capacity": capacity,
        "clutch.speed": slip,
        "brake.torque_capacity": 389.0 * (1.0 - command),
        "clutch.temperature": 297.15 + 150.0 * done**0.7,
        "brake.temperature": np.full_like(t, 297.2),
        "clutch.film_ratio": 10.0 - 9.2 * command,
        "brake.film_ratio": 0.8 + 9.0 * command,
        "clutch.friction_power": capacity * slip,
        "brake.friction_power": np.zeros_like(t),
        "transmission.engine_work": np.cumsum(150.0 * engine * dt),
        "transmission.load_work": np.cumsum(250.0 * (output / 100.0) ** 2 * output * dt),
        "transmission.clutch_heat": np.cumsum(capacity * slip * dt),
        "transmission.brake_heat": np.zeros_like(t),
        "transmission.mesh_heat": np.zeros_like(t),
        "transmission.washer_heat": np.zeros_like(t),
    }
    if washer:
        load = 96.0 - 50.0 * np.sin(np.pi * np.clip(done, 0, 1))
        s |= {
            "transmission.washer_load": load,
            "transmission.washer_tilt": np.full_like(t, 1.6e-3),
            "washer.load": load,
            "washer.speed": 401.0 * (1.0 - done),
            "washer.tilt": np.full_like(t, 1.6e-3),
            "washer.oil_temperature": np.full_like(t, 297.15),
            "washer.friction_torque": 0.03 * (1.0 - done),
            "washer.temperature": 297.15 + 15.0 * (1.0 - done),
            "washer.temperature_max": 297.15 + 25.0 * (1.0 - done),
            "washer.film_ratio": 6.6 * (1.0 - done) + 0.3 * done,
            "washer.fluid_load_share": 1.0 - 0.9 * done**8,
            "washer.friction_power": 12.0 * (1.0 - done),
            "washer.oil_heat": 12.0 * (1.0 - done),
            "washer.oil_flow": 6e-7 * (1.0 - done),
            "washer.oil_outlet_temperature": 297.15 + 8.0 * (1.0 - done),
            "washer.stick_margin": 3.0 + 9.0 * done,
            "washer.distress": ((t > 0.3) & (t < 0.34)).astype(float),
        }
        s["transmission.washer_heat"] = np.cumsum(8 * s["washer.friction_power"] * dt)
    if mesh:
        s |= {
            "mesh.friction_torque": 0.3 * (1.0 - done),
            "mesh.friction_power": 120.0 * (1.0 - done),
            "mesh.temperature": 297.15 + 90.0 * (1.0 - done),
            "mesh.surface_temperature": 297.15 + 30.0 * (1.0 - done),
            "mesh.film_ratio": 1.2 * (1.0 - done) + 0.01,
            "mesh.stress_utilization_aisi1020": 1.1 - 0.3 * done,
            "mesh.stress_utilization_aisi4340": 0.8 - 0.3 * done,
            "mesh.allowable_ratio_aisi1020": 0.7 + 0.3 * done,
            "mesh.allowable_ratio_aisi4340": 0.5 + 0.5 * done,
        }
        s["transmission.mesh_heat"] = np.cumsum(6 * s["mesh.friction_power"] * dt)
    book = ("load_work", "clutch_heat", "brake_heat", "washer_heat", "mesh_heat")
    kinetic = s["transmission.engine_work"] - sum(s[f"transmission.{k}"] for k in book)
    s["transmission.kinetic_change"] = kinetic
    s |= {
        "transmission.lock_time": np.where(locked, 1.75, -1.0),
        "transmission.lock_speed": np.where(locked, engine[-1], 0.0),
        "transmission.release_time": np.where(t >= 0.25, 0.25, -1.0),
        "transmission.energy_residual": np.full_like(t, 1e-5),
        "clutch.energy": 1.0002 * s["transmission.clutch_heat"],
        "clutch.friction_coefficient": 0.04 + 0.07 * done**3,
    }
    small = {"inner_radius": 0.00555, "gear_inner_radius": 0.0078, "outer_radius": 0.01135}
    parts = [
        Part("transmission", find_spec("transmission"), {}),
        Part("clutch", find_spec("clutch"), {}),
        Part("brake", find_spec("clutch"), {}),
    ]
    parts += [Part("washer", find_spec("washer"), small)] if washer else []
    parts += (
        [Part("mesh", find_spec("gearmesh"), {"film_heat": "atan", "steel": "AISI4340"})]
        if mesh
        else []
    )
    heat = float(s["transmission.clutch_heat"][-1])
    figures: dict[str, float | None] = {
        "lock_time": 1.75,
        "lock_speed": 99.0,
        "release_time": 0.25,
        "slip_energy": heat,
        "slip_energy_per_area": heat / 0.0786,
        "peak_power": 49e3,
        "peak_clutch_torque": 389.0,
        "peak_sun_thrust": 2280.0,
        "peak_clutch_temperature": 447.15,
        "lock_after_ramp_start": 1.65,
        "lock_after_half_ramp": 1.5,
        "friction_mean": 0.06,
        "friction_start": 0.04,
        "friction_middle": 0.05,
        "friction_lock": 0.11,
        "peak_brake_temperature": 297.2,
    }
    if washer:
        figures |= {
            "peak_washer_temperature_max": 322.15,
            "least_washer_film_ratio": 0.31,
            "washer_distress_time": 0.04,
        }
    if mesh:
        figures |= {
            "peak_flash_temperature": 387.15,
            "peak_mesh_temperature": 327.15,
            "peak_gear_temperature": 297.15,
            "stress_margin_aisi1020": -0.1,
            "stress_margin_aisi4340": 0.2,
        }
    energy = {
        "engine_work": float(s["transmission.engine_work"][-1]),
        "kinetic": float(kinetic[-1]),
        "load_work": float(s["transmission.load_work"][-1]),
        "clutch": heat,
        "brake": 0.0,
        "washers": float(s["transmission.washer_heat"][-1]),
        "residual": 1e-5,
        "meshes": float(s["transmission.mesh_heat"][-1]),
        "brake_coupling_difference": 0.0,
        "brake_coupling_difference_share": 0.0,
        "residual_share": 1.3e-10,
        "coupling_difference": 9.4,
        "coupling_difference_share": 2e-4,
    }
    return Record(
        name="stand-in",
        title="A made-up shift",
        help="Straight lines with the shape of a shift.",
        ramp_start=0.1,
        oil_temperature=297.15,
        step=1e-3,
        master="gauss-seidel",
        time=t,
        signals=s,
        phases=(
            Phase("first gear", 0.0, 0.1),
            Phase("torque phase", 0.1, 0.25),
            Phase("inertia phase", 0.25, 1.75),
            Phase("locked", 1.75, 2.5),
        ),
        events=(
            Event(0.1, "shift ramp starts"),
            Event(0.25, "brake lets go of the ring"),
            Event(1.75, "clutch locks"),
        ),
        energy=energy,
        key_figures=key_figures(figures),
        parts=parts,
        cost=[
            Cost(
                part=part.name,
                model=part.spec.name,
                fidelity="field",
                instantiate=0.01,
                initialize=0.001,
                steps=2500,
                wall_time=0.05,
                share=0.1,
            )
            for part in parts
        ],
        wall_time=0.4,
        messages=("a remark of the run",),
    )
