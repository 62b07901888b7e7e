"""A part that is studied: any model that is solved at points, a steady state in every run."""

import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import FIRST_FAILURE, ParameterError, SolveError, Status, suggestion
from ...face_load import FACE_LOADS, Face, face_loads
from ...ladder.error_table import QUANTITIES, error_estimate
from ...model.advice import quantity_text
from ...model.levels import level_named
from ...model.part_file import PartFile
from ...model.point import point_of
from ...model.prepare import filled, tables_of
from ...model.quantity import Figure
from ...model.registry import find_model, kernel_of
from ...model.scatter import Scatter
from ...model.spec import Signal
from ...units import format_quantity
from ..sweep.row_doubts import beyond
from ..sweep.solve_rows import Task, output_signals, solve_task
from .target import Array, Flags

LOST = "film_lost"
REASONS = ("parameters that do not go together", "not converged")
REFUSED, NOT_CONVERGED = 1, 2
OTHER_LEVEL = (
    "fidelity = {!r} answers for the part's own parameters alone: solved with {!r}, as "
    "parameters scatter"
)


@dataclass(frozen=True, kw_only=True)
class PartTarget:
    """A part at a point, see ``part_target``."""

    part: PartFile
    scatter: Scatter
    inputs: Mapping[str, float]
    """All the model's own inputs [SI]; those that scatter are replaced in each run."""
    reached: str
    fidelity: str
    """The level that solves."""
    figures: tuple[Figure, ...]
    outcomes: tuple[str, ...]
    kind: Literal["part"] = "part"
    series: tuple[str, ...] = ()
    time: Array = field(default_factory=lambda: np.empty(0))
    costly: tuple[str, ...] = ()
    reasons: tuple[str, ...] = REASONS
    warnings: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.part.name

    @property
    def identity(self) -> dict[str, str]:
        """Model, parameters, point and what else decides the answers."""
        return {
            "model": self.part.spec.key,
            "parameters": _digest(asdict(self.part.params)),
            "inputs": _digest(dict(self.inputs)),
            "fidelity": self.fidelity,
            "reached": self.reached,
            "outputs": ", ".join(f.name for f in self.figures),
        }

    @property
    def model(self) -> str:
        """The command that solves it."""
        return self.part.spec.key

    @property
    def setting(self) -> dict[str, str]:
        """Level, inputs that do not scatter and a named oil, as words."""
        found = {"fidelity level": self.fidelity}
        for s in self.part.spec.inputs:
            value = self.inputs[s.name]
            if s.name not in self.scatter.names and (value or not s.optional):
                found[s.name] = format_quantity(value, s.unit, difference=s.relative)
        return found | ({"oil": self.part.oil_words} if self.part.oil else {})

    def touches(self, _source: str) -> bool:
        """Any source may matter."""
        return True

    def nominal(self) -> Array:
        """Return what the run at the nominal values gives; NaN if that has no solution."""
        return self._nominal.copy()

    def solve(self, rows: list[dict[str, Any]], costly: NDArray[np.bool_]) -> tuple[Array, Flags]:
        """Return figures and outcomes of each row (n, m), and its code (n,)."""
        names = [s.name for s in self.part.spec.inputs]
        inputs, params = np.empty((len(rows), len(names))), list[Any]()
        for i, row in enumerate(rows):
            try:
                own, given = self.part.varied(row)
            except ParameterError:
                own, given = None, {}
            params.append(own)
            inputs[i] = [given.get(name, self.inputs[name]) for name in names]
        numbers, status, lost = self._solved(tuple(params), inputs)
        columns = dict(zip([s.name for s in _shown(self.part)], numbers.T, strict=True))
        columns |= _face_columns(self.part, params, inputs, columns)
        found = np.column_stack(
            [columns[f.name] for f in self.figures]
            + [lost if name == LOST else _below_1(columns, name) for name in self.outcomes]
        )
        failed = status >= FIRST_FAILURE
        found[failed] = np.nan
        codes = np.where(status == Status.BAD_INPUT, REFUSED, NOT_CONVERGED)
        return found, np.where(failed, codes, 0).astype(np.int32)

    def _solved(
        self, params: tuple[object, ...], inputs: Array
    ) -> tuple[Array, Flags, NDArray[np.float64]]:
        """Return outputs, statuses and whether the film is lost (0 where no model says that)."""
        spec = self.part.spec
        draws = find_model(spec.key).sweep.draws
        if draws is not None:
            numbers, status, lost = draws(
                params, inputs, self.fidelity, above=self.reached == "above"
            )
            return numbers, status, lost.astype(float)
        lines = tuple(range(len(params) + 1))  # each row stands alone
        numbers, flags = solve_task(Task(spec.key, self.fidelity, 0, inputs, lines, params))
        return numbers, flags[:, -1], np.zeros(len(params))

    @property
    def notes(self) -> tuple[str, ...]:
        """The level and the point about which inputs scatter."""
        inputs = self.part.spec.inputs
        shown = [s for s in inputs if not (s.optional and self.inputs[s.name] == s.usual)]
        point = ", ".join(quantity_text(s, self.inputs[s.name]) for s in shown)
        return (f"solved with {self.fidelity!r} at {point}",)

    def why(self, row: Mapping[str, object]) -> str:
        """Return why a row failed, as its parameters say; "" if these go together."""
        try:
            params, _ = self.part.varied(row)
            kernel = kernel_of(self.part.spec)
            filled(self.part.spec, params, self.fidelity, kernel.NPAR, kernel.derive)
        except ParameterError as problem:
            return str(problem)
        return ""

    def doubts(self, base: Array) -> Iterator[str]:
        """Yield what single solves would warn of, of the nominal run and the base runs (N, m)."""
        point = point_of(self.part, dict(self.inputs))
        yield from point.warnings
        for words, rows in (("nominal run", self._nominal[np.newaxis]), ("base runs", base)):
            columns = dict.fromkeys([s.name for s in self.part.spec.outputs], np.full(1, np.nan))
            columns |= {f.name: rows[:, i] for i, f in enumerate(self.figures)}
            for found in beyond(self.part.spec, columns):
                one = found.text(len(rows)).partition(", ")[2]
                text = found.text(len(rows)).replace(" points,", f" {words},")
                yield f"{words}: {one}" if len(rows) == 1 else text

    def error(self) -> dict[str, float]:
        """Return the mesh's error of figures at the nominal point.

        Of a washer's torque it is what the solution itself tells, else by the table of errors.
        """
        values = {f.name: float(x) for f, x in zip(self.figures, self._nominal, strict=False)}
        branch = None
        if LOST in self.outcomes:
            at = len(self.figures) + self.outcomes.index(LOST)
            branch = "contact" if self._nominal[at] else "film"
        found = {}
        for name, unit in QUANTITIES.items():
            value = abs(values.get(name, math.nan))
            error = error_estimate(
                self.part.spec.key,
                self.fidelity,
                self.part.params,
                self.inputs,
                name,
                branch,
                values.get("film_ratio"),
            )
            if error is not None and math.isfinite(error) and value > 0.0 and unit != "K":
                found[name] = error if unit is None else error / value
        if "friction_torque" in found:
            found["friction_torque"] = self._told(branch) or found["friction_torque"]
        if "friction_torque" in found and "friction_power" in values:
            found["friction_power"] = found["friction_torque"]
        return found

    def _told(self, branch: str | None) -> float | None:
        """Return the error of its torque that the nominal solution tells, if it tells one."""
        asked = {} if branch is None else {"branch": branch}
        with suppress(ParameterError, SolveError):
            result = self.part.solve(**self.inputs, fidelity=self.fidelity, **asked)
            told: float | None = getattr(result, "error_estimate", None)
            return told
        return None

    @cached_property
    def _nominal(self) -> Array:
        found: Array = self.solve([{}], np.ones(1, bool))[0][0]
        return found


def part_target(
    part: PartFile,
    scatter: Scatter,
    inputs: Mapping[str, float],
    reached: str = "below",
    outputs: Sequence[str] | None = None,
) -> PartTarget:
    """Return a part as a target.

    Parameters
    ----------
    part : of a model that is solved at points; a clutch slips for ever, as in a sweep
    scatter : what scatters, of parameters and inputs
    inputs : of the model [SI]; those left out are at the box's or the model's values
    reached : where a washer has several solutions: "below" (from light load: the film branch up to
        its fold, contact beyond it) or "above" (from heavy load: contact down to its fold)
    outputs : names of the figures to keep; None: all

    Raises
    ------
    ParameterError : the model is not solved at points, or has no such figure or input
    """
    spec, model = part.spec, find_model(part.spec.key)
    if model.command is None:
        raise ParameterError(f"{spec.name}: is not solved at operating points")
    if reached not in ("below", "above"):
        raise ParameterError(f"reached = {reached!r}, allowed: 'below' or 'above'")
    own = [s.name for s in spec.inputs]
    for name in inputs:
        if name not in own:
            raise ParameterError(f"inputs: {name!r}, allowed: {', '.join(own)}")
    level = level_named(spec, part.fidelity)
    solver, warnings = level, tuple[str, ...]()
    if tables_of(spec, level) and set(scatter.names) - set(own):
        solver = spec.default_fidelity
        warnings = (OTHER_LEVEL.format(level, solver),)
    absent, least = spec.absent(part.params), model.sweep.least
    figures = {
        s.name: Figure(
            s.name,
            s.unit,
            s.help,
            low=least[s.name][0] if s.name in least else -math.inf,
            high=s.limit or math.inf,
            relative=s.relative,
        )
        for s in _shown(part)
        if s.name not in absent
    }
    if model.face(part.params) is not None:
        figures |= {
            name: Figure(name, unit, words, high=part.limits.get(name, math.inf))
            for name, (unit, words) in FACE_LOADS.items()
        }
    outputs = None if outputs is None else [part.flat_name(name) for name in outputs]
    for name in outputs or ():
        if name not in figures:
            hint = suggestion(name, part.suggesting(figures), "; did you mean {!r}?")
            raise ParameterError(f"outputs: {name!r}, allowed: {', '.join(figures)}{hint}")
    safeties = (f"{n}_below_1" for n in least if n.endswith("_safety") and n in figures)
    return PartTarget(
        part=part,
        scatter=scatter,
        inputs={**part.starts, **inputs},
        reached=reached,
        fidelity=solver,
        figures=tuple(figures[name] for name in (outputs or figures)),
        outcomes=((LOST,) if model.sweep.draws else ()) + tuple(safeties),
        warnings=warnings,
    )


def _shown(part: PartFile) -> tuple[Signal, ...]:
    """Return the outputs of a row, in their order."""
    return output_signals(part.spec)[0]


def _face_columns(
    part: PartFile, params: Sequence[Any], inputs: Array, columns: Mapping[str, Array]
) -> dict[str, Array]:
    """Return what loads the faces, (n,) each; {} of a model that has none."""
    model, names = find_model(part.spec.key), [s.name for s in part.spec.inputs]
    if model.face(part.params) is None:
        return {}
    faces = [model.face(part.params if own is None else own) for own in params]
    area, count, radius = np.array(faces, float).T
    load, speed = (inputs[:, names.index(name)] for name in ("load", "speed"))
    return face_loads(Face(area, count, radius), load, speed, columns["friction_power"])


def _below_1(columns: Mapping[str, Array], outcome: str) -> Array:
    """Return 1 where a safety is below 1, else 0; NaN where it has no value."""
    value = columns[outcome.removesuffix("_below_1")]
    return np.where(np.isnan(value), np.nan, value < 1.0)


def _digest(values: dict[str, Any]) -> str:
    return hashlib.sha256(repr(sorted(values.items())).encode()).hexdigest()[:16]
