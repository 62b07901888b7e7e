"""Abuse in numbers: millions of random steps, random calls, spoiled files, full disks, signals.

    python -m lab.benchmarks.abuse [--seed 1] [--quick] [--out docs/faults.md]

Every campaign counts what was answered right, what was refused by name and what was lost: a wrong
answer, a failure without a name, a number that is none, work that is gone. ``tests/core/abuse``
runs the same campaigns with few examples. Needs Linux and gcc; exit status 1 if anything was lost.
"""

from __future__ import annotations

import argparse
import os
import platform
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "Agg")
sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "core" / "abuse"))

import calls
import damage
import files

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.build import build
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.fmu_cache import fmu_paths
from thrustwasher.fmu.running.loading import description, unpack
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec
from thrustwasher.numerics.jit import kernel_digest
from thrustwasher.tribology.holding.parameters import HOLDING
from thrustwasher.washer.map.map_plan import DEFAULT_BOX

HERE = Path(__file__)
KINDS = ("native-fmi2", "native-fmi3", "python-fmi2")
# model, level, steps, share of jumps, narrower ranges of the inputs
SOAK = (
    ("gearmesh", "field", 3_000_000, 0.5, {}),
    ("gearmesh", "fine", 2_000_000, 0.5, {}),
    ("transmission", "", 3_000_000, 0.5, {}),
    ("clutch", "closed", 500_000, 0.1, {}),
    ("clutch", "field", 100_000, 0.1, {}),
    ("washer", "map", 700_000, 0.1, DEFAULT_BOX),
    ("washer", "field", 10_000, 0.002, DEFAULT_BOX),
)
CALLS = (("clutch", 20_000), ("gearmesh", 40_000), ("washer", 2_000))
FILES = (
    ("Scenes", 5_000),
    ("Cards", 3_000),
    ("Maps", 5_000),
    ("SweepJournals", 1_000),
    ("MapJournals", 3_000),
)
DEAF = 60.0  # s: a command that goes on so long after a signal is lost


PAGE = """# Faults tried

Random calls, corrupted files, full disks and signals; `{command}` writes this page.
Kernels {kernels}, {machine}, numba {numba}, Python {python}; seed {seed}, {seconds:.0f} s.
`tests/core/abuse` runs the same campaigns with few examples.

| result | count | meaning |
|---|---|---|
| right | {right} | finite numbers that balance; after a step is taken back the same bits again |
| refused | {refused} | one line that names the cause; instance, file and earlier work unharmed |
| **lost** | **{lost}** | anything else |

| fault | tried | right | refused | lost |
|---|---|---|---|---|
{table}

- **Steps** run in a C program. Inputs move and jump over the whole legal range (washer `map` and
  `field`: over the map's); one step in 32 gets a value that must be refused. A process that grows
  by more than 64 kB counts as lost.
- **Corrupted** files have bits flipped, pieces lost, doubled or moved, numbers replaced. What is
  accepted must be valid; with a checksum, exactly what was written.
- **Signals**: Ctrl-C (status 130) or SIGTERM (143); a journal or nothing is left.
"""

GROUPS = (  # words of the page, what its faults have in their names
    ("native FMUs, steps with random inputs", "steps with random inputs"),
    ("one point, random parameters", "point and fidelity level"),
    ("FMUs: set, step, roll back, reset at random", "roll back"),
    ("eight steps, random parameters", "eight steps"),
    ("corrupted FMU states", "spoiled state of"),
    ("corrupted files (scenes, tables, maps, journals, measured points, FMUs)", "spoiled"),
    ("signals during commands", "signals during"),
    ("output on a full disk", "output on a disk"),
)


@dataclass
class Row:
    """One line of the table."""

    fault: str
    tried: int = 0
    right: int = 0
    refused: int = 0
    lost: list[str] = field(default_factory=list)
    note: str = ""
    seconds: float = 0.0


def campaign(fault: str, deed: Callable[[random.Random], str], n: int, seed: int) -> Row:
    """Do a random deed ``n`` times; what raises is lost, with the number that repeats it."""
    row, ends, began = Row(fault, n), Counter[str](), time.perf_counter()
    for i in range(n):
        try:
            ends[deed(random.Random(f"{seed}/{i}"))] += 1
        except Exception as error:  # lost, whatever it is: that is the point
            row.lost.append(f"{seed}/{i}: {type(error).__name__}: {str(error)[:300]}")
    row.right = ends[calls.RIGHT]
    row.refused = ends[calls.REFUSED] + ends[calls.UNSOLVED]
    if ends[calls.UNSOLVED]:
        row.note = f"{ends[calls.UNSOLVED]} without a solution, by name"
    row.seconds = time.perf_counter() - began
    return row


def compiled(folder: Path) -> Path:
    """Return the program of abuse.c."""
    import fmpy

    headers = Path(fmpy.__file__).parent / "c-code"
    program = folder / "abuse"
    subprocess.run(
        [
            "gcc",
            "-std=gnu99",
            "-O2",
            f"-I{headers}",
            HERE.with_suffix(".c"),
            "-o",
            program,
            "-ldl",
            "-lm",
        ],
        check=True,
    )
    return program


def soak(
    program: Path,
    model: str,
    level: str,
    n: int,
    jumps: float,
    box: dict[str, tuple[float, float]],
    seed: int,
) -> Row:
    """Step a native FMU for a long time."""
    spec = find_spec(model)
    folder = unpack(fmu_paths([spec.name], "native")[spec.name])
    found = interface(spec).variables
    ins = [v for v in found if v.causality == "input"]
    outs = [v for v in found if v.causality == "output" and v.type == "Real"]
    names, places = [v.name for v in ins], [v.name for v in outs]
    chosen = {"fidelity": list(spec.fidelities).index(level) + 1} if level else {}
    words: list[object] = [-1, -1]
    if "friction_torque" in places:
        # Random speeds are no driveline: friction that holds one would drive at times.
        words = [names.index("speed"), places.index("friction_torque")]
        chosen["holding"] = list(HOLDING).index("off") + 1
    words.append(len(chosen))
    for v in found:
        if v.name in chosen:
            words += [v.reference, chosen[v.name]]
    words.append(len(ins))
    for v in ins:
        words += [v.reference, v.low, v.high, *box.get(v.name, (v.low, v.high))]
    words += [len(outs), *(v.reference for v in outs)]
    library = folder / "binaries" / "linux64" / f"{spec.name}.so"
    began = time.perf_counter()
    done = subprocess.run(
        [
            program,
            library,
            description(folder).guid,
            (folder / "resources").as_uri(),
            str(n),
            str(seed),
            str(jumps),
        ],
        input=" ".join(map(str, words)),
        capture_output=True,
        text=True,
        env={},
    )
    row = Row(
        f"{spec.name} {level}, steps with random inputs".replace(" ,", ","),
        seconds=time.perf_counter() - began,
    )
    if done.returncode:
        row.tried, row.lost = n, [f"exit status {done.returncode}: {done.stderr}"]
        return row
    right, refused, unsolved, lost, rolled, spoiled, early, late = map(int, done.stdout.split())
    row.tried, row.right, row.refused = n + refused, right, refused + unsolved
    row.lost = done.stderr.splitlines() + [""] * max(0, lost - 5)
    if late - early > 64:
        row.lost.append(f"memory grew by {late - early} kB")
    row.note = f"{rolled} taken back, {spoiled} spoiled states, memory +{late - early} kB" + (
        f", {unsolved} without a solution, by name" if unsolved else ""
    )
    return row


class States:
    """Serialised states: refused, or the state that was written; the run goes on in any case.

    ``telling``: outputs by which a refusal is told, where no call can return an error.
    """

    def __init__(self, instance: Instance, others: list[bytes], telling: tuple[str, ...]) -> None:
        self.telling = telling
        self.instance, self.others = instance, others
        instance.initialize()
        instance.step(0.0, 1e-3)
        self.state = instance.get_state()
        self.whole = instance.serialize(self.state)
        self.outputs = self._shown()

    def _shown(self) -> dict[str, float]:
        named = zip(self.instance.output_names, self.instance.outputs(), strict=True)
        return {name: value for name, value in named if name not in self.telling}

    def __call__(self, rng: random.Random) -> str:
        """Spoil the bytes of the state, or take another's; return how it ended."""
        foreign = self.others and rng.random() < 0.1
        data = rng.choice(self.others) if foreign else damage.bits(rng, self.whole)
        result = calls.RIGHT
        try:
            found = self.instance.deserialize(data)
            self.instance.set_state(found)
            same = self.instance.serialize(found) == self.whole
            calls.say_if_wrong([] if same and not foreign else ["another state"])
            self.instance.free_state(found)
        except (ParameterError, SolveError) as error:
            result = files.one_line(error, "FMU state")
        calls.say_if_wrong([] if self._shown() == self.outputs else ["outputs have changed"])
        self.instance.set_state(self.state)
        self.instance.step(0.001, 1e-3)
        self.instance.set_state(self.state)
        return result


def fmu_of(model: str, kind: str, folder: Path) -> Path:
    target, fmi = kind.split("-fmi")
    name = find_spec(model).name
    if fmi == "2":
        return fmu_paths([name], target)[name]
    return build([name], target=target, fmi=int(fmi), out=folder, local=True)[0]


def walks(folder: Path, scale: float, seed: int) -> Iterator[Row]:
    """Yield wild masters on FMUs of both targets and versions, and on random parameters."""
    for model, level, n in (
        ("clutch", "", 3000),
        ("gearmesh", "", 6000),
        ("transmission", "", 6000),
        ("washer", "map", 3000),
        ("washer", "field", 60),
    ):
        spec = find_spec(model)
        for kind in KINDS:
            if model == "washer" and kind == "native-fmi3":
                continue  # the same library but for the names of its functions
            given = {"fidelity": level} if level else {}
            with Instance(fmu_of(model, kind, folder), parameters=given) as instance:
                walk = calls.Walk(spec, instance)

                def move(rng: random.Random, walk: calls.Walk = walk) -> str:
                    before = dict(walk.counts)
                    walk.move(rng)
                    return next(k for k in walk.counts if walk.counts[k] > before[k])

                name = f"{spec.name} {level}".strip()
                yield campaign(
                    f"{name}, {kind}: set, step, roll back, reset at random",
                    move,
                    max(10, round(scale * n)),
                    seed,
                )
    for model in ("clutch", "gearmesh", "transmission"):

        def run(rng: random.Random, model: str = model) -> str:
            return calls.run_once(model, rng, lambda s, p: DirectInstance(s, parameters=p))

        yield campaign(
            f"{find_spec(model).name}, random parameters, eight steps each",
            run,
            round(scale * 2000),
            seed,
        )


def spoiled(folder: Path, scale: float, seed: int) -> Iterator[Row]:
    """Yield files of every kind, damaged."""
    for kind, n in FILES:
        place = folder / kind
        place.mkdir()
        deed = getattr(files, kind)(place)
        what = deed.__doc__.split(":")[0].lower()
        yield campaign(f"spoiled {what}", deed, round(scale * n), seed)
    measured = Path(files.__file__).with_name("measured.csv").read_bytes()
    yield campaign(
        "spoiled measured points, calibrated",
        files.Calibrations(folder, measured),
        round(scale * 150),
        seed,
    )
    record = files.chart_record()
    yield campaign(
        "spoiled chart.json, drawn", files.Charts(folder, record), round(scale * 150), seed
    )
    yield campaign(
        "spoiled FMU, unpacked",
        files.Archives(folder, fmu_of("gearmesh", "native-fmi2", folder)),
        round(scale * 1000),
        seed,
    )
    clutch = find_spec("clutch")
    other = DirectInstance(find_spec("transmission"))
    other.initialize()
    foreign = [other.serialize(other.get_state()), b""]
    for kind in KINDS:
        with Instance(fmu_of("clutch", kind, folder)) as instance:
            telling = ("solver_status",) if kind.startswith("python") else ()
            states = States(instance, foreign, telling)
            fault = f"spoiled state of {clutch.name}, {kind}"
            yield campaign(fault, states, round(scale * 10_000), seed)


def ended(
    words: list[str], folder: Path, delay: float, numbers: tuple[int, ...], **environment: str
) -> tuple[int, str]:
    """Start a command, signal it after a while; return its status and what it said."""
    running = subprocess.Popen(
        [sys.executable, "-m", "thrustwasher", *words],
        cwd=folder,
        text=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        env={**os.environ, **environment},
    )
    time.sleep(delay)
    for number in numbers:
        if running.poll() is None:
            os.killpg(running.pid, number)
            time.sleep(0.02)
    try:
        said = running.communicate(timeout=DEAF)[1]
    except subprocess.TimeoutExpired:
        os.killpg(running.pid, signal.SIGKILL)
        return -1, running.communicate()[1]
    return running.returncode, said


def complaints(said: str) -> list[str]:
    """Return the lines on standard error that are no progress."""
    return [x for x in said.splitlines() if not x.startswith(("built", "compil", "the f"))]


COMMANDS = {
    "sweep": [
        "sweep",
        "gearmesh",
        "--over",
        "load=10:1000:x150",
        "--over",
        "speed=50:500:x150",
        "--out",
        "t.csv",
    ],
    "map build": [
        "map",
        "build",
        "--load",
        "100:900",
        "--speed",
        "400:700",
        "--tilt",
        "0.0018:0.0022",
        "--oil-temperature",
        "297.15",
        "--fidelity",
        "field",
        "--workers",
        "2",
        "--points",
        "20",
        "--out",
        "m.twm",
    ],
    "shift": ["shift", "--scene", "msl", "--step", "10 ms", "--out", "r"],
    "shift, Python FMUs": [
        "shift",
        "--scene",
        "msl",
        "--step",
        "5 ms",
        "--fmu",
        "python",
        "--out",
        "r",
    ],
    "first call, compiling": ["gearmesh"],
}
WHOLE = {"t.csv", "t.csv.journal", "m.twm", "m.twm.journal"}


def signals(folder: Path, n: int, seed: int) -> Iterator[Row]:
    """Yield commands that are signalled at random moments: once, twice, and terminated."""
    ways = {(signal.SIGINT,): 130, (signal.SIGINT, signal.SIGINT): 130, (signal.SIGTERM,): 143}
    for name, words in COMMANDS.items():

        def stop(rng: random.Random, name: str = name, words: list[str] = words) -> str:
            numbers = rng.choice(list(ways))
            with tempfile.TemporaryDirectory(dir=folder) as place:
                work = Path(place) / "work"
                work.mkdir()
                fresh = {}
                if "compiling" in name:
                    fresh = {"NUMBA_CACHE_DIR": f"{place}/cache", "THRUSTWASHER_KERNELS": "jit"}
                delay = rng.uniform(0.4, 3.0)
                code, said = ended(words, work, delay, numbers, **fresh)
                left = {str(p.relative_to(work)) for p in work.rglob("*")}
            lines = complaints(said)
            found = []
            if code not in (0, ways[numbers]):
                found.append(f"status {code}")
            if code == ways[numbers] and len(lines) != 1:
                found.append(f"{len(lines)} lines: {said[-400:]}")
            if code and left - WHOLE:
                found.append(f"left {sorted(left - WHOLE)}")
            calls.say_if_wrong(found, name, delay, [int(x) for x in numbers])
            return calls.REFUSED if code else calls.RIGHT

        yield campaign(f"signals during {name}", stop, n, seed)


def small_disk(folder: Path) -> Iterator[Row]:
    """Yield commands whose output lies on a disk of 48 kB, if one can be mounted."""
    place = folder / "disk"
    place.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=48k", "tmpfs", place], capture_output=True
    )
    if mounted.returncode:
        return
    row, began = Row("output on a disk of 48 kB"), time.perf_counter()
    try:
        for name in ("sweep", "map build", "shift"):
            code, said = ended(COMMANDS[name], place, 0.0, ())
            row.tried += 1
            lines = complaints(said)
            left = {str(p.relative_to(place)) for p in place.rglob("*")} - WHOLE - {"t.csv"}
            named = "No space" in said or "disk is full" in said
            if code != 2 or len(lines) != 1 or not named or left:
                row.lost.append(f"{name}: {code} {said[-300:]} {sorted(left)}")
            else:
                row.refused += 1
            for file in place.iterdir():
                file.unlink()
    finally:
        subprocess.run(["umount", place], check=False)
    row.seconds = time.perf_counter() - began
    yield row


def all_rows(scale: float, seed: int) -> Iterator[Row]:
    """Yield every campaign's line as it ends."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        program = compiled(folder)
        for model, level, n, jumps, box in SOAK:
            yield soak(program, model, level, round(scale * n), jumps, box, seed)
        for model, n in CALLS:
            yield campaign(
                f"{find_spec(model).name}, random parameters, point and fidelity level",
                lambda rng, m=model: calls.solve_once(m, rng),
                round(scale * n),
                seed,
            )
        yield from walks(folder, scale, seed)
        yield from spoiled(folder, scale, seed)
        yield from signals(folder, max(2, round(scale * 8)), seed)
        yield from small_disk(folder)


def line(row: Row) -> str:
    """Return what is printed of a fault."""
    counts = (row.tried, row.right, row.refused, len(row.lost), f"{row.seconds:.0f}", row.note)
    return f"| {row.fault} | {' | '.join(map(str, counts))} |"


def grouped(rows: list[Row]) -> str:
    """Return the table of the page: the faults of a kind together."""
    lines, left = [], list(rows)
    for words, part in GROUPS:
        of = [row for row in left if part in row.fault]
        left = [row for row in left if part not in row.fault]
        sums = [sum(getattr(row, n) for row in of) for n in ("tried", "right", "refused")]
        lines.append(f"| {words} | {' | '.join(map(str, sums))} | {sum(len(r.lost) for r in of)} |")
    assert not left, left
    return "\n".join(lines)


def page(rows: list[Row], command: str, seed: int) -> str:
    """Return docs/faults.md."""
    total = [sum(getattr(r, n) for r in rows) for n in ("tried", "right", "refused")]
    lost = sum(len(r.lost) for r in rows)
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    seconds = sum(r.seconds for r in rows)
    return PAGE.format(
        command=command,
        kernels=kernel_digest(),
        machine=machine,
        seed=seed,
        numba=metadata.version("numba"),
        python=platform.python_version(),
        seconds=seconds,
        right=total[1],
        refused=total[2],
        lost=lost,
        table=grouped(rows),
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="a fiftieth of everything")
    parser.add_argument("--out", type=Path, help="page to write, docs/faults.md")
    given = parser.parse_args()
    rows = []
    for row in all_rows(0.02 if given.quick else 1.0, given.seed):
        rows.append(row)
        print(line(row), flush=True)
        for text in row.lost[:5]:
            print("    lost:", text, flush=True)
    if given.out:
        words = "python -m lab.benchmarks.abuse" + (" --quick" if given.quick else "")
        given.out.write_text(page(rows, words, given.seed), "utf-8")
    return int(any(row.lost for row in rows))


if __name__ == "__main__":
    sys.exit(main())
