"""Model exchange beside co-simulation, run by run: a table in Markdown.

python lab/benchmarks/exchange/table.py [--page docs/fmu/exchange.md] [--only WORD ...]

Runs: ``tests/core/fmu/exchange/cases.py``. Model exchange: scipy's Radau over shafts and units
through the calls of FMI 2.0, with the units' exact Jacobian. Co-simulation: steps of 0.1 ms, plant
by explicit Euler.
"""

import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests/core/fmu/exchange")]

from cases import CASES  # noqa: E402
from coupled import exchanged, lock_up, stepped  # noqa: E402

TOLERANCES = (1e-3, 1e-4, 1e-6)
HEAD = ["run", "torque, heat, time", *(f"{x:g}" for x in TOLERANCES)]


def differences(line, one, two):
    """Return those of torque at the end, heat and time of lock or rest; None: there is none.

    Relative ones; of a torque that is all but 0 that over 50 N m.
    """
    torques = [float(run["torques"][-1].sum()) for run in (one, two)]
    size = abs(torques[1]) if abs(torques[1]) > 1e-3 else 50.0
    found = [abs(torques[0] - torques[1]) / size, abs(one["heat"] / two["heat"] - 1.0)]
    times = [lock_up(line, run) for run in (one, two)] if line.inertias else []
    return [*found, abs(times[0] / times[1] - 1.0) if times else None]


def row(name):
    """Return the cells of a run and its differences, by tolerance."""
    line, two, cells, far = CASES[name], stepped(CASES[name]), [], []
    for tolerance in TOLERANCES:
        one = exchanged(line, tolerance)
        far.append(differences(line, one, two))
        cells.append(f"{one['steps']}, {one['events']}, {one['calls']}")
    shown = ", ".join("-" if x is None else f"{100.0 * x:.2f}" for x in far[1])
    return [name, shown, *cells], far


def grouped(rows):
    """Return rows whose names differ by a number, or behind a comma, as one of ranges."""
    groups = {}
    for name, *cells in rows:
        groups.setdefault(re.sub(r" \d+$|, .*", "", name), []).append((name, cells))
    found = []
    for kind, members in groups.items():
        columns = zip(*(cells for _, cells in members), strict=True)
        shown = [
            ", ".join(_range(parts) for parts in zip(*(c.split(", ") for c in column), strict=True))
            for column in columns
        ]
        own = f"{kind} ({len(members)} runs)" if len(members) > 1 else members[0][0]
        found.append([own, *shown])
    return found


def _range(values):
    """Return numbers as text from the least to the largest; "-": there is none."""
    there = sorted((x for x in values if x != "-"), key=float)
    if not there:
        return "-"
    return there[0] if there[0] == there[-1] else f"{there[0]}..{there[-1]}"


def table(names):
    """Return the lines of the table and the sentence on the largest differences."""
    rows, far = [], []
    for name in names:
        cells, found = row(name)
        rows.append(cells)
        far.append(found)
        print(f"| {' | '.join(cells)} |", flush=True)
    worst = [max(x for run in far for x in run[k] if x is not None) for k in range(len(TOLERANCES))]
    told = ", ".join(f"{100.0 * x:.2f} % at {t:g}" for x, t in zip(worst, TOLERANCES, strict=True))
    lines = [HEAD, ["---"] * len(HEAD), *grouped(rows)]
    return [f"| {' | '.join(x)} |" for x in lines], f"Largest difference of all: {told}."


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", type=Path, help="write the table into this page")
    parser.add_argument("--only", nargs="*", help="runs with one of these words in their names")
    given = parser.parse_args()
    names = [n for n in CASES if not given.only or any(word in n for word in given.only)]
    lines, told = table(names)
    print(told)
    if given.page:
        block = re.compile(r"(?s)(<!-- exchange -->\n\n).*?(\n\n<!-- end -->)")
        text = "\n".join([*lines, "", told])
        page = given.page.read_text("utf-8")
        given.page.write_text(block.sub(lambda m: f"{m[1]}{text}{m[2]}", page), "utf-8")


if __name__ == "__main__":
    main()
