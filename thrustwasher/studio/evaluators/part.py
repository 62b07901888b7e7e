"""A part at a point: any model that is solved at points, a steady state in every row."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, fields, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import FIRST_FAILURE, ParameterError, SolveError, Status
from ...face_load import FACE_LOADS, Face, face_loads
from ...ladder.error_table import QUANTITIES, error_estimate
from ...model.advice import quantity_text
from ...model.levels import level_named
from ...model.part_file import PartFile, part_text
from ...model.point import point_of
from ...model.prepare import filled, tables_of
from ...model.quantity import Figure, Quantity
from ...model.registry import find_model, kernel_of
from ...model.scatter import Scatter
from ...model.spec import Signal
from ...units import format_quantity
from .evaluator import Answers, Array, Codes, Effort, Remark, Row, Rows, Slopes, digest_of
from .limits import beyond
from .lines import Task, output_signals, solve_task
from .part_curve import FOLDS, curve_of, fold_loads, fold_slopes

LOST = "film_lost"
REASONS = ("parameters that do not go together", "not converged")
OTHER_LEVEL = (
    "fidelity = {!r} answers for the part's own parameters alone: solved with {!r}, as "
    "parameters {}"
)


@dataclass(frozen=True, kw_only=True)
class PartEvaluator:
    """A part at a point, see ``part_evaluator``."""

    part: PartFile
    inputs: Mapping[str, float]
    """All the model's own inputs [SI]; those of a row are in their place."""
    reached: str
    fidelity: str
    """The level that solves."""
    remarks: tuple[Remark, ...] = ()
    kind: Literal["part"] = "part"
    time = np.empty(0)
    costly: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.part.name

    @property
    def model(self) -> str:
        """The command that solves it."""
        return self.part.spec.key

    @property
    def reasons(self) -> dict[int, str]:
        """Every status of a failure."""
        found = {int(s): REASONS[s != Status.BAD_INPUT] for s in Status if s.is_failure}
        return dict(sorted(found.items(), key=lambda pair: REASONS.index(pair[1])))

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """Its parameters and inputs."""
        return self.part.places(self.inputs)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Its outputs and outcomes; of a washer the loads of its folds too."""
        found = {f.name: f for f in (*self._outputs(), *self._outcomes())}
        told = find_model(self.part.spec.key).own_names(None)
        found = {n: replace(f, help=self.part.own_text(told(f.help))) for n, f in found.items()}
        if self.part.spec.key == "washer":
            for name, (_, words) in FOLDS.items():
                found[name] = Figure(name, "N", words, of_curve=True)
        named = self.part.named(found)
        absent = self.part.spec.absent(self.part.params)
        named.absent = tuple(map(self.part.own_name, absent))
        return named

    @cached_property
    def measurable(self) -> dict[str, Figure]:
        """What rows give that can be measured, by name; studies list figures alone."""
        model = find_model(self.part.spec.key)
        found = {s.name: Figure(s.name, s.unit, s.help) for s in self.part.spec.outputs if _real(s)}
        more = {"loss_factor": ("1", "power of friction over that transmitted")}
        more |= model.command.extra if model.command else {}
        more |= {name: (unit, "") for name, unit in model.fits.units.items()}
        return found | {name: Figure(name, *words) for name, words in more.items()}

    @property
    def signals(self) -> dict[str, str]:
        """None: a part stands."""
        return {}

    @property
    def identity(self) -> dict[str, str]:
        """Model, parameters, point and what else decides the answers."""
        return {
            "model": self.part.spec.key,
            "parameters": digest_of(asdict(self.part.params)),
            "inputs": digest_of(dict(self.inputs)),
            "fidelity": self.fidelity,
            "reached": self.reached,
        }

    def setting(self, scatter: Collection[str]) -> dict[str, str]:
        """Return level, inputs that do not scatter and a named oil, as words."""
        found = {"fidelity level": self.fidelity}
        for s in self.part.spec.inputs:
            value = self.inputs[s.name]
            if s.name not in scatter and (value or not s.optional):
                found[s.name] = format_quantity(value, s.unit, difference=s.relative)
        return found | ({"oil": self.part.oil_words} if self.part.oil else {})

    def under(self, scatter: Scatter, _figures: Sequence[str]) -> "PartEvaluator":
        """Return it with a level that answers for other parameters, if any scatter."""
        if set(scatter.names) - set(self.inputs):
            return self._with_other_level("scatter")
        return self

    def searched(self) -> "PartEvaluator":
        """Return it with a level that answers for other parameters."""
        found = self._with_other_level("are varied")
        return replace(found, part=replace(found.part, fidelity=found.fidelity))

    def shorter_step(self, *_: Any) -> tuple[None, str]:
        """Return nothing: a row is one operating point."""
        return None, ""

    def with_step(self, _step: float) -> "PartEvaluator":
        """Return the same: it has no time step."""
        return self

    def _flat(self, names: Sequence[str]) -> Sequence[str]:
        """Return the model's names of figures or quantities, which a file may call otherwise."""
        return [self.part.flat_name(name) for name in names] if self.part.names else names

    def _with_other_level(self, how: str) -> "PartEvaluator":
        spec, level = self.part.spec, self.fidelity
        if not tables_of(spec, level):
            return replace(self, fidelity=level)
        other = spec.default_fidelity
        text = OTHER_LEVEL.format(level, other, how)
        return replace(self, fidelity=other, remarks=(Remark("warning", text), *self.remarks))

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Any = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return figures of rows; load curves on few nodes unless they are ``shown``.

        ``Rows`` are walked line by line, each row warm from the one before it; choices ``auto`` are
        made anew by the parameters of each. Other rows stand alone, with the choices of the part.
        """
        figures = self._flat(figures)
        if isinstance(rows, Rows):
            return self._walked(rows, figures)
        values = np.full((len(rows), len(figures)), np.nan)
        codes = np.zeros(len(rows), np.int32)
        besides = [name for name in figures if self.part.own_name(name) not in self.figures]
        if any(name not in (*FOLDS, *besides) for name in figures):
            columns, codes = self._points(rows)
            for i, name in enumerate(figures):
                if name in columns:
                    values[:, i] = columns[name]
            values[codes >= FIRST_FAILURE] = np.nan
        for k, row in enumerate(rows if besides else ()):
            with suppress(ParameterError):
                params, given = self.part.varied(row)
                found = self._besides(params, {**self.inputs, **given}, besides)
                for name, value in found.items():
                    values[k, list(figures).index(name)] = value
        if any(name in FOLDS for name in figures):
            for i, row in enumerate(rows):
                with suppress(ParameterError, SolveError):
                    loads = fold_loads(self._curve(row, effort))
                    for column, name in enumerate(figures):
                        if name in FOLDS:
                            values[i, column] = loads.get(name, math.nan)
        return Answers(values, codes)

    def gradient(
        self, row: Row, figures: Sequence[str], quantities: Sequence[str], effort: Effort = "search"
    ) -> Slopes | None:
        """Return figures (m,) and their slopes (m, k); None over inputs or past a fold."""
        own = {f.name for f in fields(self.part.spec.params)}
        figures, quantities = self._flat(figures), self._flat(quantities)
        if self.reached != "below" or not own.issuperset(quantities):
            return None
        values = np.full(len(figures), np.nan)
        slopes = np.full((len(figures), len(quantities)), np.nan)
        try:
            tables = self._tables(row, figures, quantities, effort)
        except ParameterError:
            return None
        except SolveError:
            return Slopes(values, slopes)
        for i, name in enumerate(figures):
            if name in tables:
                values[i], table = tables[name]
                slopes[i] = [table[n] for n in quantities]
        return Slopes(values, slopes)

    def file(self, row: Row, *, draw: bool = False) -> str:
        """Return the part file of a row; inputs that are varied are its box, of a draw all."""
        part, inputs = self._design(row)
        box = {n: (x, x) for n, x in inputs.items() if draw or n in row}
        if draw:
            return part_text(replace(part, box=box, scatter={}))
        return part_text(replace(part, box={**part.box, **box}))

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how it scatters, at its values or at those of a row."""
        if row is None:
            return self.part.scattered(table, self.inputs)
        part, inputs = self._design(row)
        return part.scattered(table, inputs)

    def nominal(self, figures: Sequence[str], _signals: Sequence[str]) -> Answers:
        """Return the row with all values as they are; NaN if it has no solution."""
        return self.evaluate([{}], figures)

    def touches(self, _source: str) -> bool:
        """Any quantity may matter."""
        return True

    @property
    def note(self) -> str:
        """The level and the point about which inputs scatter."""
        inputs = self.part.spec.inputs
        shown = [s for s in inputs if not (s.optional and self.inputs[s.name] == s.usual)]
        point = ", ".join(quantity_text(s, self.inputs[s.name]) for s in shown)
        return f"solved with {self.fidelity!r} at {point}"

    def why(self, row: Row) -> str:
        """Return why a row failed, as its parameters say; "" if these go together."""
        try:
            params, _ = self.part.varied(row)
            kernel = kernel_of(self.part.spec)
            filled(self.part.spec, params, self.fidelity, kernel.NPAR, kernel.derive)
        except ParameterError as problem:
            return str(problem)
        return ""

    def doubts(self, figures: Sequence[str], base: Array) -> list[str]:
        """Return what single solves would warn of, of the nominal run and the base runs (N, m)."""
        found = list(point_of(self.part, dict(self.inputs)).warnings)
        nominal = self.evaluate([{}], figures).values
        for words, rows in (("nominal run", nominal), ("base runs", base)):
            columns = dict.fromkeys([s.name for s in self.part.spec.outputs], np.full(1, np.nan))
            columns |= {name: rows[:, i] for i, name in enumerate(self._flat(figures))}
            for x in beyond(self.part.spec, columns):
                one = x.text(len(rows)).partition(", ")[2]
                text = x.text(len(rows)).replace(" points,", f" {words},")
                found.append(f"{words}: {one}" if len(rows) == 1 else text)
        return found

    def error(self) -> dict[str, float]:
        """Return the mesh's error of figures at the nominal point.

        Of a washer's torque it is what the solution itself tells, else by the table of errors.
        """
        names = [n for n, f in self.figures.items() if not f.of_curve]
        values = dict(zip(names, self.evaluate([{}], names).values[0].tolist(), strict=True))
        branch = None
        if LOST in values:
            branch = "contact" if values[LOST] else "film"
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

    def _points(self, rows: Sequence[Row]) -> tuple[dict[str, Array], Codes]:
        """Return figures and outcomes of rows that stand alone, as columns, and statuses."""
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
        columns = dict(zip([s.name for s in self._shown], numbers.T, strict=True))
        columns |= self._face_columns(params, inputs, columns)
        for f in self._outcomes():
            columns[f.name] = lost if f.name == LOST else _below_1(columns, f.name)
        return columns, status.astype(np.int32)

    def _solved(
        self, params: tuple[object, ...], inputs: Array
    ) -> tuple[Array, Codes, NDArray[np.float64]]:
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

    def slopes(
        self, rows: Rows, wanted: Sequence[tuple[int, str]], quantities: Sequence[str]
    ) -> Array | None:
        """Return exact derivatives of figures of rows in lines over parameters.

        Parameters
        ----------
        rows : in lines, each walked as by ``evaluate``
        wanted : place of a row and a figure, n of them
        quantities : names of parameters

        Returns
        -------
        (n, quantities), or None where the model has none here
        """
        exact = find_model(self.part.spec.key).fits.slopes
        found = np.empty((len(wanted), len(quantities)))
        if exact is None:
            return None
        inputs, params = self._lines(rows)
        for first, end, own in zip(rows.starts[:-1], rows.starts[1:], params, strict=True):
            here = [k for k, (row, _) in enumerate(wanted) if first <= row < end]
            asked = [(wanted[k][0] - int(first), wanted[k][1]) for k in here]
            if own is None:
                return None
            of_line = exact(own, inputs[first:end], self.fidelity, asked, quantities)
            if of_line is None:
                return None
            found[here] = of_line
        return found

    def _walked(self, rows: Rows, figures: Sequence[str]) -> Answers:
        """Return figures of rows in lines; whole numbers too, enumerations from 1."""
        spec = self.part.spec
        inputs, params = self._lines(rows)
        starts = tuple(rows.starts.tolist())
        numbers, flags = solve_task(Task(spec.key, self.fidelity, 0, inputs, starts, params))
        real, whole = output_signals(spec)
        columns = {s.name: numbers[:, i] for i, s in enumerate(real)}
        columns |= {s.name: flags[:, i].astype(float) for i, s in enumerate(whole)}
        failed = flags[:, -1] >= FIRST_FAILURE
        columns = {name: np.where(failed, np.nan, column) for name, column in columns.items()}
        if besides := [name for name in figures if name not in columns]:
            table = np.full((len(rows), len(besides)), np.nan)
            names = [s.name for s in spec.inputs]
            for i, point in enumerate(inputs.tolist()):
                own = params[int(np.searchsorted(rows.starts, i, "right")) - 1]
                if own is not None:
                    at = dict(zip(names, point, strict=True))
                    table[i] = [*self._besides(own, at, besides).values()]
            columns |= dict(zip(besides, table.T, strict=True))
        values = np.column_stack([columns[name] for name in figures])
        return Answers(values, flags[:, -1].astype(np.int32))

    def _lines(self, rows: Rows) -> tuple[Array, tuple[Any, ...]]:
        """Return the inputs (n, inputs) of rows, and the parameters of each line or None."""
        spec, n = self.part.spec, len(rows)
        own = {f.name for f in fields(spec.params)}
        inputs = np.empty((n, len(spec.inputs)))
        for i, s in enumerate(spec.inputs):
            inputs[:, i] = rows.columns.get(s.name, rows.held.get(s.name, self.inputs[s.name]))
        varied = [name for name in rows.columns if name in own]
        held = {name: value for name, value in rows.held.items() if name in own}
        base, known = self.part.params, dict[tuple[Any, ...], Any]()
        keys = [rows.columns[name][rows.starts[:-1]].tolist() for name in varied]
        lines = list(zip(*keys, strict=True)) if varied else [()] * (len(rows.starts) - 1)
        for key in dict.fromkeys(lines):
            known[key] = None
            with suppress(ParameterError):
                known[key] = replace(base, **{**dict(zip(varied, key, strict=True)), **held})
        return inputs, tuple(known[key] for key in lines)

    def _besides(
        self, params: Any, inputs: Mapping[str, float], names: Sequence[str]
    ) -> dict[str, float]:
        """Return what no row of the kernel has: of a result, or of folds; NaN where there is none.

        ParameterError: an input is out of its range.
        """
        model, found = find_model(self.part.spec.key), dict.fromkeys(names, math.nan)
        fits = model.fits
        if fits.computed and not fits.units.keys().isdisjoint(names):
            loads = fits.computed(params, inputs, self.fidelity)
            found |= {name: x for name, x in loads.items() if name in found}
        if rest := [name for name in names if name not in fits.units]:
            point: Any = model.back(dict(inputs))
            result = model.solve(params, **point, fidelity=self.fidelity, throw=False)
            if not result.status.is_failure:
                found |= {name: float(getattr(result, name)) for name in rest}
        return found

    @property
    def _shown(self) -> tuple[Signal, ...]:
        """The outputs of a row, in their order."""
        return output_signals(self.part.spec)[0]

    def _outputs(self) -> Iterator[Figure]:
        """Yield the outputs that it has, and what loads its faces."""
        part, model = self.part, find_model(self.part.spec.key)
        absent, least = part.spec.absent(part.params), model.sweep.least
        for s in self._shown:
            if s.name not in absent:
                low = least[s.name][0] if s.name in least else -math.inf
                yield Figure(s.name, s.unit, s.help, low, s.limit or math.inf, s.relative)
        if model.face(part.params) is not None:
            for name, (unit, words) in FACE_LOADS.items():
                yield Figure(name, unit, words, high=part.limits.get(name, math.inf))

    def _outcomes(self) -> Iterator[Figure]:
        """Yield what a row says yes or no to."""
        model, known = find_model(self.part.spec.key), {f.name for f in self._outputs()}
        if model.sweep.draws:
            yield Figure(LOST, "1", "the oil film is lost", kind="outcome")
        for name in model.sweep.least:
            if name.endswith("_safety") and name in known:
                yield Figure(f"{name}_below_1", "1", f"{name} below 1", kind="outcome")

    def _face_columns(
        self, params: Sequence[Any], inputs: Array, columns: Mapping[str, Array]
    ) -> dict[str, Array]:
        """Return what loads the faces, (n,) each; {} of a model that has none."""
        part = self.part
        model, names = find_model(part.spec.key), [s.name for s in part.spec.inputs]
        if model.face(part.params) is None:
            return {}
        faces = [model.face(part.params if own is None else own) for own in params]
        load, speed = (inputs[:, names.index(name)] for name in ("load", "speed"))
        whole = Face(*np.array(faces, float).T)
        return face_loads(whole, load, speed, columns["friction_power"])

    def _design(self, row: Row) -> tuple[PartFile, dict[str, float]]:
        """Return the part of a row, and its inputs; ParameterError."""
        params, inputs = self.part.varied(row)
        given = {f.name: getattr(params, f.name) for f in fields(params)}
        return replace(self.part, parameters=given), {**self.inputs, **inputs}

    def _curve(self, row: Row, effort: Effort) -> Any:
        part, inputs = self._design(row)
        return curve_of(part.params, inputs, self.fidelity, closely=effort == "shown")

    def _tables(
        self, row: Row, figures: Sequence[str], names: Sequence[str], effort: Effort
    ) -> dict[str, tuple[float, Mapping[str, float]]]:
        """Return value and derivatives of each figure that has them."""
        found: dict[str, tuple[float, Mapping[str, float]]] = {}
        of_point = [name for name in figures if name not in FOLDS]
        if of_point:
            part, inputs = self._design(row)
            result = part.solve(**inputs, fidelity=self.fidelity)
            slopes = result.sensitivities(of_point, names)
            found |= {name: (getattr(result, name), slopes[name]) for name in of_point}
        if len(of_point) < len(figures):
            found |= fold_slopes(self._curve(row, effort), names)
        return found


def part_evaluator(
    part: PartFile, inputs: Mapping[str, float], reached: str = "below"
) -> PartEvaluator:
    """Return a part as what is evaluated.

    Parameters
    ----------
    part : of a model that is solved at points; a clutch slips for ever, as in a sweep
    inputs : of the model [SI]; those left out are at the box's or the model's values
    reached : where a washer has several solutions: "below" (from light load: the film branch up to
        its fold, contact beyond it) or "above" (from heavy load: contact down to its fold)

    Raises
    ------
    ParameterError : the model is not solved at points, or has no such input
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
    return PartEvaluator(
        part=part,
        inputs={**part.starts, **inputs},
        reached=reached,
        fidelity=level_named(spec, part.fidelity),
    )


def _real(signal: Signal) -> bool:
    return signal.kind == "real"


def _below_1(columns: Mapping[str, Array], outcome: str) -> Array:
    """Return 1 where a safety is below 1, else 0; NaN where it has no value."""
    value = columns[outcome.removesuffix("_below_1")]
    return np.where(np.isnan(value), np.nan, value < 1.0)
