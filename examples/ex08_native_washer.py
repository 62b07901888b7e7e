"""A native FMU in FMPy: load a washer until its film is lost, take the step back, go on finer."""

import tempfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from thrustwasher.fmu.build import build

STEP = 1e-3  # s
POINT = {"load": 600.0, "speed": 545.0, "tilt": 2e-3}  # N, rad/s, rad


def lost_at(fmu: FMU2Slave, reference: dict[str, int], finest: float) -> float:
    """Raise the load until the film is lost; return the last load that it carries."""
    load, more, time = POINT["load"], 40.0, 0.0
    while more >= finest:
        before = fmu.getFMUstate()
        fmu.setReal([reference["load"]], [load + more])
        fmu.doStep(time, STEP)
        lost = fmu.getBoolean([reference["distress"]])[0]
        ratio, torque = fmu.getReal([reference["film_ratio"], reference["friction_torque"]])
        print(f"{load + more:8.2f} N: film ratio {ratio:6.2f}, {torque:.3f} N m")
        if lost:
            fmu.setFMUstate(before)  # as if the step had not been
            more /= 2.0
        else:
            load, time = load + more, time + STEP
        fmu.freeFMUstate(before)
    return load


def main() -> float:
    with tempfile.TemporaryDirectory() as folder:
        path = build(["ThrustWasher"], out=Path(folder), local=True)[0]
        # From here on FMPy is alone with the FMU.
        told = read_model_description(path)
        reference = {v.name: v.valueReference for v in told.modelVariables}
        fmu = FMU2Slave(
            guid=told.guid,
            modelIdentifier=told.coSimulation.modelIdentifier,
            unzipDirectory=extract(path, Path(folder) / "washer"),
            instanceName="washer",
        )
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.setReal([reference[name] for name in POINT], list(POINT.values()))
        fmu.exitInitializationMode()
        load = lost_at(fmu, reference, finest=0.1)
        fmu.terminate()
        fmu.freeInstance()
    print(f"The film carries {load:.1f} N.")
    return load


if __name__ == "__main__":
    main()
