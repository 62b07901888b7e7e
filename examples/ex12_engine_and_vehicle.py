"""A transmission in FMPy between an engine and a vehicle that are your own FMUs."""

import tempfile
from pathlib import Path

from driveline.parts import STEP, WIRES, fmus, system
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STOP = 1.3  # s


class Part:
    """One FMU: its instance and its variables by name, all of them real numbers here."""

    def __init__(self, name: str, path: Path) -> None:
        told = read_model_description(path)
        self.reference = {v.name: [v.valueReference] for v in told.modelVariables}
        self.fmu = FMU2Slave(
            guid=told.guid,
            modelIdentifier=told.coSimulation.modelIdentifier,
            unzipDirectory=extract(path, path.with_suffix("")),
            instanceName=name,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()

    def get(self, name: str) -> float:
        return self.fmu.getReal(self.reference[name])[0]

    def set(self, name: str, value: float) -> None:
        self.fmu.setReal(self.reference[name], [value])


def main() -> float:
    with tempfile.TemporaryDirectory() as folder:
        shift = system()
        parts = {name: Part(name, path) for name, path in fmus(shift, Path(folder)).items()}
        wires = [*shift.links, *WIRES]
        for part in parts.values():
            part.fmu.exitInitializationMode()
        for i in range(round(STOP / STEP)):
            values = [parts[source].get(output) for source, output, _, _ in wires]
            for (_, _, target, into), value in zip(wires, values, strict=True):
                parts[target].set(into, value)
            for part in parts.values():
                part.fmu.doStep(i * STEP, STEP)
        locked, torque = (parts["transmission"].get(n) for n in ("lock_time", "output_torque"))
        print(f"The clutch locks at {locked:.6f} s; the output's torque is {torque:.1f} N m")
        print(f"after {STOP:g} s and {parts['vehicle'].get('distance'):.2f} m.")
        for part in parts.values():
            part.fmu.terminate()
            part.fmu.freeInstance()
    return locked


if __name__ == "__main__":
    main()
