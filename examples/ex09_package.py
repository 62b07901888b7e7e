"""A whole shift as an SSP package, run by FMPy, which knows nothing of this one."""

import tempfile
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp

from thrustwasher.cli import main as thrustwasher


def main() -> float:
    with tempfile.TemporaryDirectory() as folder:
        package = str(Path(folder) / "shift.ssp")
        thrustwasher(["shift", "--scene", "msl", "--ssp", package, "--platforms", "local"])
        rows = simulate_ssp(package, stop_time=5.0, step_size=1e-3)
    locked = float(rows["lock_time"][-1])
    print(f"In FMPy the clutch locks at {locked:.6f} s with {rows['clutch_heat'][-1]:.2f} J.")
    return locked


if __name__ == "__main__":
    main()
