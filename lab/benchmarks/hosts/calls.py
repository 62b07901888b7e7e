"""Calling other hosts' programs: where they lie, what they say, what their tables hold."""

import csv
import os
import re
import shutil
import subprocess
import zipfile
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from fmpy import read_model_description

PACKAGES = {2: "planetary.ssp", 3: "planetary-fmi3.ssp"}
TIMEOUT = 900  # s, for one call of a host


class Failed(Exception):
    """A host did not come to an end; what it said last."""


class Row(NamedTuple):
    """What a host did: FMI version, what was run, what came out, what it said."""

    fmi: int
    ran: str
    result: str
    messages: str = "none"


Table = dict[float, dict[str, float]]


class Bench:
    """The folder of FMUs, where hosts are looked for, and what FMPy made of each FMU."""

    def __init__(self, folder: Path, places: list[Path], scratch: Path) -> None:
        self.folder, self.scratch = folder.resolve(), scratch
        self.path = os.pathsep.join([*map(str, places), os.environ["PATH"]])
        self.pythons = [p for p in (f / "python" for f in places) if p.exists()] + [Path("python")]

    def program(self, name: str) -> str | None:
        """Return where the program lies; None if it is not here."""
        return shutil.which(name, path=self.path)

    @cache  # noqa: B019
    def python(self, package: str) -> tuple[Path, str] | None:
        """Return a Python that has the package, and the package's version."""
        ask = f"from importlib.metadata import version; print(version({package!r}))"
        for python in self.pythons:
            done = subprocess.run([python, "-c", ask], capture_output=True, text=True, check=False)
            if done.returncode == 0:
                return python, done.stdout.strip()
        return None

    def fmus(self, fmi: int, *, plain: bool = False) -> list[Path]:
        """Return the FMUs of a version of FMI, or those of FMI 2 with numbers alone."""
        folder = "plain" if plain else f"native-fmi{fmi}"
        return sorted((self.folder / folder).glob("*.fmu"))

    def package(self, fmi: int) -> Path | None:
        """Return the shift's package with FMUs of a version of FMI; None if there is none."""
        package = self.folder / PACKAGES[fmi]
        return package if package.exists() else None

    def plain_package(self, fmi: int) -> Path:
        """Return a package of the shift without values and outputs of its own."""
        target = self.scratch / f"plain-{PACKAGES[fmi]}"
        with zipfile.ZipFile(self.folder / PACKAGES[fmi]) as given:
            kept = {name: given.read(name) for name in given.namelist()}
        kept["SystemStructure.ssd"] = kept.pop("Parts.ssd")
        with zipfile.ZipFile(target, "w") as made:
            for name, content in kept.items():
                made.writestr(name, content)
        return target

    def inputs(self, fmu: Path) -> str:
        """Return the file with the inputs of the FMU's reference results; '' if it has none."""
        target = self.scratch / f"{fmu.parent.name}-{fmu.stem}-in.csv"
        with zipfile.ZipFile(fmu) as archive:
            for name in archive.namelist():
                if name.endswith("_in.csv"):
                    target.write_bytes(archive.read(name))
                    return str(target)
        return ""

    def held(self, fmu: Path) -> str:
        """Return the same inputs as jumps: each row's values stay until the next."""
        given, target = (
            Path(self.inputs(fmu)),
            self.scratch / f"{fmu.parent.name}-{fmu.stem}-held.csv",
        )
        head, *rows = [line.split(",") for line in given.read_text().split()]
        ends = [[b[0], *a[1:]] for a, b in pairwise(rows)]
        kept = [row for pair in zip(rows, [*ends, []], strict=True) for row in pair if row]
        target.write_text("\n".join(map(",".join, [head, *kept])) + "\n")
        return str(target)


def said(text: str) -> str:
    """Return the lines that tell of errors and warnings: how many, and the first."""
    lines = [
        line.strip() for line in text.splitlines() if re.search("error|warn|fatal", line, re.I)
    ]
    real = [line for line in lines if not re.search(r"\b(0|no)\b.{0,20}(error|warn)", line, re.I)]
    return f"{len(real)}, first: `{real[0][:110]}`" if real else "none"


def called(*command: object, folder: Path | None = None) -> tuple[str, str]:
    """Run a program; return what it wrote to its output, and all it said."""
    order = [str(c) for c in command]
    done = subprocess.run(
        order, capture_output=True, text=True, cwd=folder, timeout=TIMEOUT, check=False
    )
    told = done.stdout + done.stderr
    if done.returncode:
        lines = [line.strip() for line in told.splitlines() if line.strip()] or ["nothing said"]
        named = [line for line in lines if re.search("error|exception", line, re.I)] or lines
        last = re.sub(r"(?<=\s)/\S*/(?=\S)", "", named[-1])  # no folders of this machine
        raise Failed(f"exit {done.returncode}: `{last[:110]}`")
    return done.stdout, told


def read(path: Path) -> Table:
    with path.open() as file:
        rows = csv.DictReader(line for line in file if line.strip())
        return {
            round(float(row["time"]), 9): {
                name: float(value)
                for name, value in row.items()
                if name != "time" and number(value)
            }
            for row in rows
        }


def number(text: str | None) -> bool:
    try:
        return text is not None and float(text) == float(text)
    except ValueError:
        return False


def experiment(fmu: Path) -> tuple[float, float]:
    """Return step and stop time [s] of the FMU's default experiment."""
    found = read_model_description(str(fmu)).defaultExperiment
    return float(found.stepSize), float(found.stopTime)


def nominals(fmu: Path) -> dict[str, float]:
    """Return the nominal values of the FMU's outputs."""
    found = {}
    for variable in read_model_description(str(fmu)).modelVariables:
        given = variable.nominal or getattr(variable.declaredType, "nominal", None)
        found[variable.name] = float(given or 1.0)
    return found


def difference(a: Table, b: Table, nominal: dict[str, float]) -> tuple[float, str]:
    """Return the largest difference over an output's largest or nominal value, and the output."""
    times = a.keys() & b.keys()
    worst = (0.0, "")
    for name in next(iter(a.values())).keys() & next(iter(b.values())).keys():
        size = max(nominal.get(name, 1.0), *(abs(a[t][name]) for t in times))
        far = max(abs(a[t][name] - b[t][name]) for t in times)
        worst = max(worst, (far / size, name))
    return worst
