"""Fit a pack to a recording of two engagements: friction, permeability, the piston's fill.

python examples/ex17_engagement.py make    # writes the recording anew
"""

import sys
from pathlib import Path

import numpy as np

from thrustwasher import ClutchParams, calibrate_traces, engage_clutch

TRACE = Path(__file__).with_suffix(".csv")
TRUTH = {"friction_scale": 0.92, "permeability": 3e-13, "fill_time": 0.012, "kiss_pressure": 6e4}
AREA, OIL = 6e-3, 353.15  # m2, K
NOISE = {"pressure": 5e2, "speed": 0.3, "friction_torque": 1.5}  # Pa, rad/s, N m: made up
HELD = 40.0  # N m, of the locked pack
HEAD = (
    "# Made by examples/ex17_engagement.py from known parameters and noise (seed 17): no rig.\n"
    "time [s], pressure [bar], speed [rpm], oil_temperature [degC], friction_torque [N.m]"
)


def rows(seed: int = 17) -> dict[str, np.ndarray]:
    """Two engagements at 500 Hz; the piston's springs and its fill are before the force."""
    time = np.arange(0.0, 2.2, 2e-3)
    points = [0.0, 0.05, 0.15, 0.95, 0.97, 1.45, 1.6, 2.2]
    pressure = 1e5 * np.interp(time, points, [0.0, 0.0, 10.0, 10.0, 0.0, 0.0, 7.0, 7.0])
    speed = np.interp(time, [0.08, 0.7, 1.0, 1.4, 1.5, 2.15], [300.0, 0.0, 0.0, 250.0, 250.0, 0.0])
    late = np.interp(time - TRUTH["fill_time"], time, pressure)
    force = AREA * np.maximum(late - TRUTH["kiss_pressure"], 0.0)
    pack = ClutchParams(**{n: TRUTH[n] for n in ("friction_scale", "permeability")})
    torque = engage_clutch(pack, time=time, load=force, speed=speed, oil_temperature=OIL)
    exact = {
        "pressure": pressure,
        "speed": speed,
        "friction_torque": np.where(speed > 0.0, torque.friction_torque, HELD),
    }
    rng = np.random.default_rng(seed)
    noisy = {n: x + NOISE[n] * rng.standard_normal(len(x)) for n, x in exact.items()}
    return {"time": time, "oil_temperature": np.full(len(time), OIL), **noisy}


def make() -> None:
    made = rows()
    columns = (
        made["time"],
        made["pressure"] / 1e5,
        made["speed"] * 30.0 / np.pi,
        made["oil_temperature"] - 273.15,
        made["friction_torque"],
    )
    lines = (f"{t:.3f}, {p:.3f}, {w:.1f}, {c:.1f}, {m:.2f}" for t, p, w, c, m in zip(*columns))  # noqa: B905
    TRACE.write_text("\n".join([HEAD, *lines]) + "\n", "utf-8")


def main() -> float:
    found = calibrate_traces(ClutchParams(), TRACE, fit=tuple(TRUTH), piston_area=AREA)
    print(found)
    return float(found["friction_scale"].value)


if __name__ == "__main__":
    make() if sys.argv[1:] == ["make"] else main()
