"""A pack that locks between two inertias, in every host that is here: a table in Markdown.

python lock_run.py FOLDER [--bin FOLDER ...] [--only HOST ...] [--json FILE]

FOLDER has native-fmi2/WetClutch.fmu and native-fmi3/WetClutch.fmu, as ``thrustwasher build`` writes
them; FOLDER may also be an FMU. Programs and Pythons with a host's package are looked for on PATH
and in the folders of --bin. The plant is compiled on the way. Torques that hold the pack are those
with which both sides speed up alike: 89.57 N m.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
DESCRIPTION = "modelDescription.xml"
TIMEOUT = 300  # s, for one run
EACH = ("parallel", "clutch first", "plant first")
# host, package it needs, program it needs, versions of FMI, exchanges
RUNS = [
    ("FMPy", "fmpy", "", (2, 3), EACH),
    ("FMPy", "fmpy", "", (3,), ("parallel, events", "clutch first, events")),
    ("FMPy, halving", "fmpy", "", (2, 3), EACH),
    ("FMPy, SSP", "fmpy", "", (2,), ("parallel",)),
    ("own C", "fmpy", "gcc", (2, 3), EACH),
    ("libcosim", "libcosimpy", "", (2,), ("parallel",)),
    ("Ecos", "ecospy", "", (2, 3), ("parallel",)),
    ("PyFMI", "pyfmi", "", (2,), ("parallel", "linear correction")),
    ("PyFMI", "pyfmi", "", (2,), ("error controlled", "error controlled, linear correction")),
    ("CoFMPy", "cofmupy", "", (2, 3), ("parallel", "serial")),
    ("CoFMPy", "cofmupy", "", (2, 3), ("parallel, iterated", "serial, iterated")),
    ("fmucontainer", "fmu-manipulation-toolbox", "", (2, 3), EACH),
    ("fmusim", "fmu-manipulation-toolbox", "fmusim", (2, 3), ("parallel", "clutch first")),
]
COLUMNS = "host | version | FMI | exchange | reversals | locked at | torque at the end"
COLUMNS += " | largest slip late | more | messages"
USUAL = ("host", "version", "fmi", "exchange", "reversals", "lock", "torque", "late", "end")


def has(python: Path, package: str) -> bool:
    """Tell whether this Python has the package."""
    ask = f"from importlib.metadata import version; version({package!r})"
    return subprocess.run([python, "-c", ask], capture_output=True, check=False).returncode == 0


def clutch_of(folder: Path, fmi: int) -> Path | None:
    """Return the clutch's FMU of a version of FMI; None if it is not here."""
    fmu = folder if folder.is_file() else folder / f"native-fmi{fmi}" / "WetClutch.fmu"
    if not fmu.exists():
        return None
    with zipfile.ZipFile(fmu) as archive:
        return fmu if f'fmiVersion="{fmi}'.encode() in archive.read(DESCRIPTION) else None


def ran(python: Path, host: str, clutch: Path, plant: Path, exchange: str) -> dict[str, Any]:
    """Run the scene in a host; return what it came to."""
    order = [str(python), str(HERE / "lock_hosts.py"), host, str(clutch), str(plant), exchange]
    failed = {"host": host, "version": "", "exchange": exchange, "messages": []}
    try:
        done = subprocess.run(order, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    except subprocess.TimeoutExpired:
        return failed | {"failed": f"not at its end after {TIMEOUT} s"}
    try:
        return json.loads(done.stdout.splitlines()[-1])
    except (IndexError, json.JSONDecodeError):
        last = (done.stderr.strip().splitlines() or ["nothing said"])[-1]
        return failed | {"failed": f"exit {done.returncode}: {last[:200]}"}


def row(found: dict[str, Any]) -> str:
    """Return a run as a row of the table."""
    head = [found["host"], found["version"], str(found["fmi"]), found["exchange"]]
    told = found["messages"]
    said = f"{len(told)}, first: `{told[0][:110]}`".replace("|", "/") if told else "none"
    if "failed" in found:
        return " | ".join([*head, found["failed"], "", "", "", "", said])
    lock = "never" if found["lock"] is None else f"{found['lock']:.6f} s"
    more = {k: v for k, v in found.items() if k not in (*USUAL, "messages")}
    numbers = [str(found["reversals"]), lock, f"{found['torque']:.4f} N m"]
    numbers.append(f"{found['late']:.2g} rad/s")
    words = ", ".join(f"{k} {v:.6g}" for k, v in more.items())
    return " | ".join([*head, *numbers, words, said])


def main() -> None:
    """Run all hosts."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--bin", type=Path, nargs="*", default=[])
    parser.add_argument("--only", nargs="*", choices=sorted({run[0] for run in RUNS}))
    parser.add_argument("--json", type=Path, help="write the runs into this file too")
    given = parser.parse_args()
    os.environ["PATH"] = os.pathsep.join([*map(str, given.bin), os.environ["PATH"]])
    places = [folder / "python" for folder in given.bin]
    pythons = [place for place in places if place.exists()] + [Path(sys.executable)]
    print(f"| {COLUMNS} |\n|{'---|' * len(COLUMNS.split(' | '))}")
    all_found = []
    with tempfile.TemporaryDirectory() as scratch:
        for host, package, program, versions, exchanges in RUNS:
            if given.only and host not in given.only:
                continue
            python = next((p for p in pythons if has(p, package)), None)
            if python is None or (program and not shutil.which(program)):
                print(f"| {host} | not installed |{' |' * 8}", flush=True)
                continue
            for fmi in versions:
                clutch = clutch_of(given.folder, fmi)
                if clutch is None:
                    continue
                plant = Path(scratch) / f"fmi{fmi}" / "TwoInertias.fmu"
                if not plant.exists():
                    order = [python, HERE / "plant.py", scratch]
                    subprocess.run(order, check=True, capture_output=True)
                for exchange in exchanges:
                    found = ran(python, host, clutch, plant, exchange)
                    all_found.append({"fmi": fmi} | found)
                    print(f"| {row(all_found[-1])} |", flush=True)
    if given.json:
        given.json.write_text("".join(json.dumps(found) + "\n" for found in all_found))


if __name__ == "__main__":
    main()
