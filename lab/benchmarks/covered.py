"""Which lines and branches the tests walk through.

    python -m lab.benchmarks.covered all FOLDER [--below 90]
    python -m lab.benchmarks.covered plain

Compiled kernels leave no trace of their lines, so there are two kinds of runs: the suite as it is,
processes that it starts included, and the kernels' tests as plain Python (NUMBA_DISABLE_JIT), each
file for 40 s at most (``cut_off``). ``all`` does both and prints lines and branches of the kernels,
of the rest, of all together, and every file below the limit; exit status 1 if the whole lies below.

``plain`` does not measure: the kernels' tests as plain Python, each file for 20 s at most. They run
two to three times as fast like this, which is why CI takes it.
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


def run_tests(rc: Path | None, *words: str, **environment: str) -> bool:
    """Run tests, under measurement if there are settings for it; False if one failed."""
    measured = [] if rc is None else ["-m", "coverage", "run", f"--rcfile={rc}"]
    command = [sys.executable, *measured, "-m", "pytest", *words]
    return subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}).returncode == 0


def run_plain(rc: Path | None, limit: float) -> bool:
    """Run the kernels' tests with the kernels as plain Python, each file up to a limit [s]."""
    files = [str(path.relative_to(ROOT)) for path in plain_files()]
    how = ("--dist", "loadfile", "-p", "no:cacheprovider", "-p", "lab.benchmarks.cut_off")
    words = (*how, f"--cut-off={limit}", "-W", "ignore::RuntimeWarning", *files)
    return run_tests(rc, *words, NUMBA_DISABLE_JIT="1")


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


def measure(folder: Path, below: float) -> int:
    """Run everything under measurement and report it."""
    start(folder)
    rc = folder / "rc"
    good = run_plain(rc, 40.0)
    good = run_tests(rc) and good
    return report(folder, below) or int(not good)


def main() -> int:
    """Do what the command line asks for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("part", choices=["plain", "all"])
    parser.add_argument("folder", type=Path, nargs="?", help="where the measurements lie")
    parser.add_argument("--below", type=float, default=90.0, help="limit in per cent, default 90")
    given = parser.parse_args()
    if given.part == "plain":
        return int(not run_plain(None, 20.0))
    if given.folder is None:
        parser.error("all: needs a folder")
    return measure(given.folder, given.below)


if __name__ == "__main__":
    sys.exit(main())
