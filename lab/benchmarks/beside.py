"""What users wait for, of two versions beside each other: processor time and memory.

    git worktree add ../before v0.22.0
    python -m lab.benchmarks.beside [CASE ...] --before ../before [--runs 5] [--side 316]

Each case is a process of its own, of the folder and of this checkout in turn; medians of the
processor time of user and system, largest memory, and how much less time this checkout takes. The
first run of each is not counted: it builds FMUs. ``--side``: points along each of the two inputs
of a sweep. Without ``--before`` the cases are measured here alone. POSIX only.
"""

import argparse
import os
import statistics
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from lab.benchmarks.printed import table_head, table_row

HERE = Path(__file__).parents[2]
SWEEPS = {
    "clutch closed": ("clutch", {"load": "1 kN:9 kN:n{}", "speed": "1:200:n{}"}),
    "gearmesh field": ("gearmesh", {"power": "1000:9000:n{}", "speed": "50:500:n{}"}),
    "washer map": ("washer", {"load": "100:900:n{}", "speed": "300:1300:n{}"}),
}
SWEEP = (
    "from thrustwasher import run_sweep; "
    "run_sweep({!r}, {!r}, fidelity={!r}, out={!r}, workers=1, keep=False)"
)
FIRST = (
    "from thrustwasher import WasherParams, solve_washer; "
    "solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)"
)
# Peers: what a user would write with scipy alone. The film's equation on the washer's mesh, and an
# engagement (two speeds and a face's temperature) over one second.
FILM = """
import numpy as np, scipy.sparse as s, scipy.sparse.linalg as l
def ring(n): return s.diags([1, -2, 1, 1, 1], [-1, 0, 1, n - 1, 1 - n], (n, n))
radial = s.diags([1, -2, 1], [-1, 0, 1], (10, 10))
a = s.kron(s.identity(10), ring(32)) + s.kron(radial, s.identity(32))
a, b = a.tocsc(), np.ones(320)
for _ in range({}): l.spsolve(a, b)
"""
ENGAGEMENT = """
import numpy as np
from scipy.integrate import solve_ivp
def rates(t, x):
    slip = x[0] - x[1]
    torque = 60.0 * min(t / 0.1, 1.0) * np.tanh(slip / 0.1)
    return [-torque / 0.2, torque / 1.5, (torque * slip - 40.0 * (x[2] - 350.0)) / 300.0]
for _ in range({}): solve_ivp(rates, (0.0, 1.0), [200.0, 50.0, 350.0], method="LSODA", rtol=1e-6)
"""
OWN = """
from thrustwasher import WasherParams, solve_washer
p, point = WasherParams(), dict(speed=953.0, tilt=0.002)
start = solve_washer(p, load=300.0, **point)
for k in range({}): start = solve_washer(p, load=300.0 + 3.0 * (k % 2), start=start, **point)
"""
TIMES = 500  # that a peer's work is done in a process, less one that does it once


def cases(side: int) -> dict[str, list[str]]:
    """Return the words behind ``python`` of each case."""
    found = {
        "help": ["-m", "thrustwasher", "--help"],
        "import thrustwasher": ["-c", "import thrustwasher"],
        "first solve_washer": ["-c", FIRST],
        "shift": ["-m", "thrustwasher", "shift"],
        "shift --no-report": ["-m", "thrustwasher", "shift", "--no-report"],
    }
    for name, (model, over) in SWEEPS.items():
        given = {key: text.format(side) for key, text in over.items()}
        for suffix in (".csv", ".parquet"):
            code = SWEEP.format(model, given, name.split()[1], f"table{suffix}")
            found[f"{name} {suffix}"] = ["-c", code]
    return found


def peers() -> dict[str, str]:
    """Return the code of each peer, with the times that it does its work left open."""
    return {
        "scipy.sparse, one film solve": FILM,
        "solve_ivp, an engagement of 1 s": ENGAGEMENT,
        "solve_washer, load 1 % off, warm": OWN,
    }


def spent(words: list[str], source: Path, folder: str) -> tuple[float, float]:
    """Return processor time [s] and largest memory [MB] of a process."""
    settings = {**os.environ, "PYTHONPATH": str(source)}
    settings.pop("PYTHONDONTWRITEBYTECODE", None)  # users have compiled modules
    silent = subprocess.DEVNULL
    with subprocess.Popen(
        [sys.executable, *words], cwd=folder, env=settings, stdout=silent, stderr=silent
    ) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, words)
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0


def in_turn(words: list[str], sources: list[Path], runs: int) -> Iterator[tuple[float, float]]:
    """Give the medians of each source's time and memory."""
    found: list[list[tuple[float, float]]] = [[] for _ in sources]
    with TemporaryDirectory() as folder:
        for run in range(runs + 1):
            for kept, source in zip(found, sources, strict=True):
                one = spent(words, source, folder)
                if run:
                    kept.append(one)
    for kept in found:
        times, sizes = zip(*kept, strict=True)
        yield statistics.median(times), statistics.median(sizes)


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("cases", nargs="*", help="beginnings of names; default all")
    parser.add_argument("--before", type=Path, help="folder with the other version's package")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--side", type=int, default=316)
    given = parser.parse_args()
    sources = [HERE] if given.before is None else [given.before.resolve(), HERE]
    if not all((source / "thrustwasher").is_dir() for source in sources):
        parser.error(f"--before {given.before}: allowed: a folder with thrustwasher in it")
    chosen = tuple(given.cases)
    table_head("case", *(f"{s.name}: s, MB" for s in sources), "times less")
    for name, words in cases(given.side).items():
        if not chosen or name.startswith(chosen):
            found = list(in_turn(words, sources, given.runs))
            cells = [f"{seconds:.3f}, {size:.0f}" for seconds, size in found]
            table_row(name, *cells, f"{found[0][0] / found[-1][0]:.2f}")
    table_head("peer", "us of processor time")
    for name, code in peers().items():
        if not chosen or name.startswith(chosen):
            many, one = (
                next(in_turn(["-c", code.format(n)], [HERE], given.runs))[0] for n in (TIMES, 1)
            )
            table_row(name, f"{1e6 * (many - one) / (TIMES - 1):.3g}")


if __name__ == "__main__":
    main()
