"""Solve a whole sweep: in this process, on all cores, or on a cluster."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...model.quantity import Quantity
from ...model.registry import find_model
from ...model.spec import ModelSpec
from ...processes import refuse_import_by_worker
from ...settings import places
from ...storage.journal import Journal
from ...storage.tables.given import columns_given, is_table
from ..evaluators.evaluator import Evaluator
from ..evaluators.evaluator import Rows as Points
from ..evaluators.make import evaluator, is_at_points
from ..jobs.progress import shown
from ..jobs.rows import Rows
from ..jobs.runner import Progress, Runner, Work, check_workers
from .run_plan import RunPlan, make_run_plan
from .sweep_plan import Plan, make_plan
from .sweep_table import SweepTable, check_output, make_table, pieces, write_table

if TYPE_CHECKING:
    from ...model.part_file import PartFile
    from ...shift.scene.scene import Scene

TASK_POINTS = 4096


def run_sweep(
    model: "str | PartFile | Scene | Evaluator",
    over: Mapping[str, object] | None = None,
    *,
    at: Mapping[str, object] | None = None,
    points: Any = None,
    params: object = None,
    fidelity: str | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    cluster: Any = None,
    progress: bool | Progress | None = None,
    keep: bool = True,
) -> SweepTable:
    """Return the outputs of a model over all combinations of some inputs and parameters.

    Parameters
    ----------
    model : "washer", "clutch" (slipping for ever) or "gearmesh", or a part (``load_part``); a scene
        (``load_scene``) or its name: every point is a gear shift; ``engagements(part)``
    over : values by name of an input or parameter (``gearmesh`` takes ``power`` for ``load`` too):
        numbers, or a text such as "50:1850:50", "20:1850:x40", "24 degC, 80 degC"
    at : one value by name for what is held; the rest is at the model's defaults, moved into the
        part's box
    points : instead of ``over``, columns of one length by name: every row is a point; or a path, a
        ``pandas.DataFrame`` (units in ``attrs["units"]``), an ``asammdf.MDF``
    params : parameter object to start from
    fidelity : level of the model, or "auto:0.01": the cheapest one whose torque the verification
        tables verify to 1 % over all points
    out : file to write, .csv or .parquet; a journal lies next to it until the sweep is done, and
        the same call goes on from there
    workers : processes on this machine; None: as many as there are cores where that pays, 1: none
    cluster : address of a Dask scheduler, e.g. "tcp://10.0.0.1:8786", or a client of it, instead
    progress : True: a bar of tqdm, or a line, on the terminal; or called with points done and all
    keep : False: with ``out``, the columns are there alone, and memory does not grow with them

    Returns
    -------
    SweepTable
        The rows do not depend on the workers. A failed point is a row with its status and NaN.

    Raises
    ------
    ParameterError : wrong argument, or ``out`` has a journal of another sweep
    SolveError : with auto, no level is verified to the tolerance
    EnvironmentProblem : a package is missing, the cluster does not answer, workers keep dying

    Notes
    -----
    Inputs run faster than parameters, and of each the one named first runs fastest. The rows along
    the fastest input are one line: it begins without memory and is walked with warm starts, so
    that a line up in load follows the film branch to its fold, and one down the contact branch. In
    ``points`` every row stands alone unless a column ``line`` gives rows the same number.

    Examples
    --------
    >>> table = run_sweep("clutch", {"load": "1 kN:3 kN:1 kN"}, at={"speed": 10.0})
    >>> table["friction_torque"].round(2).tolist(), table["status"].tolist()
    ([36.26, 68.8, 98.36], ['OK', 'OK', 'OK'])
    """
    check_workers(workers, cluster)
    target = None if out is None else check_output(out)
    plan = _plan(model, over or {}, at or {}, points, params, fidelity)
    show = shown(progress, "sweep")
    return run_planned(plan, target, workers=workers, cluster=cluster, progress=show, keep=keep)


def run_planned(
    plan: Plan | RunPlan,
    target: Path | None,
    *,
    workers: int | None = None,
    cluster: Any = None,
    progress: Progress | None = None,
    keep: bool = True,
) -> SweepTable:
    """Return the outputs of the rows of a plan, and write them to a target if there is one.

    Other arguments are those of ``run_sweep``.
    """
    refuse_import_by_worker()
    check_workers(workers, cluster)
    plan.check()
    n = plan.n_rows if keep or not target else 0
    kept = np.full((n, len(plan.figures)), np.nan), np.zeros((n, 1), np.int32)
    journal = Journal(journal_of(target), plan.identity) if target else None
    finished = False
    try:
        rows = Rows(
            n=plan.n_rows, numbers=kept[0], flags=kept[1], journal=journal, progress=progress
        )
        with Runner(workers=workers, cluster=cluster) as runner:
            runner.run(_Lines(plan, rows).work())
        table = make_table(plan, *kept)
        if target and journal:
            blocks = journal.blocks(len(plan.figures), 1)
            counts, found = write_table(pieces(plan, blocks), target)
            table = table if n else replace(table, columns={}, counts=counts, beyond=found)
        finished = True
    finally:
        if journal:
            journal.close(finished=finished)
    return table


def _plan(
    model: Any,
    over: Mapping[str, object],
    at: Mapping[str, object],
    points: Any,
    params: object,
    fidelity: str | None,
) -> Plan | RunPlan:
    """Return what is evaluated, row by row."""
    if is_at_points(model):
        if is_table(points):
            points = columns_given(points, _units(places(_spec(model))), ())
        return make_plan(model, over, at, points, params, fidelity)
    if params is not None or fidelity is not None:
        raise ParameterError(
            "params, fidelity: allowed: of a part at points; others have their own"
        )
    found = model if hasattr(model, "evaluate") else evaluator(model)
    if is_table(points):
        points = columns_given(points, _units(found.quantities), ())
    return make_run_plan(found, over, at, points)


def _spec(model: Any) -> ModelSpec:
    """Return the model of a part, or of a name."""
    return model.spec if hasattr(model, "spec") else find_model(model).spec


def _units(known: Mapping[str, Quantity]) -> dict[str, str]:
    """Return the unit of every column that points may have."""
    numbers = (p for p in known.values() if p.kind in ("real", "integer"))
    return {"line": "1"} | {p.name: p.unit for p in numbers}


def journal_of(out: Path) -> Path:
    """Return the journal that lies next to an output while its sweep is not done."""
    return out.with_name(out.name + ".journal")


class Piece(NamedTuple):
    """Some consecutive lines, complete with all that a worker needs to know next to the target."""

    first_row: int
    rows: Points


def solve_piece(
    evaluator: Evaluator, figures: tuple[str, ...], piece: Piece
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the figures of the rows (n, m), NaN where one failed, and their codes (n, 1)."""
    values, codes, _ = evaluator.evaluate(piece.rows, figures, "shown")
    return values, codes[:, np.newaxis]


@dataclass(frozen=True)
class _Lines:
    """The lines of a plan, and which of their rows are done."""

    plan: Plan | RunPlan
    rows: Rows

    def work(self) -> Work[Piece, tuple[NDArray[np.float64], NDArray[np.int32]]]:
        """Return what is left to do."""
        return Work(
            solve=solve_piece,
            context=(self.plan.evaluator, self.plan.figures),
            open_jobs=self._pieces,
            take=lambda piece, found: self.rows.take(piece.first_row, *found),
            size=lambda piece: len(piece.rows),
            left=lambda: self.rows.left,
            most=len(self.plan.starts) - 1,
        )

    def _pieces(self, n: int) -> Iterator[Piece]:
        """Give the lines that are not done, some at a time: enough work to be worth the way."""
        plan = self.plan
        size = min(TASK_POINTS, max(1, plan.n_rows // (32 * n)))
        starts = plan.starts.tolist()
        open_lines = np.flatnonzero(~self.rows.done[plan.starts[:-1]]).tolist()
        group: list[int] = []
        for line in open_lines:
            begins = starts[group[0]] if group else 0
            if group and (line != group[-1] + 1 or starts[line + 1] - begins > size):
                yield self._piece(group[0], group[-1] + 1)
                group = []
            group.append(line)
        if group:
            yield self._piece(group[0], group[-1] + 1)

    def _piece(self, a: int, b: int) -> Piece:
        """Return the piece of lines ``a .. b - 1``."""
        rows = self.plan.rows
        assert rows is not None
        return Piece(int(self.plan.starts[a]), rows.lines(a, b))
