"""Which lines and branches the tests walk through.

    python -m lab.benchmarks.covered all FOLDER [--below 90]

Compiled kernels leave no trace of their lines, so there are two kinds of runs. ``kernels FOLDER``:
the kernels' tests as plain Python (NUMBA_DISABLE_JIT), each file for 40 s at most (``cut_off``).
The suite, compiled, processes that it starts included, is run by whoever wants it, any part of it:

    python -m lab.benchmarks.covered start FOLDER
    python -m coverage run --rcfile=FOLDER/rc -m pytest
    python -m lab.benchmarks.covered kernels FOLDER
    python -m lab.benchmarks.covered report FOLDER --below 90

``all`` does just this. The report has lines and branches of the kernels, of the rest, of all
together, and every file below the limit; exit status 1 if the whole lies below it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
KERNELS = [
    "thrustwasher/numerics/*",
    "thrustwasher/tribology/*.py",
    "thrustwasher/tribology/holding/*.py",
    "thrustwasher/*/kernels/*",
    "thrustwasher/shift/cosim/compiled_loop.py",
]
# Minutes as plain Python, each; the tests on small meshes and of levels in short walk the same
# ways.
SLOW = {
    "test_transmission_shaft",
    "test_washer_film",
    "test_washer_heat",
    "test_washer_newton",
    "test_washer_directional_derivative",
    "test_washer_step",
    "test_washer_transient",
}
MORE = (
    "tests/core/model/test_rules.py",
    "tests/core/model/test_levels_in_short.py",
    "tests/core/model/test_status_numbers.py",
)
SETTINGS = """[run]
branch = True
source_pkgs = thrustwasher
parallel = True
patch = subprocess
data_file = {data}
relative_files = True
disable_warnings = module-not-imported, no-data-collected
[paths]
source = {root}
"""


def plain_files() -> list[Path]:
    """Return the tests that are run as plain Python."""
    folders = ("core/numerics", "core/tribology", "core/*/kernels")
    mine = sorted(p for f in folders for p in (ROOT / "tests").glob(f"{f}/test_*.py"))
    return [*(p for p in mine if p.stem not in SLOW), *(ROOT / p for p in MORE)]


def run_tests(rc: Path, *words: str, **environment: str) -> bool:
    """Run tests under measurement; False if one failed."""
    command = [sys.executable, "-m", "coverage", "run", f"--rcfile={rc}", "-m", "pytest", *words]
    return subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}).returncode == 0


def run_plain(rc: Path) -> bool:
    """Run the kernels' tests with the kernels as plain Python."""
    files = [str(path.relative_to(ROOT)) for path in plain_files()]
    how = ("--dist", "loadfile", "-p", "no:cacheprovider", "-p", "lab.benchmarks.cut_off")
    return run_tests(rc, *how, "-W", "ignore::RuntimeWarning", *files, NUMBA_DISABLE_JIT="1")


def share(rc: Path, *words: str) -> str:
    """Return lines and branches walked through, in per cent, of some files."""
    command = [sys.executable, "-m", "coverage", "report", f"--rcfile={rc}", "--precision=1"]
    done = subprocess.run(
        [*command, "--format=total", *words], cwd=ROOT, capture_output=True, text=True
    )
    return done.stdout.strip() or "0"


def low(rc: Path, below: float) -> list[str]:
    """Return the files below the limit, worst first."""
    command = [sys.executable, "-m", "coverage", "report", f"--rcfile={rc}", "--sort=cover"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    rows = [line.split() for line in done.stdout.splitlines() if line.startswith("thrustwasher")]
    return [f"{row[-1]:>5}  {row[0]}" for row in rows if float(row[-1].rstrip("%")) < below]


def start(folder: Path) -> None:
    """Write what coverage is told; every process that runs tests adds a file next to it."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rc").write_text(SETTINGS.format(data=folder.resolve() / "data", root=ROOT))


def report(folder: Path, below: float) -> int:
    """Join what was measured and print it."""
    rc = folder / "rc"
    combine = [sys.executable, "-m", "coverage", "combine", "-q", f"--rcfile={rc}"]
    subprocess.run(combine, cwd=ROOT, check=True)
    kernels, whole = ",".join(KERNELS), share(rc)
    print(f"lines and branches, kernels: {share(rc, f'--include={kernels}')} %")
    print(f"all but the kernels: {share(rc, f'--omit={kernels}')} %")
    print(f"together: {whole} %")
    print("\n".join(low(rc, below)))
    return int(float(whole) < below)


def main() -> int:
    """Do what the command line asks for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("part", choices=["start", "kernels", "report", "all"])
    parser.add_argument("folder", type=Path, help="where the measurements lie")
    parser.add_argument("--below", type=float, default=90.0, help="limit in per cent, default 90")
    given = parser.parse_args()
    rc = given.folder / "rc"
    if given.part in ("start", "all"):
        start(given.folder)
    good = True
    if given.part in ("kernels", "all"):
        good = run_plain(rc)
    if given.part == "all":
        good = run_tests(rc) and good
    low_share = report(given.folder, given.below) if given.part in ("report", "all") else 0
    return low_share or int(not good)


if __name__ == "__main__":
    sys.exit(main())
