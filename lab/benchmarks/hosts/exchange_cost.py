"""Time of a call of the derivatives in model exchange, by unit and level: a table in Markdown.

python lab/benchmarks/hosts/exchange_cost.py, which needs gcc. Each call follows a change of an
input, and where a unit keeps its solution (``ThrustWasher``) a completed step each call. Processor
time, the least of five means.
"""

import os
import subprocess
import tempfile
from pathlib import Path
from zipfile import ZipFile

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.fmu_cache import fmu_paths
from thrustwasher.model.registry import find_spec

SOURCE = Path(__file__).with_suffix(".c")
ROWS = (  # unit, level, input that moves, calls
    ("OilSump", "", "heat_1", 200_000),
    ("DrivelineLosses", "", "input_speed", 200_000),
    ("WetClutch", "stribeck", "speed", 200_000),
    ("WetClutch", "field", "speed", 100_000),
    ("WetClutch", "fine", "speed", 50_000),
    ("GearMesh", "field", "speed", 50_000),
    ("GearTrain", "", "speed", 5_000),
    ("ThrustWasher", "map", "speed", 50_000),
    ("ThrustWasher", "field", "speed", 300),
    ("ThrustWasher", "fine", "speed", 60),
)


def measured(program: Path, folder: Path, name: str, level: str, moved: str, calls: int) -> float:
    """Return the time of a call [us]."""
    path = fmu_paths([name], "native")[name]
    home = folder / name
    with ZipFile(path) as archive:
        archive.extractall(home)
    shown = interface(find_spec(name))
    guid = (home / "modelDescription.xml").read_text("utf-8").partition('guid="')[2]
    known = {v.name: v for v in shown.variables}
    order = [program, home / "binaries" / "linux64" / f"{name}.so", guid.partition('"')[0]]
    order += [(home / "resources").as_uri(), known[moved].reference]
    order += [next(s.usual for s in shown.spec.inputs if s.name == moved) or 100.0, calls]
    keeps = bool(shown.spec.exchange and shown.spec.exchange.steps)
    order += [int(keeps)]
    if level:
        number = list(shown.spec.fidelities).index(level) + 1
        order += [known["fidelity"].reference, number]
    states = {"STATES": str(len(shown.continuous))}
    told = subprocess.run(
        [*map(str, order)], capture_output=True, text=True, env=os.environ | states, check=True
    )
    return float(told.stdout)


def main() -> None:
    with tempfile.TemporaryDirectory() as scratch:
        program = Path(scratch) / "cost"
        subprocess.run(["gcc", "-O2", "-o", program, SOURCE, "-ldl"], check=True)
        print("| unit | level | time of a call, us |\n|---|---|---|")
        for row in ROWS:
            time = measured(program, Path(scratch), *row)
            print(f"| `{row[0]}` | {row[1] or 'the one'} | {time:.3g} |", flush=True)


if __name__ == "__main__":
    main()
