"""A pack that locks between two inertias, in one host with a package for Python.

python lock_hosts.py HOST CLUTCH.fmu PLANT.fmu [EXCHANGE], run by the Python that has the host's
package (lock_run.py does so). Prints one line of JSON: host, version, FMI, exchange, slip
reversals, time of lock, torque at the end, largest slip late in the run, warnings.

Exchanges: "parallel", both FMUs step with what the other gave at the start of the step; "clutch
first" and "plant first", one after the other, the second with what the first gives at the step's
end; for other hosts what they offer.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path
from typing import Any

from fmpy_pair import Found, Pair
from lock_scene import EXTRAS, STARTS, STEP, STOP, TORQUE, WIRES, measured, told, warnings

STEPS = round(STOP / STEP)


def version_of_fmi(fmu: Path) -> int:
    """Return the version of FMI that the FMU is of."""
    with zipfile.ZipFile(fmu) as archive:
        return 3 if b'fmiVersion="3' in archive.read("modelDescription.xml") else 2


def fmpy(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Own loop on FMPy's instances; with ", events" in FMI 3.0's Event Mode."""
    order, _, events = exchange.partition(", ")
    pair = Pair(clutch, plant, scratch, bool(events))
    for k in range(STEPS):
        pair.step(k * STEP, STEP, order)
        pair.note((k + 1) * STEP)
    return pair.found(**({"events": pair.clutch.stops} if events else {}))


def halving(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Take each step once as a whole and once as two halves; go back where they differ."""
    rtol, atol, shortest, longest = 1e-3, 1e-3, 1e-5, STEP
    pair = Pair(clutch, plant, scratch)
    parts = (pair.clutch, pair.plant)
    t, h, taken, refused, forced = 0.0, longest, 0, 0, 0
    while t < STOP - 1e-9:
        h = min(h, STOP - t)
        kept = [part.fmu.getFMUState() for part in parts]
        pair.step(t, h, exchange, final=False)
        whole = pair.plant.get("slip")
        for part, state in zip(parts, kept, strict=True):
            part.fmu.setFMUState(state)
        pair.step(t, h / 2, exchange, final=False)
        pair.step(t + h / 2, h / 2, exchange, final=False)
        halves = pair.plant.get("slip")
        error = abs(whole - halves) / (atol + rtol * abs(halves))
        factor = min(2.0, max(0.2, 0.9 / math.sqrt(max(error, 1e-12))))
        if error > 1 and h > shortest:
            refused += 1
            for part, state in zip(parts, kept, strict=True):
                part.fmu.setFMUState(state)
        else:
            forced += error > 1
            t, taken = t + h, taken + 1
            pair.note(t)
        for part, state in zip(parts, kept, strict=True):
            part.fmu.freeFMUState(state)
        h = min(longest, max(shortest, h * factor))
    return pair.found(steps=taken, refused=refused, over_tolerance=forced)


def ssp(clutch: Path, plant: Path, target: Path) -> Path:
    """Write the system as an SSP package."""
    kinds = {"input": "input", "output": "output"}

    def part(fmu: Path, name: str, connectors: list[tuple[str, str]]) -> str:
        lines = "".join(
            f'<ssd:Connector name="{n}" kind="{kinds[k]}"><ssc:Real/></ssd:Connector>'
            for n, k in connectors
        )
        return (
            f'<ssd:Component name="{name}" type="application/x-fmu-sharedlibrary" '
            f'source="resources/{fmu.name}"><ssd:Connectors>{lines}</ssd:Connectors>'
            f"{bound if name == 'clutch' else ''}</ssd:Component>"
        )

    values = "".join(
        f'<ssv:Parameter name="{n}"><ssv:Real value="{v}"/></ssv:Parameter>'
        for n, v in STARTS.items()
    )
    bound = (
        "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
        '<ssv:ParameterSet version="1.0" name="starts"><ssv:Parameters>'
        f"{values}</ssv:Parameters></ssv:ParameterSet>"
        "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"
    )
    links = [("plant", a, "clutch", b) for a, b in WIRES] + [("clutch", TORQUE, "plant", "torque")]
    wires = "".join(
        f'<ssd:Connection startElement="{a}" startConnector="{b}" endElement="{c}" '
        f'endConnector="{d}"/>'
        for a, b, c, d in links
    )
    inner = part(
        clutch,
        "clutch",
        [(TORQUE, "output"), *((n, "input") for _, n in WIRES)],
    ) + part(plant, "plant", [("torque", "input"), *((n, "output") for n, _ in WIRES)])
    space = "http://ssp-standard.org/SSP1/SystemStructure"
    text = (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<ssd:SystemStructureDescription version="1.0" '
        f'name="lock" xmlns:ssd="{space}Description" xmlns:ssc="{space}Common" '
        f'xmlns:ssv="{space}ParameterValues"><ssd:System name="root"><ssd:Elements>{inner}'
        f"</ssd:Elements><ssd:Connections>{wires}</ssd:Connections></ssd:System>"
        f'<ssd:DefaultExperiment startTime="0" stopTime="{STOP}"/>'
        "</ssd:SystemStructureDescription>"
    )
    with zipfile.ZipFile(target, "w") as made:
        made.writestr("SystemStructure.ssd", text)
        for fmu in (clutch, plant):
            made.write(fmu, f"resources/{fmu.name}")
    return target


def fmpy_ssp(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """FMPy's own master for packages; it takes FMI 2.0 and steps in parallel."""
    from types import SimpleNamespace

    from fmpy.ssp.simulation import simulate_ssp

    values = [SimpleNamespace(name=f"clutch.{n}", value=v) for n, v in STARTS.items()]
    package = ssp(clutch, plant, scratch / "lock.ssp")
    # its connectors start as 0, so the first row is after a step
    rows = simulate_ssp(
        str(package),
        stop_time=STOP - STEP / 2,
        step_size=STEP,
        parameter_set=SimpleNamespace(parameters=values),
    )
    names = {n.rsplit(".", 1)[-1] if n != "time" else n: n for n in rows.dtype.names}
    return measured(
        (rows["time"] + STEP).tolist(), rows[names["slip"]].tolist(), float(rows[names[TORQUE]][-1])
    )


def pyfmi(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """PyFMI's Master; it takes FMI 2.0."""
    import numpy as np
    from pyfmi import Master, load_fmu

    logs = [scratch / f"{fmu.stem}.log" for fmu in (clutch, plant)]
    given = zip((clutch, plant), logs, strict=True)
    parts = [load_fmu(str(fmu), log_level=3, log_file_name=str(log)) for fmu, log in given]
    pack, inertias = parts
    for name, value in STARTS.items():
        pack.set(name, value)
    wires = [(inertias, a, pack, b) for a, b in WIRES] + [(pack, TORQUE, inertias, "torque")]
    master = Master(parts, wires)
    options = master.simulate_options()
    options.update(step_size=STEP, result_handling="memory", block_initialization=True)
    if exchange.startswith("error controlled"):
        options.update(error_controlled=True, rtol=1e-3, atol=1e-3, maxh=STEP)
    options["linear_correction"] = exchange.endswith("linear correction")
    found = master.simulate(start_time=0.0, final_time=STOP, options=options)
    slips = np.asarray(found[inertias]["slip"], float)
    times = np.asarray(found[inertias]["time"], float)
    last = np.append(np.diff(times) > 1e-12, True)  # the last row of each point of time
    more = {name: pack.get(name)[0] for name in EXTRAS if name in pack.get_model_variables()}
    if options["error_controlled"]:
        more |= {"steps": master.statistics["nsteps"], "refused": master.statistics["nreject"]}
    log = [line for file in logs for line in file.read_text().splitlines()]
    return measured(
        times[last].tolist(),
        slips[last].tolist(),
        float(pack.get(TORQUE)[0]),
        log,
        **{n: v.item() if hasattr(v, "item") else v for n, v in more.items()},
    )


def libcosim(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Run libcosim's fixed-step algorithm."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_step_size(round(STEP * 1e9))
    where, known = {}, {}
    for name, fmu in (("clutch", clutch), ("plant", plant)):
        where[name] = execution.add_local_slave(CosimLocalSlave(str(fmu), name))
        found = execution.slave_variables(where[name])
        known[name] = {v.name.decode(): v for v in found}
    index = {p: {n: v.reference for n, v in found.items()} for p, found in known.items()}
    for name, value in STARTS.items():
        execution.real_initial_value(where["clutch"], index["clutch"][name], value)
    links = [("plant", a, "clutch", b) for a, b in WIRES] + [("clutch", TORQUE, "plant", "torque")]
    for a, b, c, d in links:
        execution.connect_real_variables(where[a], index[a][b], where[c], index[c][d])
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)

    def real(part: str, name: str) -> float:
        return float(observer.last_real_values(where[part], [index[part][name]])[0])

    times, slips = [], []
    for k in range(1, STEPS + 1):
        if not execution.step():
            raise RuntimeError(f"a step failed at {k * STEP:g} s")
        times.append(k * STEP)
        slips.append(real("plant", "slip"))
    readers = {0: "real", 1: "integer", 2: "string", 3: "boolean"}
    more = {}
    for name in EXTRAS:
        if name in known["clutch"]:
            kind = readers[known["clutch"][name].type]
            reader = getattr(observer, f"last_{kind}_values")
            more[name] = reader(where["clutch"], [index["clutch"][name]])[0]
    return measured(times, slips, real("clutch", TORQUE), **more)


def ecos(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Ecos' fixed-step algorithm."""
    from ecospy.EcosSimulation import EcosSimulation
    from ecospy.EcosSimulationStructure import EcosSimulationStructure

    structure = EcosSimulationStructure()
    structure.add_model("clutch", str(clutch))
    structure.add_model("plant", str(plant))
    for a, b in WIRES:
        structure.make_real_connection(f"plant::{a}", f"clutch::{b}")
    structure.make_real_connection(f"clutch::{TORQUE}", "plant::torque")
    structure.add_parameter_set("starts", {f"clutch::{n}": v for n, v in STARTS.items()})
    simulation = EcosSimulation(STEP, structure=structure)
    if not simulation.init(parameter_set="starts"):
        raise RuntimeError("it did not initialize")
    times, slips = [0.0], [simulation.get_real("plant::slip")]
    for k in range(1, STEPS + 1):
        simulation.step()
        times.append(k * STEP)
        slips.append(simulation.get_real("plant::slip"))
    with zipfile.ZipFile(clutch) as archive:
        text = archive.read("modelDescription.xml").decode()
    readers = dict(zip(EXTRAS, ("bool", "real", "integer"), strict=True))
    more = {
        name: getattr(simulation, f"get_{kind}")(f"clutch::{name}")
        for name, kind in readers.items()
        if f'name="{name}"' in text
    }
    torque = simulation.get_real(f"clutch::{TORQUE}")
    simulation.terminate()
    return measured(times, slips, torque, **more)


def cofmupy(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """CoFMPy's master; ", iterated" steps again from saved states until the signals settle."""
    from cofmupy import Coordinator
    from cofmupy.wrappers import FmuXHandler

    def real_outputs(self: Any) -> list[str]:
        """Leave out the others, which it reads as reals too."""
        known = self.description.modelVariables
        outputs = [v for v in known if v.causality == "output"]
        return [v.name for v in outputs if v.type in ("Real", "Float64")]

    FmuXHandler.get_output_names = real_outputs
    method, _, iterated = exchange.partition(", ")
    links = [("plant", a, "clutch", b) for a, b in WIRES] + [("clutch", TORQUE, "plant", "torque")]
    first = {"speed": 200.0, "load": 200.0}  # the plant's outputs at the start
    coordinator = Coordinator()
    coordinator.start(
        {
            "fmus": [
                {
                    "id": "clutch",
                    "name": "clutch",
                    "path": str(clutch),
                    "initialization": STARTS | first,
                },
                {"id": "plant", "name": "plant", "path": str(plant), "initialization": {}},
            ],
            "connections": [
                {"source": {"id": a, "variable": b}, "target": {"id": c, "variable": d}}
                for a, b, c, d in links
            ],
            "cosim_method": {"parallel": "jacobi", "serial": "gauss_seidel"}[method],
            "iterative": bool(iterated),
            "edge_sep": " -> ",
            "root": "",
        }
    )
    for _ in range(STEPS):
        coordinator.do_step(STEP, save_data=False)
    found = coordinator.get_results()
    slips = [float(value) for value in found["plant", "slip"]]
    times = [(k + 1) * STEP for k in range(len(slips))]
    more = {n: found["clutch", n][-1] for n in EXTRAS if ("clutch", n) in found}
    return measured(times, slips, float(found["clutch", TORQUE][-1]), **more)


def container(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Path:
    """Make one FMU of both with fmucontainer; "parallel" or "serial"."""
    for fmu in (clutch, plant):
        (scratch / fmu.name).write_bytes(fmu.read_bytes())
    a, b = clutch.name, plant.name
    first, second = (b, a) if exchange.startswith("plant") else (a, b)
    inside = {
        "name": "lock.fmu",
        "step_size": STEP,
        "sequential": exchange != "parallel",
        "auto_link": False,
        "auto_input": True,
        "auto_output": False,
        "fmu": [first, second],
        "link": [[b, s, a, t] for s, t in WIRES] + [[a, TORQUE, b, "torque"]],
        "output": [[b, "slip", "slip"], [a, TORQUE, TORQUE]],
    }
    (scratch / "lock.json").write_text(json.dumps(inside))
    program = Path(sys.executable).with_name("fmucontainer")
    fmi = version_of_fmi(clutch)
    order = [str(program), "-fmu-directory", str(scratch), "-container", "lock.json"]
    done = subprocess.run([*order, "-fmi", str(fmi)], capture_output=True, text=True, check=False)
    lines = (done.stdout + done.stderr).splitlines()
    print("\n".join(line for line in lines if "is not connected" not in line), file=sys.stderr)
    return scratch / "lock.fmu"


def fmucontainer(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Make one FMU of both, run it in FMPy."""
    from fmpy import simulate_fmu

    made = container(clutch, plant, exchange, scratch)
    given = {"start_values": STARTS, "output": ["slip", TORQUE]}
    rows = simulate_fmu(str(made), stop_time=STOP, output_interval=STEP, step_size=STEP, **given)
    return measured(rows["time"].tolist(), rows["slip"].tolist(), float(rows[TORQUE][-1]))


def fmusim(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Run fmucontainer's FMU of both in fmusim, which takes single FMUs."""
    import csv
    import shutil

    made = container(clutch, plant, exchange, scratch)
    table = scratch / "out.csv"
    order = [shutil.which("fmusim"), "--interface-type", "cs", "--stop-time", str(STOP)]
    order += ["--output-interval", str(STEP), "--output-file", str(table)]
    for name, value in STARTS.items():
        order += ["--start-value", name, str(value)]
    done = subprocess.run([*order, str(made)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError((done.stdout + done.stderr).strip()[-200:])
    with table.open() as file:
        rows = list(csv.DictReader(file))
    times, slips = ([float(row[n]) for row in rows] for n in ("time", "slip"))
    lines = (done.stdout + done.stderr).splitlines()
    return measured(times, slips, float(rows[-1][TORQUE]), lines)


def c_loop(clutch: Path, plant: Path, exchange: str, scratch: Path) -> Found:
    """Compile lock_loop.c, run it; it takes the libraries from both FMUs by dlopen."""
    import fmpy  # for the headers of FMI
    from fmpy import extract, read_model_description

    fmi = version_of_fmi(clutch)
    program = scratch / "lock_loop"
    headers = Path(fmpy.__file__).parent / "c-code"
    source = Path(__file__).with_name("lock_loop.c")
    order = ["gcc", "-O2", "-w", f"-I{headers}", str(source), "-o", str(program), "-ldl"]
    subprocess.run(order, check=True)
    order = [str(program), str(fmi), exchange, str(STEPS), str(STEP), *map(str, STARTS.values())]
    kinds = {"Boolean": "b", "Integer": "i", "Int32": "i", "Real": "r", "Float64": "r"}
    extras: dict[str, str] = {}
    wanted = ([b for _, b in WIRES] + [*STARTS, TORQUE], [a for a, _ in WIRES] + ["torque"])
    for fmu, names in zip((clutch, plant), wanted, strict=True):
        known = read_model_description(str(fmu))
        by_name = {v.name: v for v in known.modelVariables}
        folder = Path(extract(str(fmu), str(scratch / fmu.stem)))
        platform = {2: "linux64", 3: "x86_64-linux"}[fmi]
        library = f"{known.coSimulation.modelIdentifier}.so"
        place = folder / "resources"
        order += [str(folder / "binaries" / platform / library), known.guid]
        order += [place.as_uri() if fmi == 2 else f"{place}/"]
        order += [str(by_name[n].valueReference) for n in names]
        extras |= {
            n: f"{kinds[by_name[n].type]}:{by_name[n].valueReference}"
            for n in EXTRAS
            if n in by_name
        }
    done = subprocess.run([*order, *extras.values()], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip()[-300:])
    lines = done.stdout.splitlines()
    end = next(k for k, line in enumerate(lines) if line.startswith("torque"))
    rows = [[float(value) for value in line.split()] for line in lines[:end]]
    times, slips = ([row[k] for row in rows] for k in (0, 1))
    more = dict(zip(extras, map(float, lines[end + 1 :]), strict=True))
    return measured(times, slips, float(lines[end].split()[1]), done.stderr.splitlines(), **more)


Run = Callable[[Path, Path, str, Path], Found]
# host: what runs it, the package whose version it is
HOSTS: dict[str, tuple[Run, str]] = {
    "FMPy": (fmpy, "fmpy"),
    "own C": (c_loop, "fmpy"),
    "FMPy, halving": (halving, "fmpy"),
    "FMPy, SSP": (fmpy_ssp, "fmpy"),
    "CoFMPy": (cofmupy, "cofmupy"),
    "PyFMI": (pyfmi, "pyfmi"),
    "libcosim": (libcosim, "libcosimpy"),
    "Ecos": (ecos, "ecospy"),
    "fmucontainer": (fmucontainer, "fmu-manipulation-toolbox"),
    "fmusim": (fmusim, "fmu-manipulation-toolbox"),
}


@contextmanager
def overheard(target: Path) -> Iterator[None]:
    """Write what this process and its libraries print into a file."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(k) for k in (1, 2)]
    with target.open("wb") as file:
        for k in (1, 2):
            os.dup2(file.fileno(), k)
        try:
            yield
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            for k, old in zip((1, 2), kept, strict=True):
                os.dup2(old, k)
                os.close(old)


def version(host: str, package: str) -> str:
    """Return the host's version."""
    if host == "own C":
        return ""
    if host == "fmusim":
        done = subprocess.run(["fmusim", "--version"], capture_output=True, text=True, check=False)
        return done.stdout.split()[1]
    return metadata.version(package)


def main() -> None:
    """Run what the command names."""
    host, clutch, plant, *rest = sys.argv[1:]
    exchange = rest[0] if rest else "parallel"
    run, package = HOSTS[host]
    what = {"host": host, "version": version(host, package)}
    what |= {"fmi": version_of_fmi(Path(clutch)), "exchange": exchange}
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        fmus = [Path(clutch).resolve(), Path(plant).resolve()]
        os.chdir(scratch)
        log = scratch / "said.txt"
        try:
            with overheard(log):
                found = run(*fmus, exchange, scratch)
        except Exception as error:
            found = {"failed": f"{type(error).__name__}: {error}"[:300], "messages": []}
        found["messages"] += warnings(log.read_text(errors="replace").splitlines())
    told(**what, **found)


if __name__ == "__main__":
    main()
