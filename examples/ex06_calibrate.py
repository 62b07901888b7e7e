"""Fit the friction law to measurements, and see what they leave open."""

import numpy as np

from thrustwasher import ClutchParams, calibrate, solve_clutch

# Stand-in for a test rig: a pack with other constants, its friction read with some scatter.
CONSTANTS = {"plough_weight": 0.2, "shear_floor": 0.4, "stick_speed": 1.5, "decay_speed": 2.0}
RIG = ClutchParams(friction_law="wang", friction_temperature_slope=0.0, **CONSTANTS)
SLIP = np.linspace(2.0, 160.0, 40)  # rad/s
FORCE = np.where(np.arange(40) % 2, 2000.0, 6000.0)  # N


def read_rig() -> np.ndarray:
    scatter = 1e-3 * np.random.default_rng(1).standard_normal(len(SLIP))
    points = zip(FORCE, SLIP, strict=True)
    brief = {"interface_temperature": 373.15}  # K: over before the faces warm up
    exact = [solve_clutch(RIG, load=n, speed=w, **brief).friction_coefficient for n, w in points]
    return np.array(exact) + scatter


def main() -> float:
    friction = read_rig()
    found = calibrate(ClutchParams(), speed=SLIP, load=FORCE, friction=friction)
    print(found)
    print("\nOnly the fast half of the same points:")
    fast = SLIP > 60.0
    less = calibrate(ClutchParams(), speed=SLIP[fast], load=FORCE[fast], friction=friction[fast])
    for estimate in less.estimates:
        print(f"  {estimate.name:14} {'told' if estimate.identifiable else estimate.reason}")
    pack = found.params
    at = {"load": 6000.0, "speed": 50.0, "interface_temperature": 373.15}
    torque = solve_clutch(pack, **at).friction_torque
    print(f"\nTorque of the fitted pack at 6 kN, 50 rad/s and 100 degC: {torque:.1f} N m")
    return found.params.decay_speed


if __name__ == "__main__":
    main()
