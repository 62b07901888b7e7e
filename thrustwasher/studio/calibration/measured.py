"""Measured points of a model, checked: operating points, measured outputs, their errors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FIRST_FAILURE, ParameterError, Status, suggestion
from ...model.parameters import written_out
from ...model.part_file import PartFile
from ...model.registry import find_model
from ...model.spec import ModelSpec
from ...numerics.jit import Array
from ...settings import places
from ...units import parse_quantity
from ..evaluators.lines import output_signals
from ..sweep.sweep_plan import Plan, make_plan
from .signs import folded, odd_pressure, too_fast

FRICTIONS = {"friction": False, "friction_torque": True}  # outputs, and if they have a sign
SLIDING = "sliding_speed"  # a column in place of speed
ERROR = "_error"  # ending of the column with an output's standard deviation


@dataclass(frozen=True)
class Measured:
    """Measured values of outputs, one after the other, and the points they belong to."""

    plan: Plan
    row: NDArray[np.int64]  # (n,) place of each value's point, from 0
    output: tuple[str, ...]  # (n,)
    value: Array
    error: Array | None  # (n,) standard deviations, if known
    count: Array | None = None  # (n,) rows that each value is the mean of; None: one

    @property
    def names(self) -> tuple[str, ...]:
        """The measured outputs."""
        return tuple(dict.fromkeys(self.output))

    @property
    def pieces_text(self) -> str:
        """Of what the values are, where they hang together in pieces."""
        return ""

    def of(self, output: str) -> NDArray[np.bool_]:
        """Return which values are those of an output, (n,)."""
        return np.array([name == output for name in self.output])

    def some(self, places: NDArray[np.int64]) -> "Measured":
        """Return the values at these places alone."""
        output = tuple(self.output[i] for i in places.tolist())
        error = None if self.error is None else self.error[places]
        row, value = self.row[places], self.value[places]
        return replace(self, row=row, output=output, value=value, error=error)

    def input(self, name: str) -> Array:
        """Return an input of every value's point, (n,)."""
        place = [s.name for s in self.plan.spec.inputs].index(name)
        return np.asarray(self.plan.inputs[self.row, place])

    def values(self, changes: Mapping[str, float]) -> Array:
        """Return the outputs [SI] with changed parameters, (n,); NaN where a point fails."""
        return self.computed(changes)[0]

    def computed(self, changes: Mapping[str, float]) -> tuple[Array, dict[int, Status]]:
        """Return the outputs [SI] with changed parameters, (n,), and the rows that failed, why."""
        plan, names = self.plan, self.names
        assert plan.rows is not None
        flat = {plan.evaluator.part.flat_name(name): x for name, x in changes.items()}
        rows = replace(plan.rows, held={**plan.rows.held, **flat})
        found, codes, _ = plan.evaluator.evaluate(rows, names)
        failed = {i: Status(int(s)) for i, s in enumerate(codes) if s >= FIRST_FAILURE}
        return found[self.row, [names.index(name) for name in self.output]], failed

    def slopes(self, changes: Mapping[str, float], names: Sequence[str]) -> Array | None:
        """Return exact derivatives over parameters, (n, names), if the model has them here."""
        plan = self.plan
        assert plan.rows is not None
        own = plan.evaluator.part.flat_name
        flat = {own(name): x for name, x in changes.items()}
        rows = replace(plan.rows, held={**plan.rows.held, **flat})
        wanted = list(zip(self.row.tolist(), self.output, strict=True))
        slopes: Array | None = plan.evaluator.slopes(rows, wanted, [own(name) for name in names])
        return slopes

    def drawn_over(self, output: str) -> dict[str, tuple[str, Array]]:
        """Return unit and values (n,) of the inputs of all points, over which one is drawn."""
        plan, own = self.plan, find_model(self.plan.spec.key).fits
        left_out = own.without if output in own.units else ""
        names = (name for name in plan.units if name != left_out)
        return {name: (plan.units[name], plan.shown[name][self.row]) for name in names}


def decided(points: Measured, fitted: Sequence[str]) -> Measured:
    """Return the points with choices ``auto`` held as the parameters before the fit make them.

    ``fitted``: names of parameters that are to act.
    """
    plan = points.plan
    assert plan.rows is not None
    params = tuple(p and written_out(p, fitted) for p in plan.params)
    made = {
        f.name
        for old, new in zip(plan.params, params, strict=True)
        for f in (fields(new) if new else ())
        if getattr(old, f.name) != getattr(new, f.name)
    }
    of_row = np.repeat(plan.params_of, np.diff(plan.starts)).tolist()
    chosen = {
        name: np.array([getattr(params[i] or params[0], name) for i in of_row], object)
        for name in made
    }
    rows = replace(plan.rows, columns={**plan.rows.columns, **chosen})
    return replace(points, plan=replace(plan, params=params, rows=rows))


def output_units(spec: ModelSpec) -> dict[str, str]:
    """Return the unit of every output that can be measured."""
    return {s.name: s.unit for s in output_signals(spec)[0]} | dict(find_model(spec.key).fits.units)


def column_units(spec: ModelSpec) -> dict[str, str]:
    """Return the unit of every column that measured points may have."""
    outputs = output_units(spec)
    errors = {name + ERROR: unit for name, unit in outputs.items()}
    numbers = {p.name: p.unit for p in places(spec).values() if p.kind in ("real", "integer")}
    sliding = {SLIDING: "m/s"} if find_model(spec.key).fits.at_mean else {}
    return {**numbers, **outputs, **errors, **sliding, "line": "1"}


def with_speed(columns: Mapping[str, Any], radius: float, where: str = "data") -> dict[str, Any]:
    """Return columns with speed [rad/s] for a sliding speed [m/s] at a radius [m]."""
    found = dict(columns)
    if SLIDING not in found:
        return found
    sliding = found.pop(SLIDING)
    if "speed" in found:
        if _agree(found["speed"], sliding, radius):
            return found
        raise ParameterError(f"{where}: has speed and {SLIDING}, allowed: one of both")
    try:
        found["speed"] = (
            [None if x is None else float(x) / radius for x in sliding]
            if np.ndim(sliding)
            else float(sliding) / radius
        )
    except (TypeError, ValueError):
        raise ParameterError(f"{where}: {SLIDING} has no number, numbers [m/s] required") from None
    return found


def _agree(speed: Any, sliding: Any, radius: float) -> bool:
    """Tell if two columns say the same of how fast a radius [m] slides."""
    try:
        v, w = np.broadcast_arrays(np.asarray(speed, float) * radius, np.asarray(sliding, float))
    except (TypeError, ValueError):
        return False
    return bool(np.allclose(v, w, rtol=1e-6, atol=1e-9, equal_nan=True))


def measured(
    part: PartFile,
    data: Mapping[str, Any],
    at: Mapping[str, object],
    errors: Mapping[str, float | str],
    fidelity: str,
) -> Measured:
    """Return measured points, or name the first thing that cannot be used."""
    spec = part.spec
    units, known, own = output_units(spec), column_units(spec), find_model(spec.key).fits
    if own.at_mean and own.sliding_radius:
        data = with_speed(data, own.sliding_radius(part.params))
    for name in data:
        if name not in known:
            hint = suggestion(name, known, "did you mean {}? ") + f"outputs: {', '.join(units)}"
            if name == "time":
                hint = "rows over time are recordings, for calibrate_traces"
            raise ParameterError(
                f"column {name}: is no input, parameter or output of {spec.name}; {hint}"
            )
    lengths = {name: len(column) for name, column in data.items() if np.ndim(column)}
    if len(set(lengths.values())) > 1:
        raise ParameterError(f"data: columns of {lengths}, allowed: one length for all")
    count = next(iter(lengths.values()), 1)
    columns = {n: list(c) if n in lengths else [c] * count for n, c in data.items()}
    found = []
    for name in (n for n in columns if n in units):
        values = enumerate(columns[name])
        found += [(row, name, _number(name, row, x)) for row, x in values if x is not None]
    points = {n: c for n, c in columns.items() if n.removesuffix(ERROR) not in units}
    if not found or not set(points) - {"line"}:
        what = "input or parameter" if found else f"measured output, allowed: {', '.join(units)}"
        raise ParameterError(f"data: no {what}")
    row, output, value = zip(*found, strict=True)
    needed = {i for i, name in zip(row, output, strict=True) if name not in own.units}
    for name, column in points.items():
        for i, x in enumerate(column):
            if x is None and (name != own.without or i in needed):
                raise ParameterError(f"{name}: point {i + 1} has none")
        points[name] = [part.starts[name] if x is None else x for x in column]
    plan = make_plan(part, {}, at, points, None, fidelity)
    if plan.params[0] is None:
        raise ParameterError("data: the parameters of point 1 break a rule of the model")
    spread = _deviations(units, columns, errors, found)
    return _with_signs(Measured(plan, np.array(row), output, np.array(value), spread))


def _with_signs(points: Measured) -> Measured:
    """Return the points with friction of the sign that the model gives it, and doubtful speeds."""
    plan, value = points.plan, points.value.copy()
    radius = find_model(plan.spec.key).fits.sliding_radius
    if radius is None or "speed" not in (s.name for s in plan.spec.inputs):
        return points
    speed, said = points.input("speed"), [too_fast(points.input("speed"), radius(plan.params[0]))]
    if face := find_model(plan.spec.key).face(plan.params[0]):
        said.append(odd_pressure(points.input("load"), face.area))
    for name in [n for n in points.names if n in FRICTIONS]:
        own = points.of(name)
        error = None if points.error is None else points.error[own]
        value[own], text = folded(
            name, value[own], speed[own], error, points.row[own].tolist(), odd=FRICTIONS[name]
        )
        said.append(text)
    plan = replace(plan, warnings=(*plan.warnings, *filter(None, said)))
    return replace(points, plan=plan, value=value)


def _number(name: str, row: int, value: Any) -> float:
    """Return a measured number, or say which one is none."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number) or (name.endswith(ERROR) and number <= 0.0):
        what = "above 0" if name.endswith(ERROR) else "a finite number, or None if not measured"
        raise ParameterError(f"{name}: point {row + 1} is {value!r}, allowed: {what}")
    return number


def _deviations(
    units: Mapping[str, str],
    columns: Mapping[str, list[Any]],
    errors: Mapping[str, float | str],
    found: Sequence[tuple[int, str, float]],
) -> Array | None:
    """Return the standard deviation of every value; None if none is given."""
    names = tuple(dict.fromkeys(name for _, name, _ in found))
    for name in errors:
        if name not in names or name + ERROR in columns:
            raise ParameterError(f"error of {name}: allowed: of a measured output, and given once")
    lost = [name for name in names if name not in errors and name + ERROR not in columns]
    if lost and len(names) > 1:
        raise ParameterError(
            f"{lost[0]}{ERROR} is missing: several outputs count by their errors, each in a column "
            f"or by --error {lost[0]}=VALUE (errors = {{...}} in Python)"
        )
    if lost:
        return None
    spread = []
    for row, name, value in found:
        if name + ERROR in columns:
            given = columns[name + ERROR][row]
        elif str(errors[name]).strip().endswith("%"):  # of the measured value
            given = parse_quantity(errors[name], "1", f"error of {name}") * abs(value)
        else:
            given = parse_quantity(errors[name], units[name], f"error of {name}", difference=True)
        spread.append(_number(name + ERROR, row, given))
    return np.array(spread)
