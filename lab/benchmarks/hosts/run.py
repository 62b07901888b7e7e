"""The FMUs in hosts that are not ours: one row per host, as a table in Markdown.

python lab/benchmarks/hosts/run.py FOLDER [--bin FOLDER ...] [--only HOST ...]

FOLDER has native-fmi2/, native-fmi3/ and packages of the default shift, planetary.ssp and
planetary-fmi3.ssp, as ``thrustwasher build`` and ``thrustwasher shift --ssp`` write them. Programs
and Pythons with a host's package are looked for on PATH and in the folders of --bin; README.md says
how to get them. What is not found is said and left out.
"""

import argparse
import json
import re
import subprocess
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from datetime import date
from functools import cache, partial
from itertools import product
from pathlib import Path
from typing import NamedTuple

from calls import (
    PACKAGES,
    Bench,
    Failed,
    Row,
    Table,
    called,
    difference,
    experiment,
    nominals,
    read,
    said,
)

from thrustwasher.fmu.model_kernels import package_version

HERE = Path(__file__).parent
SHIFT_STOP = 1.3  # s, of the default shift
HEATS = ("energy", "oil_energy", "received_heat")  # outputs that add up all that was before
Single = Callable[..., tuple[Table, str]]  # runs an FMU: its outputs, what was said
Rows = Iterator[Row]


# Single FMUs.
@cache
def in_python(
    bench: Bench, fmu: Path, host: str, package: str, given: str = ""
) -> tuple[Table, str]:
    found = bench.python(package)
    assert found
    given = given or bench.inputs(fmu)
    target = bench.scratch / f"{host}-{fmu.parent.name}-{fmu.stem}.csv"
    order = [found[0], HERE / "single.py", host, fmu, given, *experiment(fmu), target]
    _, told = called(*order, folder=bench.scratch)
    return read(target), told


def fmusim(
    bench: Bench, fmu: Path, *options: str, kind: str = "cs", given: str = ""
) -> tuple[Table, str]:
    target = bench.scratch / f"fmusim-{kind}-{fmu.parent.name}-{fmu.stem}.csv"
    step, stop = experiment(fmu)
    given = given or bench.inputs(fmu)
    order = ["--interface-type", kind, "--input-file", given, "--stop-time", stop]
    order += ["--output-interval", step, "--output-file", target, *options, fmu]
    _, told = called(bench.program("fmusim"), *order, folder=bench.scratch)
    return read(target), told


def fmusim_exchange(bench: Bench, fmu: Path, given: str) -> tuple[Table, str]:
    return fmusim(bench, fmu, "--solver", "cvode", "--tolerance", "1e-6", kind="me", given=given)


def fmu_check(bench: Bench, fmu: Path) -> tuple[Table, str]:
    target = bench.scratch / f"check-{fmu.stem}.csv"
    step, stop = experiment(fmu)
    order = ["-k", "cs", "-i", bench.inputs(fmu), "-h", step, "-n", 0, "-s", stop, "-o", target]
    _, told = called(bench.program("fmuCheck"), *order, fmu, folder=bench.scratch)
    return read(target), told


def by_fmpy(bench: Bench, fmu: Path, given: str = "") -> Table:
    return in_python(bench, fmu, "fmpy", "fmpy", given)[0]


def singles(run: Single, versions: tuple[int, ...], bench: Bench) -> Rows:
    """Run every FMU; say how far it is from FMPy."""
    for fmi in versions:
        worst, failures, told = (0.0, "", ""), [], ""
        fmus = [fmu for fmu in bench.fmus(fmi) if bench.inputs(fmu)]
        for fmu in fmus:
            try:
                table, words = run(bench, fmu)
                told += words
                worst = max(
                    worst, (*difference(by_fmpy(bench, fmu), table, nominals(fmu)), fmu.stem)
                )
            except (Failed, subprocess.TimeoutExpired) as error:
                failures.append(f"{fmu.stem}: {error}")
        result = f"{worst[0]:.1g} from FMPy" + (f" ({worst[2]} `{worst[1]}`)" if worst[1] else "")
        if failures:
            result = f"{len(failures)} of {len(fmus)} fail; {failures[0]}"
        yield Row(fmi, f"{len(fmus)} FMUs", result, said(told))


def has_exchange(fmu: Path) -> bool:
    with zipfile.ZipFile(fmu) as archive:
        return b"<ModelExchange" in archive.read("modelDescription.xml")


def exchanges(
    run: Single,
    versions: tuple[int, ...],
    bench: Bench,
    *,
    plain: bool = False,
    kinds: tuple[str, ...] = ("ramps", "jumps"),
) -> Rows:
    """Run every FMU that has model exchange; say how far its heats end from co-simulation.

    With the inputs of its reference results, which are ramps, and with the same held as jumps.
    """
    for fmi, inputs in product(versions, kinds):
        worst, failures, told = (0.0, "", ""), {}, ""
        fmus = [f for f in bench.fmus(fmi, plain=plain) if bench.inputs(f) and has_exchange(f)]
        for fmu in fmus:
            given = bench.inputs(fmu) if inputs == "ramps" else bench.held(fmu)
            try:
                table, words = run(bench, fmu, given=given)
                told += words
                one, two = table[max(table)], by_fmpy(bench, fmu, given)
                last = two[max(two)]
                for name in HEATS:
                    if name in one and last.get(name):
                        off = abs(one[name] / last[name] - 1.0)
                        worst = max(worst, (off, name, fmu.stem))
            except (Failed, subprocess.TimeoutExpired) as error:
                failures[fmu.stem] = str(error)
        result = f"heat {worst[0]:.1g} from co-simulation ({worst[2]} `{worst[1]}`)"
        if failures:
            first, why = next(iter(failures.items()))
            names = f"{', '.join(failures)} fail" if len(failures) < len(fmus) else "all fail"
            result = f"{result * (len(failures) < len(fmus))}; {names}; {first}: {why}".strip("; ")
        ran = f"{len(fmus)} FMUs{', `--plain`' * plain}, model exchange, inputs {inputs}"
        yield Row(fmi, ran, result, said(told))


def references(bench: Bench) -> Rows:
    """FMPy itself: how far it is from the reference results inside the FMUs."""
    for fmi in (2, 3):
        worst = (0.0, "", "")
        fmus = [fmu for fmu in bench.fmus(fmi) if bench.inputs(fmu)]
        for fmu in fmus:
            target = bench.scratch / f"reference-{fmu.stem}.csv"
            with zipfile.ZipFile(fmu) as archive:
                name = next(n for n in archive.namelist() if n.endswith("_out.csv"))
                target.write_bytes(archive.read(name))
            worst = max(
                worst, (*difference(read(target), by_fmpy(bench, fmu), nominals(fmu)), fmu.stem)
            )
        result = f"{worst[0]:.1g} from their reference results ({worst[2]} `{worst[1]}`)"
        yield Row(fmi, f"{len(fmus)} FMUs", result)


def events(run: Single, bench: Bench, ran: str = "Event Mode, early return") -> Rows:
    """Run the transmission alone: when it locks, how often the host stopped between steps."""
    fmu = bench.folder / "native-fmi3" / "ShiftTransmission.fmu"
    ran = f"`ShiftTransmission`, {ran}"
    try:
        table, told = run(bench, fmu)
    except Failed as error:
        yield Row(3, ran, str(error))
        return
    step, _ = experiment(fmu)
    between = [t for t in table if abs(t / step - round(t / step)) > 1e-6]
    last = table[max(table)]
    result = f"locks at {last['lock_time']:.9f} s; {len(between)} points between the steps"
    yield Row(3, ran, result, said(told))


# Packages of a whole shift.
def masters(name: str, package: str, versions: tuple[int, ...], bench: Bench) -> Rows:
    found = bench.python(package)
    assert found
    for fmi in versions:
        if (ssp := bench.package(fmi)) is None:
            yield Row(fmi, "SSP", f"no {PACKAGES[fmi]} in the folder")
            continue
        try:
            order = [found[0], HERE / "masters.py", name, ssp, SHIFT_STOP]
            out, told = called(*order, folder=bench.scratch)
        except Failed as error:
            yield Row(fmi, "SSP", str(error))
            continue
        lock = json.loads(out.splitlines()[-1])["lock"]
        yield Row(fmi, "SSP", f"locks at {lock:.9f} s", said(told))


def omsimulator(bench: Bench) -> Rows:
    """Run packages; with extrapolated inputs without the system's border, which stops that run."""
    for fmi, plain, option in (
        (2, False, ""),
        (2, True, ""),
        (2, True, "--inputExtrapolation=true"),
        (3, False, ""),
        (3, False, "--directionalDerivatives=false"),
    ):
        ran = "SSP" + ", `Parts.ssd`" * plain + (f", `{option}`" if option else "")
        if (ssp := bench.package(fmi)) is None:
            yield Row(fmi, ran, f"no {PACKAGES[fmi]} in the folder")
            continue
        if plain:
            ssp = bench.plain_package(fmi)
        table = bench.scratch / "oms.csv"
        table.unlink(missing_ok=True)
        order = [f"--stopTime={SHIFT_STOP}", f"--resultFile={table}", *option.split(), ssp]
        try:
            _, told = called(bench.program("OMSimulator"), *order, folder=bench.scratch)
        except Failed as error:
            yield Row(fmi, ran, str(error))
            continue
        found = read(table) if table.exists() else {}
        last = found[max(found)] if found else {"lock_time": float("nan")}
        lock = next(v for k, v in last.items() if k.endswith("lock_time"))
        yield Row(fmi, ran, f"locks at {lock:.9f} s" if found else "no result", said(told))


# Checkers of the description.
def checks(command: Callable[[int, Path], list[object]], fault: str, bench: Bench) -> Rows:
    """Run a checker over every FMU; a line that matches ``fault`` is one."""
    for fmi in (2, 3):
        wrong = []
        for fmu in bench.fmus(fmi):
            try:
                _, told = called(*command(fmi, fmu), folder=bench.scratch)
                faults = [line for line in told.splitlines() if re.search(fault, line)]
            except Failed as error:
                faults = [str(error)]
            wrong += [f"{fmu.stem}: {line}" for line in faults]
        result = f"{len(wrong)} faults, first: {wrong[0][:140]}" if wrong else "no fault"
        yield Row(fmi, f"{len(bench.fmus(fmi))} FMUs", result)


class Host(NamedTuple):
    """Name, the program or the Python package it needs, what is run in it."""

    name: str
    program: str
    package: str
    run: Callable[[Bench], Rows]


def several(*runs: Callable[[Bench], Rows]) -> Callable[[Bench], Rows]:
    return lambda bench: (row for run in runs for row in run(bench))


def single(host: str, package: str) -> Single:
    return lambda bench, fmu, **more: in_python(bench, fmu, host, package, **more)


def with_events(*options: str) -> Single:
    flags = ("--early-return-allowed", "--event-mode-used", *options)
    return lambda bench, fmu: fmusim(bench, fmu, *flags)


def checker(program: str, *options: str, fault: str) -> Callable[[Bench], Rows]:
    def command(bench: Bench, fmi: int, fmu: Path) -> list[object]:
        return [bench.program(program.format(fmi=fmi)), *options, fmu]

    return lambda bench: checks(partial(command, bench), fault, bench)


HOSTS = [
    Host(
        "FMPy",
        "",
        "fmpy",
        several(
            references,
            partial(exchanges, single("fmpy-exchange", "fmpy"), (2, 3)),
            partial(events, single("fmpy-events", "fmpy")),
            partial(masters, "fmpy", "fmpy", (2, 3)),
        ),
    ),
    Host("FMPy, validate", "fmpy", "fmpy", checker("fmpy", "validate", fault=r"^- |\[")),
    Host(
        "fmusim",
        "fmusim",
        "",
        several(
            partial(singles, fmusim, (2, 3)),
            partial(exchanges, fmusim_exchange, (2, 3)),
            partial(events, with_events()),
            partial(
                events, with_events("--record-intermediate-values"), ran="intermediate values too"
            ),
        ),
    ),
    Host("FMI Compliance Checker", "fmuCheck", "", partial(singles, fmu_check, (2,))),
    Host("VDMCheck", "VDMCheck2.sh", "", checker("VDMCheck{fmi}.sh", fault="^Error|^Warning")),
    Host(
        "fmutool",
        "fmutool",
        "fmu-manipulation-toolbox",
        checker("fmutool", "-check", "-input", fault="^(WARNING|ERROR)"),
    ),
    Host(
        "fmucontainer",
        "",
        "fmu-manipulation-toolbox",
        partial(masters, "fmucontainer", "fmu-manipulation-toolbox", (2, 3)),
    ),
    Host("fmuloader", "", "fmuloader", partial(singles, single("fmuloader", "fmuloader"), (2, 3))),
    Host(
        "PyFMI",
        "",
        "pyfmi",
        several(
            partial(singles, single("pyfmi", "pyfmi"), (2, 3)),
            partial(exchanges, single("pyfmi-exchange", "pyfmi"), (2,)),
        ),
    ),
    Host(
        "PathSim",
        "",
        "pathsim-fmi",
        partial(
            exchanges,
            single("pathsim-exchange", "pathsim-fmi"),
            (2,),
            plain=True,
            kinds=("ramps",),
        ),
    ),
    Host("OMSimulator", "OMSimulator", "", omsimulator),
    Host("libcosim", "", "libcosimpy", partial(masters, "libcosim", "libcosimpy", (2, 3))),
    Host("Ecos", "", "ecospy", partial(masters, "ecos", "ecospy", (2, 3))),
]


VERSIONS = {"fmuCheck": "-v", "VDMCheck2.sh": ""}  # of the programs that have no --version


def version(bench: Bench, host: Host) -> str | None:
    """Return the host's version, '' if it does not say, None if it is not here."""
    if host.program and not bench.program(host.program):
        return None
    if host.package:
        found = bench.python(host.package)
        return found[1] if found else None
    try:
        told = called(bench.program(host.program), VERSIONS.get(host.program, "--version"))[1]
    except Failed:
        return ""
    number = re.search(r"\d+(\.\w+)+[\w.-]*|\b[0-9a-f]{7,}\b", told)
    return number[0] if number else ""


def write_into(page: Path, rows: list[tuple[str, ...]], absent: list[str]) -> None:
    """Put the rows, without what hosts said, between the page's marks; other hosts' rows stay.

    Hosts that are ``absent`` are named as run earlier.

    Runs with both versions of FMI that come out alike are one row.
    """
    alike = dict[tuple[str, ...], list[str]]()
    for host, number, fmi, ran, result in rows:
        alike.setdefault((host, number, ran, result), []).append(fmi)
    ran_now = {row[0] for row in rows}
    rows = [(h, n, ", ".join(fmi), ran, result) for (h, n, ran, result), fmi in alike.items()]
    lines = ["| host | version | FMI | what was run | result |", "|---|---|---|---|---|"]
    lines += [f"| {' | '.join(row)} |" for row in rows]
    block = re.compile(r"(?s)(<!-- hosts -->\n\n)(.*?)(\n\n<!-- end -->)")

    def merged(found: re.Match[str]) -> str:
        old = [line for line in found[2].splitlines()[2:] if line.startswith("|")]
        stay = [line for line in old if host_of(line) not in ran_now]
        order = [host.name for host in HOSTS]
        own = sorted(stay + lines[2:], key=lambda line: order.index(host_of(line)))
        told = f"Last run on {date.today()}, thrustwasher {package_version()}"
        earlier = [name for name in absent if name in {host_of(line) for line in own}]
        told += f"; not there, hence of an earlier run: {', '.join(earlier)}." if earlier else "."
        return f"{found[1]}{chr(10).join([*lines[:2], *own, '', told])}{found[3]}"

    page.write_text(block.sub(merged, page.read_text("utf-8")), "utf-8")


def host_of(line: str) -> str:
    return line.split("|")[1].strip()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--bin", type=Path, nargs="*", default=[])
    parser.add_argument("--only", nargs="*", choices=[host.name for host in HOSTS])
    parser.add_argument("--page", type=Path, help="write the table of what ran into this page")
    chosen, rows = parser.parse_args(), []
    print("| host | version | FMI | what was run | result | messages |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(chosen.folder, chosen.bin, Path(scratch))
        absent = [host.name for host in HOSTS if version(bench, host) is None]
        for host in HOSTS:
            if chosen.only and host.name not in chosen.only:
                continue
            if (number := version(bench, host)) is None:
                print(f"| {host.name} | not installed | | | | |", flush=True)
                continue
            for row in host.run(bench):
                told = f"{row.fmi} | {row.ran} | {row.result} | {row.messages}"
                print(f"| {host.name} | {number} | {told} |", flush=True)
                rows.append((host.name, number, str(row.fmi), row.ran, row.result))
    if chosen.page:
        write_into(chosen.page, rows, absent)


if __name__ == "__main__":
    main()
