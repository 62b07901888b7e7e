"""Measure the errors of the package's own parameter sets and write the tables it ships.

python -m lab.verify [MODEL] [--set NAME] [--points N] [--out DIR]

Only parameter sets of which a level is stale or missing are measured, unless one is named. A run
that is stopped goes on where it was, because reference values are kept.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from thrustwasher.ladder.choose import levels_of
from thrustwasher.ladder.error_table import (
    VERIFY,
    Axis,
    ErrorTable,
    forget,
    fresh_levels,
    read_tables,
    write_tables,
)
from thrustwasher.model.registry import ladder_of, models_with_error_tables, spec_of
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.storage.digests import DATA
from thrustwasher.studio.verification.cases import POINTS, Case
from thrustwasher.studio.verification.measure_errors import Show, measured

HELP = "measure the fidelity levels against the reference and write the tables"


def main(argv: Sequence[str] | None = None) -> int:
    """Measure what is requested; return 0."""
    parser = argparse.ArgumentParser(VERIFY, description=HELP)
    parser.add_argument(
        "model", nargs="?", choices=list(models_with_error_tables()), help="default: all"
    )
    parser.add_argument("--set", metavar="NAME", help="parameter set; default: those not fresh")
    parser.add_argument("--points", type=int, metavar="N", default=POINTS, help="default: 500")
    parser.add_argument("--out", type=Path, default=DATA / "error_tables", metavar="DIR")
    options = parser.parse_args(argv)
    for model in [options.model] if options.model else list(models_with_error_tables()):
        path = options.out / f"{model}.json"
        known = {t.name: t for t in read_tables(path)} if path.exists() else {}
        for case in cases(model):
            levels = levels_of(case.spec, case.params)
            stale = set(levels) - set(fresh_levels(model, case.params))
            if case.name == options.set or (options.set is None and stale):
                known[case.name] = measured(case, options.points, _shown(case))
                write_tables(list(known.values()), path)
                forget()
                print(_summary(known[case.name]), file=sys.stderr, flush=True)
    return 0


def cases(model: str) -> list[Case]:
    """Return the cases of a model, or raise ParameterError with the models there are."""
    spec, ladder, found = spec_of(model), ladder_of(model), []
    units = {s.name: s.unit for s in spec.inputs}
    for name, box in ladder.boxes.items():
        params = spec.params()
        if name != "default":  # what a shipped scene gives to its part
            scene, _, part = name.partition(".")
            params = load_scene(scene).parts[part or ladder.part].params
        axes = {n: Axis(low, high, units[n], scale) for n, (low, high, scale) in box.items()}
        found.append(Case(spec, name, params, axes))
    return found


def _shown(case: Case) -> Show:
    """Return what says how far the reference values are."""

    def show(k: int, n: int) -> None:
        if k % 50 == 0 or k == n:
            text = f"{case.spec.key} {case.name}: reference {k}/{n}"
            print(text, file=sys.stderr, flush=True)

    return show


def _summary(table: ErrorTable) -> str:
    """Return a line of what a table says."""
    worst = [
        f"{r.fidelity} {c.name or ''}: {r.worst_anywhere('friction_torque', c):.3g} at "
        f"{c.points} points"
        for r in table.levels
        for c in r.charts
    ]
    return f"{table.model} {table.name}: largest error of the torque: {', '.join(worst)}"


if __name__ == "__main__":
    sys.exit(main())
