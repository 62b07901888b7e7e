"""What hosts do that nobody expects: one row each, measured, as a table in Markdown.

python lab/benchmarks/hosts/habits.py FOLDER [--bin FOLDER ...] [--page PAGE]

FOLDER has native-fmi2/WetClutch.fmu, plain/CommandSource.fmu and planetary.ssp, as README.md says.
A row is run by the Python that has its host's package; what is not here is said and left out.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

STEP, STOP = 1e-3, 1.3  # s, of the default shift
NAMES = ("time", "load", "speed", "oil_temperature", "drum_speed")
RAMP = [(0.0, 0.0, 200.0, 353.15, 0.0), (0.5, 5000.0, 100.0, 353.15, 0.0)]
RAMP += [(1.0, 5000.0, 0.0, 353.15, 0.0)]


def _table(rows: list[tuple[float, ...]]) -> Any:
    import numpy as np

    return np.array(rows, dtype=[(name, float) for name in NAMES])


def _pack(folder: Path, rows: list[tuple[float, ...]], **options: Any) -> Any:
    """Run the pack in FMPy with inputs by rows; FMPy prints of its own."""
    from fmpy import simulate_fmu

    fmu = str(folder / "native-fmi2" / "WetClutch.fmu")
    output = ["load", "friction_torque", "energy"]
    return simulate_fmu(fmu, input=_table(rows), output=output, **options)


def fmpy_interval(folder: Path) -> str:
    """Compare with steps of 1 ms, those of the default experiment."""
    found = []
    for stop in (1.0, 5.0, 60.0):
        rows = [(t * stop, *rest) for t, *rest in RAMP]
        coarse = _pack(folder, rows, stop_time=stop)
        fine = _pack(folder, rows, stop_time=stop, output_interval=STEP)
        times, off = coarse["time"], coarse["energy"][-1] / fine["energy"][-1] - 1.0
        step = 1e3 * max(b - a for a, b in pairwise(times))
        found.append(f"{step:.3g} ms over {stop:g} s (energy {100 * off:+.2g} %)")
    return f"without `output_interval` steps of {', '.join(found)}"


def fmpy_ssp_step(folder: Path) -> str:
    from fmpy.ssp.simulation import simulate_ssp

    package = str(folder / "planetary.ssp")
    alone = simulate_ssp(package, stop_time=STOP)
    given = simulate_ssp(package, stop_time=STOP - 0.5 * STEP, step_size=STEP)
    locks = [run["lock_time"][-1] for run in (alone, given)]
    heat = 100.0 * (alone["clutch_heat"][-1] / given["clutch_heat"][-1] - 1.0)
    step = 1e3 * (alone["time"][1] - alone["time"][0])
    return (
        f"`simulate_ssp` without `step_size` steps by {step:.3g} ms: lock-up {locks[0]:.4f} s for "
        f"{locks[1]:.4f}, heat {heat:+.2g} %"
    )


def fmpy_values(folder: Path) -> str:
    from fmpy.ssp.simulation import simulate_ssp

    locks = []
    with tempfile.TemporaryDirectory() as scratch:
        for factor in ("1.0", "0.5"):
            package = _edited(folder, Path(scratch) / f"{factor}.ssp", factor)
            run = simulate_ssp(str(package), stop_time=STOP - 0.5 * STEP, step_size=STEP)
            locks.append(float(run["lock_time"][-1]))
    told = "locks at the same instant" if locks[0] == locks[1] else f"locks at {locks}"
    return f"a friction of the clutch halved in the package: {told}"


def _edited(folder: Path, target: Path, factor: str) -> Path:
    """Write the package with another friction of the clutch, a parameter of its system."""
    with zipfile.ZipFile(folder / "planetary.ssp") as given, zipfile.ZipFile(target, "w") as made:
        for name in given.namelist():
            data = given.read(name)
            if name == "SystemStructure.ssd":
                old = b'name="clutch_friction_scale"><ssv:Real value="1.0"'
                assert data.count(old) == 1
                data = data.replace(old, old.replace(b"1.0", factor.encode()))
            made.writestr(name, data)
    return target


def fmpy_rates(folder: Path) -> str:
    try:
        _pack(folder, RAMP, stop_time=1.0, output_interval=0.1, set_input_derivatives=True)
    except ValueError as problem:
        return f"`set_input_derivatives` with {len(NAMES) - 1} inputs: ValueError: {problem}"
    return f"`set_input_derivatives` with {len(NAMES) - 1} inputs runs"


def fmpy_shown(folder: Path) -> str:
    rows = _pack(folder, RAMP, stop_time=1.0, output_interval=0.1)
    shown = float(rows["load"][2])
    return (
        f"a load that rises by 10 N a ms, recorded in steps of 0.1 s: at 0.2 s {shown:g} N for 2000"
    )


def fmpy_jump(folder: Path) -> str:
    found = []
    for gap in (0.0, 1e-9):
        rows = [(0.0, 1e3, 100.0, 353.15, 0.0), (0.5, 1e3, 100.0, 353.15, 0.0)]
        rows += [(0.5 + gap, 4e3, 100.0, 353.15, 0.0), (1.0, 4e3, 100.0, 353.15, 0.0)]
        run = _pack(folder, rows, stop_time=1.0, output_interval=0.01)
        after = next(row for row in run if row["time"] > 0.505)
        found.append(f"{after['friction_torque']:.1f} N m")
    told = f"a jump of the load, one step of 10 ms later: {found[0]}"
    return f"{told}; where its rows are 1 ns apart: {found[1]}"


def _xml(container: Path) -> Any:
    with zipfile.ZipFile(container) as archive:
        return ElementTree.fromstring(archive.read("modelDescription.xml"))


def fmucontainer_description(folder: Path) -> str:
    """Make one FMU of the package, read what is left of its description."""
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        (scratch / "planetary.ssp").write_bytes((folder / "planetary.ssp").read_bytes())
        program = Path(sys.executable).with_name("fmucontainer")
        order = ["-fmu-directory", name, "-container", f"planetary.ssp:{STEP}"]
        subprocess.run([program, *order], check=True, capture_output=True)
        root = _xml(scratch / "planetary.fmu")
    variables = [v[0] for v in root.find("ModelVariables")]
    kept = {key: sum(key in v.attrib for v in variables) for key in ("unit", "min", "declaredType")}
    step = root.find("DefaultExperiment").get("stepSize")
    told = ", ".join(f"{n} with {key}" for key, n in kept.items())
    return f"of {len(variables)} variables {told}; stepSize {step} s whatever the host takes"


def _parts(folder: Path, scratch: Path, name: str) -> Path:
    with zipfile.ZipFile(folder / "planetary.ssp") as archive:
        archive.extractall(scratch)
    if name != "Parts.ssd":
        (scratch / name).write_bytes((scratch / "Parts.ssd").read_bytes())
    return scratch


def libcosim_samples(folder: Path) -> str:
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    with tempfile.TemporaryDirectory() as name:
        system = str(_parts(folder, Path(name), "Parts.ssd") / "Parts.ssd")
        execution = CosimExecution.from_ssp_file(system, round(STEP * 1e9))
        part = execution.slave_index_from_instance_name("transmission")
        known = {v.name.decode(): v for v in execution.slave_variables(part)}
        speed = known["engine_speed"]
        observer = CosimObserver.create_time_series()
        execution.add_observer(observer)
        observer.start_time_series(part, speed.reference, CosimVariableType.REAL)
        execution.simulate_until(round(10 * STEP * 1e9))
        asked = 11
        times, _, _ = observer.time_series_real_samples(part, speed.reference, 0, asked)
        had = sum(1 for i, t in enumerate(times) if i == 0 or t > 0)
    return f"10 steps, {asked} samples asked from step 0: {had} come"


def libcosim_system(folder: Path) -> str:
    from libcosimpy.CosimExecution import CosimExecution

    with tempfile.TemporaryDirectory() as name:
        system = str(_parts(folder, Path(name), "Parts.ssd") / "SystemStructure.ssd")
        try:
            CosimExecution.from_ssp_file(system, round(STEP * 1e9))
        except AssertionError as problem:
            return f"`SystemStructure.ssd`: {problem}"
    return "opens `SystemStructure.ssd`"


def ecos_system(folder: Path) -> str:
    from ecospy.EcosSimulation import EcosSimulation

    with tempfile.TemporaryDirectory() as name:
        try:
            EcosSimulation(STEP, ssp_path=str(_parts(folder, Path(name), "Parts.ssd")))
        except Exception as problem:
            return f"`SystemStructure.ssd`: {str(problem).strip(' :')}"
    return "opens `SystemStructure.ssd`"


def ecos_digits(folder: Path) -> str:
    from ecospy.EcosSimulation import EcosSimulation

    with tempfile.TemporaryDirectory() as name:
        root = _parts(folder, Path(name), "SystemStructure.ssd")
        simulation = EcosSimulation(STEP, ssp_path=str(root))
        table = Path(name) / "rows.csv"
        simulation.add_csv_writer(str(table))
        simulation.init()
        simulation.step_until(0.3)
        simulation.terminate()
        written = next(f for f in Path(name).rglob("*.csv"))
        lines = written.read_text().splitlines()
    head = [re.sub(r"\[.*", "", h).strip() for h in lines[0].split(",")]
    values = dict(zip(head, lines[-1].split(","), strict=False))
    film = next(k for k in values if k.endswith("clutch::film_thickness"))
    return f"writes a film as {values[film].strip()} m to its table"


def pathsim_leads(folder: Path) -> str:
    """Take the ramp of a command from 0 at 0.1 s to 1 at 0.4 s."""
    from pathsim import Connection, Simulation
    from pathsim.blocks import Scope
    from pathsim_fmi import CoSimulationFMU

    block, scope = CoSimulationFMU(str(folder / "plain" / "CommandSource.fmu"), dt=STEP), Scope()
    simulation = Simulation([block, scope], [Connection(block, scope)], dt=STEP, log=False)
    simulation.run(0.25)
    times, (values, *_) = scope.read()
    at = min(range(len(times)), key=lambda i: abs(times[i] - 0.2))
    lead = 0.1 + 0.3 * float(values[at]) - float(times[at])
    return f"a ramp of a command leads by {lead / STEP:.2g} steps"


class Habit(NamedTuple):
    """A host, the package it needs, what is measured, and what to set."""

    host: str
    package: str
    run: Callable[[Path], str]
    cure: str


HABITS = [
    Habit("FMPy", "fmpy", fmpy_interval, "give `output_interval`; the unit warns once"),
    Habit("FMPy, SSP", "fmpy", fmpy_ssp_step, "give `step_size`; the unit warns once"),
    Habit("FMPy, SSP", "fmpy", fmpy_values, "make the package with `--set`"),
    Habit("FMPy", "fmpy", fmpy_rates, "set rates by FMPy's calls, or `Instance.set_rates`"),
    Habit("FMPy", "fmpy", fmpy_shown, "read inputs one row later"),
    Habit("FMPy", "fmpy", fmpy_jump, "write jumps as two rows of exactly the same time"),
    Habit(
        "fmucontainer",
        "fmu-manipulation-toolbox",
        fmucontainer_description,
        "take units and ranges from the parts; step by a multiple",
    ),
    Habit("PathSim", "pathsim-fmi", pathsim_leads, "build with `--plain`; delay outputs by a step"),
    Habit("libcosim, SSP", "libcosimpy", libcosim_system, "take `Parts.ssd`, made with `--set`"),
    Habit("libcosim", "libcosimpy", libcosim_samples, "ask from step 1"),
    Habit("Ecos, SSP", "ecospy", ecos_system, "put `Parts.ssd` in its place, made with `--set`"),
    Habit("Ecos", "ecospy", ecos_digits, "read values through its functions, not its table"),
]


def write_into(page: Path, lines: list[str]) -> None:
    """Put the table between the page's marks."""
    block = re.compile(r"(?s)(<!-- habits -->\n\n).*?(\n\n<!-- end -->)")
    text = "\n".join(lines)
    page.write_text(block.sub(lambda m: f"{m[1]}{text}{m[2]}", page.read_text("utf-8")), "utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--bin", type=Path, nargs="*", default=[])
    parser.add_argument("--page", type=Path, help="write the table into this page")
    parser.add_argument("--row", help=argparse.SUPPRESS)  # one, run by the host's Python
    given = parser.parse_args()
    if given.row:  # in the host's Python, which need not have what the rest takes
        row = next(h for h in HABITS if h.run.__name__ == given.row)
        print(json.dumps(row.run(given.folder.resolve())))
        return
    from calls import Bench

    lines = ["| host | version | seen | what to set |", "|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(given.folder, given.bin, Path(scratch))
        for habit in HABITS:
            found = bench.python(habit.package)
            if found is None:
                print(f"{habit.host}: not here", file=sys.stderr)
                continue
            order = [found[0], Path(__file__), given.folder, "--row", habit.run.__name__]
            done = subprocess.run(order, capture_output=True, text=True, check=False, cwd=scratch)
            if done.returncode:
                print(f"{habit.host}: {done.stderr.splitlines()[-1:]}", file=sys.stderr)
                continue
            seen = json.loads(done.stdout.splitlines()[-1])
            lines.append(f"| {habit.host} | {found[1]} | {seen} | {habit.cure} |")
    print("\n".join(lines))
    if given.page:
        write_into(given.page, lines)


if __name__ == "__main__":
    main()
