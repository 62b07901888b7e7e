"""``thrustwasher fidelity``: each level's measured error, its cost; of your own part too."""

import argparse
from typing import Any

from ...cli.common import _options, _output
from ...model.part_file import is_part, load_part
from ...model.registry import ladder_of, models_with_error_tables
from ...units import format_quantity, parse_quantity

TOL, POINTS = "0.01", 60  # by default
HELP = "errors of all fidelity levels, or measure those of your own part"
EXAMPLES = (
    "thrustwasher fidelity clutch",
    "thrustwasher part new clutch --out pack.toml && thrustwasher fidelity pack.toml",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_error_tables())
    parser.add_argument(
        "model",
        nargs="?",
        metavar="MODEL|FILE",
        help=f"list only {models}; a part file (.toml): verify its fidelity levels in its "
        f"box, half a "
        "minute or less",
    )
    group = parser.add_argument_group("of a part file")
    tol = "relative error of the map's torque allowed, default 0.01"
    _options.add(group, {"--tol X": tol})
    parser.set_defaults(tol=TOL)
    points = "held-out points, default 60"
    group.add_argument("--points", default=POINTS, metavar="N", type=int, help=points)
    _options.add_workers(group)
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """List the tables, fresh or not; files that cannot be read come last."""
    from ...ladder.error_table import VERIFY, load_tables, refused_files

    if arguments.model and is_part(arguments.model):
        return _measure(arguments)
    if arguments.model and arguments.model not in models_with_error_tables():
        ladder_of(arguments.model)  # says which there are
    _options.refuse_unused(
        arguments, "verification tables that are listed", ["workers"], tol=TOL, points=POINTS
    )
    models = [arguments.model] if arguments.model else list(models_with_error_tables())
    found = {model: load_tables(model) for model in models}
    begin = arguments.model or ""
    refused = {n: why for n, why in refused_files().items() if n.startswith(begin)}
    if arguments.json:
        records = [record for mine in found.values() for t in mine for record in _records(t)]
        _output.print_json({"tables": records, "refused": refused})
        return 0
    for model, tables in found.items():
        for table in tables:
            _print_table(table)
        if not tables:
            print(f"{model}: no verification tables; make them: {VERIFY} {model}")
    for name, why in refused.items():
        print(f"{name}: refused: {why}")
    return 0


def _measure(arguments: argparse.Namespace) -> int:
    """Measure the levels of a part file and list what was found."""
    part = load_part(arguments.model)
    ladder_of(part.spec.key)  # ParameterError where no level can be chosen
    tol = parse_quantity(arguments.tol, "1", "tol")

    from ..verification.measure_errors import measure_part

    table = measure_part(
        part.spec,
        part.params,
        part.box,
        tol=tol,
        points=arguments.points,
        workers=arguments.workers,
        progress=_output.time_left,
    )
    warnings = part.oil_warnings
    _options.tell_oil(part)
    _output.warn(warnings)
    if arguments.json:
        found = {"tables": _records(table), "refused": {}}
        _output.print_json(found | {"warnings": warnings} | _options.oil_record(part))
        return 0
    _print_table(table)
    print(
        f"  {arguments.points} points and none beyond: with 95 % confidence at most "
        f"{3.0 / arguments.points:.0%} of the box is worse"
    )
    return 0


def _print_table(table: Any) -> None:
    """Print what is known of a parameter set: a row per level and chart."""
    from ...ladder.error_table import QUANTITIES
    from ...ladder.formats import shown_error

    box = table.levels[0].box.items()
    spans = ", ".join(
        f"{n} {format_quantity(a.min, a.unit)} .. {format_quantity(a.max, a.unit)}" for n, a in box
    )
    print(f"{table.model}, {table.name} parameters: {spans}")
    rows = [("level", f"{'torque':>10} {'temp.':>10} {'a call':>8}", "")]
    for level in table.levels:
        for chart in level.charts:
            torque, heat = (
                shown_error(level.worst_anywhere(q, chart), QUANTITIES[q])
                for q in ("friction_torque", "temperature")
            )
            call = format_quantity(level.call, "s", digits=2)
            state = f"{chart.points} points; {table.stale(level) or 'of this version'}"
            name = f"{level.fidelity} {chart.name or ''}".strip()
            rows.append((name, f"{torque:>10} {heat:>10} {call:>8}", state))
    _output.print_rows(rows)


def _records(table: Any) -> list[dict[str, Any]]:
    """Return what a program wants to know of the errors of each level on each chart."""
    from ...ladder.error_table import QUANTITIES

    found = []
    for level, chart in ((r, chart) for r in table.levels for chart in r.charts):
        name = [table.model, level.fidelity, chart.name, table.name]
        found.append(
            {
                "name": "-".join(part for part in name if part and part != "default"),
                "model": table.model,
                "fidelity": level.fidelity,
                "chart": chart.name,
                "parameters": table.name,
                "made": table.made,
                "stale": table.stale(level),
                "points": chart.points,
                "envelope": {n: [a.min, a.max, a.unit] for n, a in level.box.items()},
                "worst": {q: level.worst_anywhere(q, chart) for q in QUANTITIES},
                "call_median_s": level.call,
            }
        )
    return found
