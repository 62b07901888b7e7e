"""A clutch FMU in a driveline of your own: engine, pack, hub, elastic shaft, vehicle.

``--serial``: the driveline takes the torque of this step, else that of the step before.
"""

import sys
import tempfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from thrustwasher.fmu.build import build

STEP, STOP, WITHIN = 1e-3, 4.0, 20  # s, s, steps of the driveline within one
ENGINE, HUB, VEHICLE = 0.15, 0.3, 1.0  # kg m2
STIFFNESS, DAMPING = 11e3, 2.34  # N m/rad, N m s/rad: 30 Hz, damped by 2 %, with the pack stuck
DRIVES, BRAKES = 100.0, 20.0  # N m


def advanced(engine: float, hub: float, vehicle: float, twist: float, torque: float) -> list[float]:
    """Return speeds [rad/s] and twist [rad] a step later: the torque slows the engine."""
    for _ in range(WITHIN):
        twist += STEP / WITHIN * (hub - vehicle)
        shaft = STIFFNESS * twist + DAMPING * (hub - vehicle)
        engine += STEP / WITHIN * (DRIVES - torque) / ENGINE
        hub += STEP / WITHIN * (torque - shaft) / HUB
        vehicle += STEP / WITHIN * (shaft - BRAKES) / VEHICLE
    return [engine, hub, vehicle, twist]


def run(fmu: FMU2Slave, ref: dict[str, int], serial: bool) -> list[tuple[float, float, float]]:
    """Return time, slip and torque of each step."""
    parts, torque, rows = [200.0, 0.0, 0.0, 0.0], 0.0, []
    for n in range(round(STOP / STEP)):
        slip, load = parts[0] - parts[1], 200.0 + 5800.0 * min(1.0, n * STEP / 0.3)
        fmu.setReal([ref["speed"], ref["load"]], [slip, load])
        fmu.doStep(n * STEP, STEP)
        last, torque = torque, fmu.getReal([ref["friction_torque"]])[0]
        parts = advanced(*parts, torque if serial else last)
        rows.append((n * STEP, slip, torque))
    return rows


def main(serial: bool = False, plot: str = "") -> float:
    with tempfile.TemporaryDirectory() as folder:
        path = build(["WetClutch"], out=Path(folder), local=True)[0]
        told, place = read_model_description(path), extract(path, Path(folder) / "clutch")
        ref = {v.name: v.valueReference for v in told.modelVariables}
        whose = {"guid": told.guid, "modelIdentifier": told.coSimulation.modelIdentifier}
        fmu = FMU2Slave(**whose, unzipDirectory=place, instanceName="clutch")
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        rows = run(fmu, ref, serial)
        inertia, heat = fmu.getReal([ref["plant_inertia"], ref["energy"]])
        age, locked = fmu.getInteger([ref["plant_age"]])[0], fmu.getBoolean([ref["locked"]])[0]
        fmu.terminate()
        fmu.freeInstance()
    print(f"The slip sees {inertia:.5f} kg m2, torques act {age} step(s) late;")
    print(f"locked: {bool(locked)}; {heat / 1e3:.3f} kJ; {rows[-1][2]:.3f} N m hold the pack.")
    if plot:
        from matplotlib import pyplot as plt

        time, slip, torque = zip(*rows, strict=True)
        plt.plot(time, slip, time, torque)
        plt.legend(["slip [rad/s]", "torque [N m]"])
        plt.xlabel("time [s]")
        plt.savefig(plot)
    return rows[-1][2]


if __name__ == "__main__":
    main("--serial" in sys.argv, "own_driveline.png" if "--plot" in sys.argv else "")
