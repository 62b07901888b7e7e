"""Numbers of the Modelica Standard Library beside those of packs in model exchange: a table.

python lab/benchmarks/exchange/modelica.py FOLDER [--page docs/fmu/exchange.md]

FOLDER: CoupledClutches.csv, LossyGearDemo1.csv and LossyGearDemo2.csv of the library's reference
results (github.com/modelica/MAP-LIB_ReferenceResults, branch v4.0.0: Dymola, Dassl, tolerance
1e-6). The friction elements are packs of the level closed, whose capacity is proportional to the
load; the examples' equations are in ``tests/core/fmu/exchange/modelica_examples.py``.
"""

import argparse
import csv
import re
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[3]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests/core/fmu/exchange")]

from modelica_examples import coupled_clutches, lossy_gear  # noqa: E402

HEAD = ["example", "quantity", "Modelica", "pack", "extrapolated", "off, %"]


def columns(path):
    """Return the columns of a table of reference results; of equal times the last row counts."""
    with path.open() as file:
        rows = {float(row["time"]): row for row in csv.DictReader(file)}
    times = sorted(rows)
    return {n: np.array([float(rows[t][n]) for t in times]) for n in rows[times[0]]}


def first(times, values, after):
    """Return the first time from ``after`` on at which the values have passed 0."""
    signs = np.sign(values)
    k = next(i for i in range(1, len(times)) if times[i] > after and signs[i] != signs[i - 1])
    a, b, u, v = times[k - 1], times[k], values[k - 1], values[k]
    return float(a - u * (b - a) / (v - u))


def clutches(folder):
    """Yield quantity, Modelica's number and ours, up to where the first clutch sticks."""
    theirs, ours = columns(folder / "CoupledClutches.csv"), coupled_clutches(1e-8)
    t, w = ours["time"], ours["speeds"]
    for name, k in (("clutch2", 1), ("clutch1", 0)):
        stuck = theirs[f"{name}.mode"] == 0
        at = float(theirs["time"][int(np.argmax(stuck))])
        yield f"`{name}` sticks, s", at, first(t, w[:, k] - w[:, k + 1] + 1e-6, at - 0.05)
    for at in (0.2, 0.4, 0.6, 0.75):
        found = float(np.interp(at, theirs["time"], theirs["J1.w"]))
        yield f"`J1.w` at {at:g} s, rad/s", found, float(np.interp(at, t, w[:, 0]))


def gears(folder, number):
    """Yield the same of the gear whose friction holds it twice; extrapolated to an angle of 0."""
    theirs = columns(folder / f"LossyGearDemo{number}.csv")
    ours = [lossy_gear(number, 1e-8, angle) for angle in (4e-6, 1e-6)]
    rows = [("w", t, ", rad/s") for t in ((0.05, 0.25, 0.3, 0.35) if number == 1 else (0.04, 0.28))]
    rows += [("phi", t, " (stuck), rad") for t in (0.15, 0.42)]
    for name, t, more in rows:
        name = f"Inertia2.{name}"
        rough, fine = (float(np.interp(t, x["time"], x[name])) for x in ours)
        found = float(np.interp(t, theirs["time"], theirs[name]))
        yield f"`{name}` at {t:g} s{more}", found, fine, 2.0 * fine - rough


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--page", type=Path, help="write the table into this page")
    given = parser.parse_args()
    lines = [f"| {' | '.join(x)} |" for x in (HEAD, ["---"] * len(HEAD))]
    runs = {
        "CoupledClutches": clutches(given.folder),
        **{f"LossyGearDemo{k}": gears(given.folder, k) for k in (1, 2)},
    }
    for name, rows in runs.items():
        for quantity, theirs, *ours in rows:
            off = 100.0 * abs(ours[-1] / theirs - 1.0)
            shown = [f"{x:#.5g}" for x in (theirs, *ours)]
            cells = [name, quantity, *shown, *[""] * (2 - len(ours)), f"{off:.3f}"]
            lines.append(f"| {' | '.join(cells)} |")
            name = ""
    print("\n".join(lines))
    if given.page:
        block = re.compile(r"(?s)(<!-- modelica -->\n\n).*?(\n\n<!-- end -->)")
        text, page = "\n".join(lines), given.page.read_text("utf-8")
        given.page.write_text(block.sub(lambda m: f"{m[1]}{text}{m[2]}", page), "utf-8")


if __name__ == "__main__":
    main()
