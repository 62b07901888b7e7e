"""One shift from an SSP package in a master with a package for Python; prints a line of JSON.

python masters.py {fmpy,libcosim,ecos,fmucontainer} PACKAGE STOP, run by the Python that has the
master's package (run.py does so). The line has the version and the lock-up time [s].
"""

import json
import os
import subprocess
import sys
import tempfile
import zipfile
from importlib import metadata
from pathlib import Path

STEP = 1e-3  # s, that of the scene
LOCK = "lock_time"


def fmpy(package: Path, stop: float, scratch: Path) -> float:
    from fmpy.ssp.simulation import simulate_ssp

    found = simulate_ssp(str(package), stop_time=stop, step_size=STEP)
    return float(found[LOCK][-1])


def libcosim(package: Path, stop: float, scratch: Path) -> float:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    system = str(_plain(package, scratch, "Parts.ssd") / "Parts.ssd")
    execution = CosimExecution.from_ssp_file(system, round(STEP * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    part = execution.slave_index_from_instance_name("transmission")
    variables = {v.name.decode(): v.reference for v in execution.slave_variables(part)}
    if not execution.simulate_until(round(stop * 1e9)):
        raise RuntimeError("the run stopped before its end")
    return float(observer.last_real_values(part, [variables[LOCK]])[0])


def ecos(package: Path, stop: float, scratch: Path) -> float:
    from ecospy.EcosSimulation import EcosSimulation

    folder = _plain(package, scratch, "SystemStructure.ssd")  # it reads no other name
    simulation = EcosSimulation(STEP, ssp_path=str(folder))
    simulation.init()
    simulation.step_until(stop)
    return float(simulation.get_real(f"transmission::{LOCK}"))


def fmucontainer(package: Path, stop: float, scratch: Path) -> float:
    """Make one FMU of the package, run it in FMPy."""
    from fmpy import simulate_fmu

    (scratch / package.name).write_bytes(package.read_bytes())
    program = Path(sys.executable).with_name("fmucontainer")
    order = [str(program), "-fmu-directory", str(scratch), "-container", f"{package.name}:{STEP}"]
    subprocess.run(order, check=True, capture_output=True)
    container = str(scratch / package.with_suffix(".fmu").name)
    found = simulate_fmu(container, stop_time=stop, output_interval=STEP, output=[LOCK])
    return float(found[LOCK][-1])


def _plain(package: Path, scratch: Path, name: str) -> Path:
    """Unpack; put the system without values and outputs of its own under this name."""
    zipfile.ZipFile(package).extractall(scratch)
    os.replace(scratch / "Parts.ssd", scratch / name)
    return scratch


MASTERS = {
    "fmpy": (fmpy, "fmpy"),
    "libcosim": (libcosim, "libcosimpy"),
    "ecos": (ecos, "ecospy"),
    "fmucontainer": (fmucontainer, "fmu-manipulation-toolbox"),
}

if __name__ == "__main__":
    master, distribution = MASTERS[sys.argv[1]]
    with tempfile.TemporaryDirectory() as scratch:
        lock = master(Path(sys.argv[2]), float(sys.argv[3]), Path(scratch))
    print(json.dumps({"version": metadata.version(distribution), "lock": lock}))
