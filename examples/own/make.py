"""Write the files that the pages of the commands name, from known parameters and made-up noise.

python examples/own/make.py    # into this folder; no rig and no vehicle is behind any of them
"""

from pathlib import Path

import numpy as np

from thrustwasher import ClutchParams, engage_clutch, load_curve, load_part, solve_washer

HERE = Path(__file__).parent
RPM = 30.0 / np.pi
MADE = "# Made by examples/own/make.py from known parameters and noise: measured nowhere."
WORN = ClutchParams(friction_scale=0.92, permeability=3e-13)
OIL, COLD = 353.15, 313.15  # K
INERTIA, DRAG = 0.25, 2.0  # kg m2, N m: of stop.csv


def write(name: str, head: str, columns: list[np.ndarray], digits: str) -> None:
    rows = (
        ",".join(f"{x:{d}}" if np.isfinite(x) else "" for x, d in zip(row, digits.split()))  # noqa: B905
        for row in zip(*columns)  # noqa: B905
    )
    (HERE / name).write_text("\n".join([MADE, head, *rows]) + "\n", "utf-8")


def points(rng: np.random.Generator) -> None:
    """Points of the washer in mine.toml, a little rougher than it says."""
    part = load_part(HERE / "mine.toml")
    params = part.params.__class__(**{**part.parameters, "roughness": 0.6e-6})
    load = np.array([60.0, 120.0, 240.0, 400.0, 600.0, 150.0, 300.0, 500.0])
    speed = np.array([700.0, 700.0, 700.0, 700.0, 700.0, 1000.0, 1000.0, 1000.0])
    tilt, torque, warm, fold = 0.002, [], [], np.full(8, np.nan)
    for x, w in zip(load, speed, strict=True):
        found = solve_washer(params, load=x, speed=w, tilt=tilt, oil_temperature=COLD)
        torque.append(found.friction_torque)
        warm.append(found.temperature)
    curve = load_curve(params, speed=700.0, tilt=tilt, oil_temperature=COLD)
    fold[0] = next((f.load for f in curve.folds if f.kind == "film_lost"), np.nan)
    given = [np.full(8, 9.0), np.full(8, 20.0), load, speed * RPM, np.full(8, 2.0)]
    shown = np.array(torque) * (1.0 + 0.02 * rng.standard_normal(8))
    warm = np.array(warm) - 273.15 + rng.standard_normal(8)
    write(
        "rig.csv",
        "inner_radius [mm],outer_radius [mm],load [N],speed [rpm],tilt [mrad],"
        "oil_temperature [degC],friction_torque [N.m],temperature [degC],film_loss_load [N]",
        [*given, np.full(8, COLD - 273.15), shown, warm, fold],
        "g g .0f .0f g g .4f .1f .0f",
    )
    write("measured.csv", "load [N],speed [rpm],tilt [mrad]", given[2:], ".0f .0f g")


def friction(rng: np.random.Generator) -> None:
    """Friction of a pack that falls with slip: 0.13 at rest, 0.11 where it is fast."""
    rpm = np.array([10.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1200.0, 1600.0, 2000.0, 2500.0, 3000.0])
    sliding = rpm / RPM * ClutchParams().friction_radius
    shown = 0.11 + 0.02 * np.exp(-sliding / 2.0) + 3e-4 * rng.standard_normal(len(rpm))
    head = "speed [rpm],load [N],friction"
    write("friction.csv", head, [rpm, np.full(len(rpm), 3000.0), shown], ".0f .0f .4f")


def recordings(rng: np.random.Generator) -> None:
    """Two engagements with their slip, and a wheel that a pack stops."""
    time = np.linspace(0.0, 0.6, 301)
    for name, force in (("monday.csv", 5000.0), ("tuesday.csv", 3000.0)):
        load = force * np.clip((time - 0.05) / 0.1, 0.0, 1.0)
        speed = 300.0 * (1.0 - time / 0.6)
        way = engage_clutch(WORN, time=time, load=load, speed=speed, oil_temperature=OIL)
        torque = way.friction_torque + 1.5 * rng.standard_normal(301)
        write(
            name,
            "time [s],load [N],speed [rpm],oil_temperature [degC],friction_torque [N.m]",
            [time, load, speed * RPM, np.full(301, 80.0), torque],
            ".3f .1f .1f g .2f",
        )
    load = 5000.0 * np.clip((time - 0.05) / 0.1, 0.0, 1.0)
    speed = np.full(301, 300.0)
    for _ in range(12):  # the slip that its own torque leaves
        way = engage_clutch(WORN, time=time, load=load, speed=speed, oil_temperature=OIL)
        slowed = (way.friction_torque + DRAG) * (load > 250.0)
        fall = np.append(0.0, np.cumsum(0.5 * np.diff(time) * (slowed[1:] + slowed[:-1])))
        speed = np.maximum(300.0 - fall / INERTIA, 0.0)
    noisy = speed + 0.3 * rng.standard_normal(301)
    torque = np.where(speed > 0.0, way.friction_torque, 0.0) + 1.5 * rng.standard_normal(301)
    write(
        "stop.csv",
        "time [s],load [N],speed [rpm],oil_temperature [degC],friction_torque [N.m]",
        [time, load, noisy * RPM, np.full(301, 80.0), torque],
        ".3f .1f .1f g .2f",
    )


def profiles(rng: np.random.Generator) -> None:
    """Log a shift, and forces of a vehicle that coasts down."""
    time = np.arange(0.0, 1.4, 4e-3)
    rise = [[0.1, 0.11, 0.2, 0.4, 0.79, 0.9, 0.97], [0.0, 0.4, 0.4, 3.36, 3.55, 4.2, 7.2]]
    fall = [[0.0, 0.16, 0.2, 0.36, 0.38], [7.6, 7.6, 5.4, 0.8, 0.0]]
    torque = [[0.0, 0.42, 0.46, 0.79, 0.83, 0.87], [253.0, 253.0, 188.0, 188.0, 250.0, 253.0]]
    columns = [np.interp(time, *np.array(x)) for x in (torque, rise, fall)]
    scatter = (0.5, 0.01, 0.01)
    noisy = [x + s * rng.standard_normal(len(time)) for x, s in zip(columns, scatter, strict=True)]
    head = "time [ms],torque [N.m],P_K1 [bar],P_B1 [bar]"
    write("trace.csv", head, [1e3 * time, *noisy], ".0f .2f .3f .3f")
    speed = np.arange(10.0, 131.0, 5.0)
    force = 178.0 + 0.41 * (speed / 3.6) ** 2 + 2.0 * rng.standard_normal(len(speed))
    write("coast_down.csv", "speed [km/h],force [N]", [speed, force], ".0f .1f")


def main() -> None:
    rng = np.random.default_rng(7)
    points(rng)
    friction(rng)
    recordings(rng)
    profiles(rng)


if __name__ == "__main__":
    main()
