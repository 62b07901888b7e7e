"""Scripts for host.c, a host that is no Python, in an environment of libpython and little else."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import fmpy
import pytest

from thrustwasher.fmu.stepper import unpack

HERE = Path(__file__).parent
LIBPYTHON = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("INSTSONAME"))
needs_host = pytest.mark.skipif(
    sys.platform != "linux" or not shutil.which("gcc") or ".so" not in LIBPYTHON.name,
    reason="needs Linux, gcc and a shared libpython",
)
_folder = tempfile.TemporaryDirectory(prefix="host")


@cache
def program():
    made = Path(_folder.name) / "host"
    headers = Path(fmpy.__file__).parent / "c-code"
    flags = f"-O2 -Wall -Wextra -Werror -I{headers}".split()
    command = ["gcc", *flags, HERE / "host.c", "-o", made, "-ldl"]
    subprocess.run(command, check=True, timeout=60)
    return made


@dataclass
class Said:
    """What a host printed: (call, status, values) of each call, the FMU's messages, its end."""

    calls: list
    messages: list
    code: int
    errors: str
    unloaded: bool = False

    def __getitem__(self, name):
        """Return the statuses of all calls of one name."""
        return [status for call, status, _ in self.calls if call == name]

    def values(self, name):
        return [values for call, _, values in self.calls if call == name]


def talk(fmu, *script, also=(), **environment):
    """Run a script on an FMU; ``also``: FMUs in the slots 1, 2, ...; return what was said."""
    lines = [load(fmu)]
    for slot, other in enumerate(also, 1):
        lines += [f"use {slot}", load(other)]
    text = "\n".join([*lines, "use 0", *script, ""])
    done = subprocess.run(
        [program()],
        input=text,
        env=bare(**environment),
        capture_output=True,
        text=True,
        timeout=300,
        cwd="/",
    )
    if "undefined symbol: Py" in done.stdout or "undefined symbol: _Py" in done.stdout:
        return Said([], [], done.returncode, done.stdout, unloaded=True)
    calls, messages = [], []
    for line in done.stdout.splitlines():
        if line.startswith("message "):
            messages.append(line[8:])
        elif words := line.split():
            calls.append((words[-2], int(words[-1]), words[:-2]))
    calls = [call for call in calls if call[0] not in ("load", "use")]
    return Said(calls, messages, done.returncode, done.stderr)


def load(fmu):
    folder = unpack(fmu)
    guid = re.search(r'guid="(\w+)"', (folder / "modelDescription.xml").read_text("utf-8"))[1]
    library = folder / "binaries" / "linux64" / f"{Path(fmu).stem}.so"
    return f"load {library} {guid} {(folder / 'resources').as_uri()}"


def bare(**changes):
    """Return the environment: this Python, its library, these sources, and nothing else."""
    found = {
        "PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin",
        "HOME": os.path.expanduser("~"),
        "PYTHONPATH": f"{HERE}:{HERE.parents[2]}",
        "PYTHONDONTWRITEBYTECODE": "1",
        "NUMBA_CACHE_DIR": os.environ.get("NUMBA_CACHE_DIR"),
        "NUMBA_DISABLE_JIT": os.environ.get("NUMBA_DISABLE_JIT"),
        "LD_PRELOAD": str(LIBPYTHON),
    }
    return {name: value for name, value in (found | changes).items() if value is not None}
