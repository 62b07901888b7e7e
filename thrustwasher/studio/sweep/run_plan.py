"""The rows of a sweep of engagements, of gear shifts or of a function: each stands alone."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, Status
from ...numerics.jit import kernel_digest
from ..evaluators.evaluator import Evaluator, Rows, texts
from .axes import read_axis
from .sweep_plan import digest, grid, held_values, listed


@dataclass(frozen=True)
class RunPlan:
    """What is evaluated row by row, and the columns that are shown before its figures."""

    evaluator: Evaluator
    rows: Rows
    figures: tuple[str, ...]
    shown: dict[str, Any]
    units: dict[str, str]
    identity: dict[str, str] = field(default_factory=dict)
    taken: str = ""
    warnings: tuple[str, ...] = ()
    fidelity: str = ""
    choice: str = ""
    model: str = ""
    asked: tuple[str, ...] = ()  # what is varied, in the order in which it was named

    @property
    def starts(self) -> NDArray[np.int64]:
        """First row of each line, and the end."""
        return self.rows.starts

    @property
    def n_rows(self) -> int:
        """Number of rows."""
        return len(self.rows)

    def check(self) -> None:
        """Refuse nothing: an evaluator was checked when it was made."""

    def status(self, code: int) -> str:
        """Return the word of a code."""
        if code in self.evaluator.reasons:
            return self.evaluator.reasons[code]
        return Status(code).name


def make_run_plan(
    evaluator: Evaluator,
    over: Mapping[str, Any],
    at: Mapping[str, object],
    points: Mapping[str, object] | None,
) -> RunPlan:
    """Return the plan of a sweep; arguments as in ``run_sweep``."""
    known = evaluator.quantities
    held = held_values(at, known)
    axes = [read_axis(name, values, known) for name, values in over.items()]
    if points is None:
        columns, _, order = grid(axes)
    elif axes:
        raise ParameterError("points: allowed: without axes to vary; it names every point")
    else:
        columns, _, order = listed(points, known)
    given = [*held, *(a.place.name for a in axes), *(columns if points is not None else ())]
    twice = [name for name in given if given.count(name) > 1]
    if twice:
        raise ParameterError(f"{twice[0]}: is given twice, allowed: varied or held, once")
    n = len(next(iter(columns.values())))
    shown = dict(columns) | {
        name: np.full(n, value, float if isinstance(value, float) else object)
        for name, value in held.items()
    }
    rows = Rows(columns=columns, starts=np.arange(n + 1), held=held)
    plan = RunPlan(
        evaluator=evaluator,
        rows=rows,
        figures=tuple(evaluator.figures),
        shown=shown,
        units={name: known[name].unit for name in shown} if shown else {},
        taken=_taken(evaluator, shown),
        warnings=texts(evaluator.remarks, "warning"),
        asked=tuple(a.place.name for a in axes) or tuple(columns),
    )
    parts = {**evaluator.identity, "held": digest(repr(held)), "order": ", ".join(order)}
    parts |= {name: digest(column) for name, column in columns.items()}
    plan.identity.update({**parts, "version of thrustwasher": kernel_digest()})
    return plan


def _taken(evaluator: Evaluator, given: Mapping[str, Any]) -> str:
    """Return a line that names what an engagement takes by default; "" of others."""
    names = [name for name in getattr(evaluator, "profile", ()) if name not in given]
    known = evaluator.quantities
    words = [f"{n} = {known[n].text(known[n].nominal)}" for n in names]
    return f"taken by default: {', '.join(words)}" if words else ""
