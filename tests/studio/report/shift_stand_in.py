"""A made-up shift with the face of a real one: fast input for plots and pages."""

from __future__ import annotations

import numpy as np

from thrustwasher.model.registry import find_spec
from thrustwasher.shift.account.shift_record import Event, KeyFigure, Part, Phase, Record
from thrustwasher.shift.shift_result import Cost

UNITS = {
    **{"time": "s", "speed": "rad/s", "energy": "J", "area": "J/m2", "power": "W", "thrust": "N"},
    **{"torque": "N.m", "temperature": "K", "max": "K"},
}
SMALL = {"inner_radius": 0.00555, "gear_inner_radius": 0.0078, "outer_radius": 0.01135}
PARTS = {"transmission": "transmission", "clutch": "clutch", "brake": "clutch"}
T = np.linspace(0.0, 2.5, 2501)
DONE, OIL = np.clip((T - 0.25) / 1.5, 0.0, 1.0), 297.15
LEFT = 1.0 - DONE  # of the slip


def key_figures(values: dict[str, float | None]) -> list[KeyFigure]:
    """Return figures whose text and unit follow from their names."""
    return [
        KeyFigure(name, name.replace("_", " "), UNITS.get(name.split("_")[-1], "1"), value)
        for name, value in values.items()
    ]


def of(part: str, **signals: np.ndarray | float) -> dict[str, np.ndarray]:
    """Return signals of a part, numbers as constant ones."""
    return {f"{part}.{name}": values + 0.0 * T for name, values in signals.items()}


def work(power: np.ndarray) -> np.ndarray:
    """Return the work [J] of a power [W] up to each time."""
    return np.cumsum(power * np.diff(T, prepend=0.0))


def washer_signals() -> dict[str, np.ndarray]:
    point = {"load": 96.0 - 50.0 * np.sin(np.pi * DONE), "tilt": 1.6e-3}
    heat = 12.0 * LEFT
    return of("transmission", washer_load=point["load"], washer_tilt=1.6e-3) | of(
        "washer",
        **point,
        speed=401.0 * LEFT,
        oil_temperature=OIL,
        friction_torque=0.03 * LEFT,
        temperature=OIL + 15.0 * LEFT,
        temperature_max=OIL + 25.0 * LEFT,
        film_ratio=6.6 * LEFT + 0.3 * DONE,
        fluid_load_share=1.0 - 0.9 * DONE**8,
        friction_power=heat,
        oil_heat=heat,
        oil_flow=6e-7 * LEFT,
        oil_outlet_temperature=OIL + 8.0 * LEFT,
        stick_margin=3.0 + 9.0 * DONE,
        distress=(T > 0.3) & (T < 0.34),
    )


def mesh_signals() -> dict[str, np.ndarray]:
    return of(
        "mesh",
        friction_torque=0.3 * LEFT,
        friction_power=120.0 * LEFT,
        temperature=OIL + 90.0 * LEFT,
        surface_temperature=OIL + 30.0 * LEFT,
        film_ratio=1.2 * LEFT + 0.01,
        stress_utilization_aisi1020=1.1 - 0.3 * DONE,
        stress_utilization_aisi4340=0.8 - 0.3 * DONE,
        allowable_ratio_aisi1020=0.7 + 0.3 * DONE,
        allowable_ratio_aisi4340=0.5 + 0.5 * DONE,
    )


def record(washer: bool = True, mesh: bool = False) -> Record:
    """Return a shift of 2.5 s: pressure ramp 0.1 to 0.4 s, lock-up at 1.75 s."""
    command = np.clip((T - 0.1) / 0.3, 0.0, 1.0)
    slip, output = 350.0 * LEFT, 109.0 - 10.0 * np.minimum(T / 1.75, 1.0)
    engine = np.where(T < 0.25, 350.0, output + 241.0 * LEFT)
    capacity = 389.0 * command * (0.4 + 0.6 * DONE**3)
    locked, load = T >= 1.75, 250.0 * (output / 100.0) ** 2
    reaction = np.where(locked, 160.0, capacity)
    book = {
        "load_work": work(load * output),
        "clutch_heat": work(capacity * slip),
        "brake_heat": 0.0 * T,
        "mesh_heat": work(6 * 120.0 * LEFT) if mesh else 0.0 * T,
        "washer_heat": work(8 * 12.0 * LEFT) if washer else 0.0 * T,
    }
    given, heat = work(150.0 * engine), float(book["clutch_heat"][-1])
    kinetic = given - sum(book.values())
    s = of(
        "transmission",
        engine_speed=engine,
        output_speed=output,
        drum_speed=output - (engine - output) / 2.2,
        clutch_speed=slip,
        washer_speed=401.0 * LEFT,
        drive_torque=150.0,
        resistance_torque=load,
        clutch_reaction=reaction,
        brake_reaction=np.where(T < 0.25, 330.0 - 2 * reaction, 0.0),
        input_tooth_torque=np.where(T < 0.25, 150.0 - reaction, 60.0 + 60 * DONE**3),
        oil_supply_temperature=OIL,
        engine_work=given,
        kinetic_change=kinetic,
        lock_time=np.where(locked, 1.75, -1.0),
        lock_speed=np.where(locked, engine[-1], 0.0),
        release_time=np.where(T >= 0.25, 0.25, -1.0),
        energy_residual=1e-5,
        **book,
    )
    s |= of(
        "clutch",
        torque_capacity=capacity,
        speed=slip,
        temperature=OIL + 150.0 * DONE**0.7,
        film_ratio=10.0 - 9.2 * command,
        friction_power=capacity * slip,
        friction_coefficient=0.04 + 0.07 * DONE**3,
        energy=1.0002 * book["clutch_heat"],
    )
    s |= of("brake", torque_capacity=389.0 * (1.0 - command), temperature=297.2)
    s |= of("brake", film_ratio=0.8 + 9.0 * command, friction_power=0.0)
    parts = [Part(name, find_spec(model), {}) for name, model in PARTS.items()]
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
        s |= washer_signals()
        parts.append(Part("washer", find_spec("washer"), SMALL))
        figures |= {"peak_washer_temperature_max": 322.15, "minimum_washer_film_ratio": 0.31}
        figures |= {"washer_distress_time": 0.04}
    if mesh:
        s |= mesh_signals()
        rated = {"film_heat": "atan", "steel": "AISI4340"}
        parts.append(Part("mesh", find_spec("gearmesh"), rated))
        figures |= {"peak_flash_temperature": 387.15, "peak_mesh_temperature": 327.15}
        figures |= {"peak_gear_temperature": OIL, "stress_margin_aisi1020": -0.1}
        figures |= {"stress_margin_aisi4340": 0.2}
    ends = {name: float(values[-1]) for name, values in book.items()}
    energy = {"engine_work": float(given[-1]), "kinetic": float(kinetic[-1])}
    energy |= {"load_work": ends["load_work"], "clutch": heat, "brake": 0.0}
    energy |= {"washers": ends["washer_heat"], "meshes": ends["mesh_heat"]}
    energy |= {"residual": 1e-5, "residual_share": 1.3e-10}
    energy |= {"coupling_difference": 9.4, "coupling_difference_share": 2e-4}
    energy |= {"brake_coupling_difference": 0.0, "brake_coupling_difference_share": 0.0}
    phases = ("first gear", 0.0, 0.1), ("torque phase", 0.1, 0.25)
    phases += ("inertia phase", 0.25, 1.75), ("locked", 1.75, 2.5)
    happened = (
        (0.1, "shift ramp starts"),
        (0.25, "brake lets go of the ring"),
        (1.75, "clutch locks"),
    )
    return Record(
        name="stand-in",
        title="A made-up shift",
        help="Straight lines with the shape of a shift.",
        ramp_start=0.1,
        oil_temperature=OIL,
        step=1e-3,
        master="gauss-seidel",
        time=T.copy(),
        signals=s,
        phases=tuple(Phase(*phase) for phase in phases),
        events=tuple(Event(*event) for event in happened),
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
