"""Judge how built FMUs hold drivelines: a table of rows, each with its share that is right.

    python -m lab.benchmarks.holding.judge [--seeds 24] [--first 0] [--rows NAME ...]
        [--holding identified|given|off] [--fmu FILE ...] [--out table.md]

Per row and FMU: runs that are right, those that are wrong without a word (silent), and those with
something that no unit may do (broken). Without ``--fmu`` today's units are built first. ``--list``
prints the rows; a row's name may be shortened, ``exact``, ``sensors``, ``slip``, ``gearbox``,
``rest`` and ``slow`` are groups. One run in detail: ``--rows "12 bit" --first 7 --seeds 1 --trace
run.csv``. ``--picture FILE`` draws slip and torque through sensors instead.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from .drive import run
from .rows_gearbox import GEARBOX
from .rows_plants import EXACT, SENSORS, Run
from .rows_rest import REST, SLOW
from .rows_slip import SLIP
from .units import model_of
from .verdict import Verdict, engagement

GROUPS: dict[str, dict[str, Run]] = {
    "exact": EXACT,
    "sensors": SENSORS,
    "slip": SLIP,
    "gearbox": GEARBOX,
    "rest": REST,
    "slow": SLOW,
}
UNITS = ("WetClutch", "ThrustWasher", "GearMesh", "GearTrain", "DrivelineLosses")
FAILURES = 12  # that are listed per row


def built(folder: Path, fmi: str, target: str) -> str:
    """Build today's units and return the pack's FMU."""
    order = [sys.executable, "-m", "thrustwasher", "build", *UNITS, "--out", str(folder)]
    more = ["--target", "python"] if target == "python" else ["--platforms", "local", "--fmi", fmi]
    subprocess.run([*order, *more], check=True, stdout=subprocess.DEVNULL)
    return str(next(folder.rglob("WetClutch.fmu")))


def chosen(names: Iterable[str]) -> dict[str, Run]:
    """Return the rows of these names, groups and beginnings; all but the slow ones by default."""
    rows = {name: run for group in GROUPS.values() for name, run in group.items()}
    if not names:
        return {name: run for name, run in rows.items() if name not in SLOW}
    found: dict[str, Run] = {}
    for name in names:
        some = GROUPS.get(name) or {k: v for k, v in rows.items() if k == name}
        some = some or {k: v for k, v in rows.items() if k.startswith(name)}
        if not some:
            raise SystemExit(f"--rows {name!r}: no such row; --list prints them")
        found |= some
    return found


def share(verdicts: list[Verdict], what: str) -> str:
    """Return a share in percent, exact where it is none or all."""
    count = sum(bool(getattr(v, what)) for v in verdicts)
    return f"{100 * count / len(verdicts):.3g}" if verdicts else ""


def lines(given: argparse.Namespace, fmus: list[str]) -> Iterator[str]:
    """Yield the table row by row, then what failed."""
    labels = [f"{model_of(f).version}, FMI {model_of(f).fmi}" for f in fmus]
    heads = [f"{x}: ok % | silent % | broken %" for x in labels]
    yield f"holding = {given.holding}, seeds {given.first} .. {given.first + given.seeds - 1}, "
    yield f"{'any step' if given.step <= 0 else f'step {given.step * 1e3:g} ms'}\n"
    yield f"| row | {' | '.join(heads)} |"
    yield f"|---|{'---|' * 3 * len(fmus)}"
    failures: list[str] = []
    heats: list[str] = []
    for name, row in chosen(given.rows).items():
        cells = []
        for fmu, label in zip(fmus, labels, strict=True):
            start, found = time.process_time(), []
            for seed in range(given.first, given.first + given.seeds):
                some = row(fmu, seed, given.holding, given.step)
                found += [(seed, verdict) for verdict in some]
            verdicts = [verdict for _, verdict in found]
            cells += [share(verdicts, what) for what in ("ok", "silent", "broken")]
            if verdicts and "end" in verdicts[0].numbers:
                least = {k: min(v.numbers[k] for v in verdicts) for k in ("end", "least")}
                within = sum(abs(v.numbers["end"] - 1) <= 0.01 for v in verdicts) / len(verdicts)
                heats.append(
                    f"| {name}, {label} | {least['end']:.3g} | {100 * within:.3g} | "
                    f"{least['least']:.3g} |"
                )
            bad = [(s, v) for s, v in found if not v.ok or v.broken]
            if bad:
                failures.append(f"\n{name}, {label} ({len(bad)} of {len(found)}):\n")
            for seed, v in bad[:FAILURES]:
                word = "" if v.ok else ("told" if v.told else "SILENT")
                failures.append(f"- seed {seed}: {word} {v.why} {v.broken and f'[{v.broken}]'}")
            if given.verbose:
                print(f"{name}: {time.process_time() - start:.1f} s", file=sys.stderr, flush=True)
        yield f"| {name} | {' | '.join(cells)} |"
    if heats:
        yield "\n| heat over sliding's | least at the end | within 1 %, % | least on the way |"
        yield "|---|---|---|---|"
        yield from heats
    if given.failures:
        yield from failures


def traced(given: argparse.Namespace, fmu: str) -> None:
    """Write one run of a scene as CSV and print its verdict and messages."""
    name, row = next(iter(chosen(given.rows).items()))
    if not hasattr(row, "scene"):
        raise SystemExit(f"--trace: {name!r} has no single scene; rows of exact and sensors have")
    scene = row.scene(given.first, given.step)
    trace = run(fmu, scene, row.holding or given.holding)
    verdict = engagement(scene, trace)
    trace.write(given.trace)
    print(f"{name}, seed {given.first}: {'ok' if verdict.ok else verdict.why}, {verdict.numbers}")
    print(f"capacity {scene.capacity:.6g} N m, inertia {scene.inertia}, age {scene.age}")
    print(f"first slip {scene.first:.6g} rad/s, slip per step {scene.per_step:.4g} rad/s")
    print(*trace.messages, sep="\n")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=int, default=24)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--rows", nargs="+", default=[], metavar="NAME")
    parser.add_argument("--holding", choices=("identified", "given", "off"), default="identified")
    parser.add_argument("--fmu", nargs="+", default=[], help="WetClutch.fmu, the others beside it")
    parser.add_argument("--fmi", choices=("2", "3"), default="2")
    parser.add_argument("--target", choices=("native", "python"), default="native")
    parser.add_argument("--step", type=float, default=1e-3, help="s; 0: any; default 1e-3")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--failures", action="store_true", help="list what failed below the table")
    parser.add_argument("--trace", type=Path, help="write one run as CSV")
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--verbose", action="store_true", help="seconds of each row")
    given = parser.parse_args()
    if given.list:
        for group, rows in GROUPS.items():
            print(f"{group}: {'; '.join(rows)}")
        return
    with tempfile.TemporaryDirectory() as scratch:
        fmus = given.fmu or [built(Path(scratch), given.fmi, given.target)]
        if given.trace:
            traced(given, fmus[0])
            return
        if given.picture:
            from .picture import draw

            draw(fmus, given.picture)
            return
        file = given.out.open("w") if given.out else None
        for line in lines(given, fmus):
            print(line, flush=True)
            if file:
                print(line, file=file, flush=True)


if __name__ == "__main__":
    main()
