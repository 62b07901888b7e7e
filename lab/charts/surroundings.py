"""What a chart or a table says about its making: the machine, versions, state of the sources."""

import os
import platform
import subprocess
import sys
import time
import timeit
from contextlib import suppress
from importlib import metadata
from pathlib import Path
from typing import Any

SCHEMA = 1
LOOP = "for i in range(200_000): x += i * 0.5"  # its seconds say what one is worth here
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def surroundings(command: str) -> dict[str, Any]:
    """Return command, date, machine and versions, as JSON types."""
    from thrustwasher import __version__
    from thrustwasher.numerics.jit import kernel_digest
    from thrustwasher.studio.verification.costs import cpu

    return {
        "schema": SCHEMA,
        "command": command,
        "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "machine": {
            "cpu": cpu(),
            "cores": os.cpu_count(),
            "os": platform.platform(terse=True),
            "python": platform.python_version(),
            "numpy": metadata.version("numpy"),
            "numba": metadata.version("numba"),
            "compiled": not os.environ.get("NUMBA_DISABLE_JIT"),
            "threads": {name: os.environ.get(name) for name in THREADS},
            "load": round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None,
        },
        "package": {"version": __version__, "kernels": kernel_digest(), **_commit()},
        "calibration_s": min(timeit.repeat(LOOP, "x = 0.0", number=1)),
    }


def pin_threads() -> None:
    """Hold every library that is not loaded yet to one thread."""
    for name in THREADS:
        if "numpy" not in sys.modules or name.startswith("NUMBA"):
            os.environ.setdefault(name, "1")


def _commit() -> dict[str, Any]:
    """Return the commit of a checkout and if its files differ from it; None where there is none."""
    folder = Path(__file__).parents[2]

    def git(*words: str) -> str:
        done = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True)
        return done.stdout.strip()

    if (folder / ".git").exists():
        with suppress(OSError):  # no git
            changes = git("status", "--porcelain", "--untracked-files=no")
            return {"commit": git("rev-parse", "HEAD")[:12] or None, "dirty": bool(changes)}
    return {"commit": None, "dirty": None}
