"""Each level's error at random points against a reference: of your own part too."""

import os
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Any

from ...errors import ParameterError
from ...fmu.model_kernels import package_version
from ...ladder.choose import levels_of
from ...ladder.error_table import (
    OWN,
    Axis,
    Box,
    ErrorTable,
    LevelErrors,
    forget,
    own_folder,
    sources_of,
    write_tables,
)
from ...ladder.own_tables import ensure
from ...model.prepare import tables_of
from ...model.spec import ModelSpec
from ...processes import Run, run_here, runner, usable_cores
from ...storage.digests import DATA, changed_fields, params_digest
from .cases import Case, own_case
from .costs import call_cost, cpu
from .measured_chart import chart_of
from .reference_cache import SOURCES, answer, reference_points
from .reference_values import ReferencePoint

USUAL = 60  # points of your own part
Show = Callable[[int, int], None]
Progress = Callable[[str], Show]


def measure_part(
    spec: ModelSpec,
    params: Any,
    box: Box,
    *,
    tol: float = 0.01,
    points: int = USUAL,
    workers: int | None = None,
    progress: Progress | None = None,
) -> ErrorTable:
    """Build a part's map if its model has maps, measure its levels, keep both; return the table.

    ``box`` holds (low, high) [SI] of the inputs it is meant for, ``tol`` is relative, of the map's
    torque; ``progress`` is called with a label and returns ``show(done, total)``. ParameterError:
    box, tolerance or number of points is not allowed; SolveError: the map cannot be made.
    """
    case, tables = own_case(spec, params, box, points), tables_of(spec)
    count = workers or usable_cores()
    show = progress or (lambda _label: lambda _done, _total: None)
    if tables:
        ensure(tables, params, box, tol, show, workers=count)
    with runner(count) as run:
        table = measured(case, points, show("random points"), run)
    write_tables([table], own_folder() / f"{spec.key}-{case.name}.json")
    forget()
    return table


def measured(case: Case, n: int, show: Show, run: Run = run_here) -> ErrorTable:
    """Return the errors of a case's levels at ``n`` random points of its box."""
    spec, params, source = case.spec, case.params, SOURCES[case.spec.key]
    known = reference_points(case, source, n, lambda k: show(k, n), run)
    levels = [level_errors(case, level, known) for level in levels_of(spec, params)]
    return ErrorTable(
        spec.key,
        case.name,
        params_digest(params),
        changed_fields(params),
        datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        package_version(),
        f"{cpu()}, {os.cpu_count()} cores",
        source.routes,
        tuple(levels),
    )


def level_errors(case: Case, level: str, known: Sequence[ReferencePoint]) -> LevelErrors:
    """Return the errors of one level next to reference values, in what of the box it covers."""
    key, files = case.spec.key, _files(case, level)
    box = _covered(case, level)
    inside = [t for t in known if all(a.min <= t.point[n] <= a.max for n, a in box.items())]
    charts, calls = [], [0.0]
    for name in dict.fromkeys(t.chart for t in inside if not t.beside_fold):
        mine = [t for t in inside if t.chart == name]
        pairs = [(t, answer(key, case.params, level, t)) for t in mine]
        charts.append(chart_of(name, pairs, box))
        calls.append(call_cost(case.spec, case.params, level, mine))
    call = float(f"{max(calls):.3g}")
    return LevelErrors(level, sources_of(key, level, files), files, call, dict(box), tuple(charts))


def _covered(case: Case, level: str) -> dict[str, Axis]:
    """Return the part of a case's box that a level covers: a map may cover less."""
    tables = tables_of(case.spec, level)
    spans = tables.box(case.params) if tables else {}
    found = {}
    for name, axis in case.box.items():
        low, high = spans.get(name, (axis.min, axis.max))
        slack = 1e-9 * abs(axis.max)
        found[name] = Axis(
            axis.min if low <= axis.min + slack else low,
            axis.max if high >= axis.max - slack else high,
            axis.unit,
            axis.scale,
        )
    return found


def _files(case: Case, level: str) -> tuple[str, ...]:
    """Return the file that a level looks its answers up in, as its digest names it."""
    tables, home = tables_of(case.spec, level), DATA.resolve()
    if tables is None:
        return ()
    path = tables.find(case.params).path
    if path.is_relative_to(home):
        return (path.relative_to(home).as_posix(),)
    if not case.name.startswith(OWN):
        raise ParameterError(
            f"{level} for the {case.name} parameters = {path}, allowed: one that is shipped; a "
            "table speaks for a file below thrustwasher/data"
        )
    return (path.as_posix(),)
