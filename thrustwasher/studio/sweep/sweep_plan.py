"""The rows of a sweep in their order, cut into lines: one line is one path of warm starts."""

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...ladder import choose as chooser
from ...ladder.compare_levels import rows_to_compare
from ...model.advice import quantity_text, range_text
from ...model.idle import idle_warnings
from ...model.levels import level_named
from ...model.oil import oil_doubts
from ...model.parameters import params_of
from ...model.part_file import PartFile, find_part
from ...model.point import from_box, taken_text
from ...model.quantity import Quantity
from ...model.registry import find_model, spec_of
from ...model.spec import ModelSpec
from ...settings import places
from ..evaluators.evaluator import Rows
from ..evaluators.lines import check_level, output_signals
from ..evaluators.make import part_of
from ..evaluators.part import PartEvaluator
from .axes import MOST_POINTS, Axis, find_quantity, read_axis

Array = NDArray[np.float64]
CHUNK = 10_000  # rows worked on at a time


@dataclass(frozen=True)
class Plan:
    """What is solved: row by row the inputs, line by line the parameters.

    Lines are consecutive rows; line ``i`` is rows ``starts[i] .. starts[i + 1] - 1``.
    """

    spec: ModelSpec
    fidelity: str
    columns: dict[str, Array]  # inputs as the model takes them; NaN: not an allowed point
    shown: dict[str, Any]  # columns of the table before the outputs, by name
    units: dict[str, str]  # of the columns shown
    starts: NDArray[np.int64]  # (n_lines + 1,)
    params: tuple[Any, ...]  # parameter objects; None: broken rule
    params_of: NDArray[np.int64]  # (n_lines,) index into params
    identity: dict[str, str] = field(default_factory=dict)  # digests by what they stand for
    choice: str = ""  # why this level was chosen, if it was
    taken: str = ""  # the inputs that were not given, and where their values come from
    warnings: tuple[str, ...] = ()  # of points outside the part's box
    evaluator: Any = None  # the part
    rows: Rows | None = None  # what it evaluates
    asked: tuple[str, ...] = ()  # what is varied, in the order in which it was named

    @cached_property
    def inputs(self) -> Array:
        """The inputs side by side, (n_rows, n_inputs); made when it is first needed."""
        return np.column_stack(list(self.columns.values()))

    @property
    def n_rows(self) -> int:
        """Number of points."""
        return int(self.starts[-1])

    @property
    def model(self) -> str:
        """Key of the model."""
        return self.spec.key

    @property
    def figures(self) -> tuple[str, ...]:
        """What is asked of each row: outputs, real ones first, but the status."""
        real, whole = output_signals(self.spec)
        return tuple(s.name for s in (*real, *whole[:-1]))

    def columns_at(self, rows: slice) -> dict[str, Any]:
        """Return the columns of the table before the outputs; they can be written."""
        found = {name: column[rows] for name, column in self.shown.items()}
        return {name: x if x.flags.writeable else x.copy() for name, x in found.items()}

    def check(self) -> None:
        """Refuse a level that its parameters do not have, where all rows have the same."""
        if len(self.params) == 1:
            check_level(self.spec, self.fidelity, self.params[0])


def make_plan(
    model: str | PartFile,
    over: Mapping[str, Any],
    at: Mapping[str, object],
    points: Mapping[str, object] | None,
    params: object,
    fidelity: str | None,
) -> Plan:
    """Return the plan of a sweep; arguments as in ``run_sweep``."""
    part = part_of(spec_of(model).key if isinstance(model, str) else model)
    spec, params = spec_of(part.spec.key), part.params if params is None else params
    known = part.suggesting(places(spec))
    at = {part.flat_name(name): value for name, value in at.items()}
    over = {part.flat_name(name): values for name, values in over.items()}
    asked = part.fidelity if fidelity is None else fidelity
    level, tolerance = chooser.level_and_tolerance(spec.key, spec, asked)
    base = params_of(spec, params)
    held = held_values(at, known, spec)
    axes = [read_axis(name, values, known, spec) for name, values in over.items()]
    if points is None:
        rows, lines, order = grid(axes)
    else:
        if axes:
            raise ParameterError("points: allowed: without axes to vary; it names every point")
        points = {part.flat_name(name): values for name, values in points.items()}
        rows, lines, order = listed(points, known, spec)
    given = [*held, *(a.place.name for a in axes), *(rows if points is not None else ())]
    twice = [name for name in given if given.count(name) > 1]
    if twice:
        raise ParameterError(f"{twice[0]}: is given twice, allowed: varied or held, once")
    plan = _assemble(part, level, base, held, rows, lines, [known[name] for name in order])
    plan = replace(plan, asked=tuple(a.place.name for a in axes) or tuple(rows))
    return plan if tolerance is None else _chosen(plan, tolerance)


def _chosen(plan: Plan, tolerance: float) -> Plan:
    """Return the plan with the level that is chosen for all of its points."""
    if len(plan.params) != 1:
        raise ParameterError("fidelity = 'auto': allowed: without varied parameters")
    rows = plan.inputs[np.isfinite(plan.inputs).all(axis=1)]
    if not len(rows):
        raise ParameterError(
            "fidelity = 'auto': no point has allowed inputs to choose for; change them or name "
            "a fidelity level"
        )
    names, low, high = [s.name for s in plan.spec.inputs], rows.min(0), rows.max(0)
    choice = chooser.choose(
        plan.spec.key,
        dict(zip(names, zip(low, high, strict=True), strict=True)),
        tol=tolerance,
        n_calls=plan.n_rows,
        params=plan.params[0],
        points=[dict(zip(names, row, strict=True)) for row in rows_to_compare(rows).tolist()],
    )
    identity = {**plan.identity, "fidelity": choice.fidelity}
    chosen = replace(plan.evaluator, fidelity=choice.fidelity)
    more: dict[str, Any] = {"choice": str(choice), "identity": identity, "evaluator": chosen}
    return replace(plan, fidelity=choice.fidelity, **more)


def held_values(
    at: Mapping[str, object], known: Mapping[str, Quantity], spec: ModelSpec | None = None
) -> dict[str, Any]:
    """Return what is held at one value, by name."""
    found = {}
    for name, value in at.items():
        axis = read_axis(name, value if isinstance(value, str) else [value], known, spec)
        if len(axis.values) != 1:
            raise ParameterError(f"{axis.place.name} = {value}, allowed: one value")
        found[axis.place.name] = axis.values[0]
    return found


def grid(axes: list[Axis]) -> tuple[dict[str, Any], NDArray[np.int64], list[str]]:
    """Return the columns of a full grid, the starts of its lines, the names, fastest first."""
    if not axes:
        raise ParameterError("over: nothing is varied, allowed: NAME=VALUES, e.g. load=50:1850:50")
    order = [a for a in axes if a.place.is_input] + [a for a in axes if not a.place.is_input]
    sizes = [len(a.values) for a in order]
    n = int(np.prod(sizes, dtype=float))
    if n > MOST_POINTS:
        shape = " x ".join(map(str, sizes))
        raise ParameterError(f"over: {shape} = {n} points, allowed: up to {MOST_POINTS}")
    columns, inner = {}, 1
    for axis, size in zip(order, sizes, strict=True):
        kind = float if axis.place.kind == "real" else object
        values = np.array(axis.values, kind)
        columns[axis.place.name] = np.tile(np.repeat(values, inner), n // (inner * size))
        inner *= size
    long = sizes[0] if order[0].place.is_input else 1
    return columns, np.arange(0, n + 1, long), [a.place.name for a in order]


def listed(
    points: Mapping[str, Any],
    known: Mapping[str, Quantity],
    spec: ModelSpec | None = None,
) -> tuple[dict[str, Any], NDArray[np.int64], list[str]]:
    """Return the columns of given points; rows with the same number in ``line`` are one line."""
    columns: dict[str, Any] = {}
    for name, values in points.items():
        if name == "line":
            continue
        place = find_quantity(name, known, spec)
        if not np.ndim(values):
            raise ParameterError(
                f"points: {name} = {values!r}, allowed: a column; what all points share: at"
            )
        columns[name] = _allowed(place, values)
    lengths = {name: len(values) for name, values in points.items()}
    if not columns or len(set(lengths.values())) != 1 or not 0 < min(lengths.values()):
        raise ParameterError(f"points: columns of {lengths}, allowed: one length for all, above 0")
    n = len(next(iter(columns.values())))
    if n > MOST_POINTS:
        raise ParameterError(f"points: {n}, allowed: up to {MOST_POINTS}")
    first = np.ones(n, bool)
    if "line" in points:
        mark = np.asarray(points["line"], float)
        first[1:] = mark[1:] != mark[:-1]
        for name, column in columns.items():
            if not known[name].is_input:
                first[1:] |= column[1:] != column[:-1]
    return columns, np.append(np.flatnonzero(first), n), list(columns)


def _allowed(place: Quantity, values: Any) -> NDArray[Any]:
    """Return a column of allowed values; numbers in their range are checked at once."""
    if place.kind != "real":
        return np.array([_checked(place, i, v) for i, v in enumerate(values)], object)
    if np.ndim(values) > 1:
        shape = " x ".join(map(str, np.shape(values)))
        raise ParameterError(f"points: {place.name} has {shape} values, allowed: one axis")
    if np.ma.isMaskedArray(values):
        values = np.ma.filled(values.astype(float), np.nan)
    plain = np.asarray(values)
    if plain.dtype.kind in "fiu":
        numbers = plain.astype(float) + 0.0  # no -0
        if ((place.low <= numbers) & (numbers <= place.high)).all():
            return numbers
    return np.array([_checked(place, i, v) for i, v in enumerate(values)], float)


def _checked(place: Quantity, i: int, value: object) -> Any:
    """Return one value of a column, or say at which point it is not allowed."""
    try:
        return place.check(value)
    except ParameterError as problem:
        raise ParameterError(f"point {i + 1}: {problem}") from None


def _assemble(
    part: PartFile,
    fidelity: str,
    base: object,
    held: dict[str, Any],
    rows: dict[str, Any],
    starts: NDArray[np.int64],
    order: list[Quantity],
) -> Plan:
    """Fill in what is not varied and give every line its parameters."""
    n, spec = int(starts[-1]), part.spec
    varied = [place.name for place in order if not place.is_input]
    fixed = {k: v for k, v in held.items() if k in spec.params.__dataclass_fields__}
    params, params_of = _parameters(base, fixed, [rows[name] for name in varied], varied, starts)
    shown: dict[str, Any] = {}
    if "power" in rows or "power" in held:
        if "load" in rows or "load" in held:
            raise ParameterError("power: allowed: instead of load, not with it")
        shown["power"] = _column(rows.get("power", held.get("power")), n)
    inputs, starts_at = dict[str, Array](), part.starts
    plain = find_part(spec.key).starts
    box: dict[str, float] = {}
    default: dict[str, float] = {}
    for s in spec.inputs:
        inputs[s.name] = _column(rows.get(s.name, held.get(s.name, starts_at[s.name])), n)
        if not (s.name in rows or s.name in held or (s.name == "load" and "power" in shown)):
            mine = from_box(part, s.name, starts_at[s.name], plain[s.name])
            (box if mine else default)[s.name] = starts_at[s.name]
    if "power" in shown:
        largest = next(s.high for s in spec.inputs if s.name == "load") or 0.0
        inputs["load"] = np.empty(n)
        for a in range(0, n, CHUNK):  # some at a time: rows may be many
            at = slice(a, a + CHUNK)
            power, speed, torque = shown["power"][at], inputs["speed"][at], inputs["load"][at]
            with np.errstate(divide="ignore", invalid="ignore"):
                torque[:] = np.where(power == 0.0, 0.0, np.abs(power / speed))
            # NaN where the power asks for more than is allowed
            torque[~(torque <= largest)] = np.nan
    shown |= inputs
    units = {s.name: s.unit for s in spec.inputs} | ({"power": "W"} if "power" in shown else {})
    for name in varied:
        shown[name] = rows[name]
        units[name] = next(p.unit for p in order if p.name == name)
    level = level_named(spec, fidelity)
    one = len(params) == 1  # as of most sweeps, whose rows may be many
    part_of = np.zeros(n, np.int8) if one else np.repeat(params_of, np.diff(starts))
    warnings = (
        *_idle(params, fidelity, spec.key),
        *_of_oil(part, params, inputs),
        *_outside(part, inputs),
        *_doubt(spec, level, params, part_of, inputs),
    )
    rows_and_lines = inputs, shown, units, starts, params, params_of
    taken = taken_text(box, default, spec.inputs)
    own = replace(part, parameters={f.name: getattr(base, f.name) for f in fields(spec.params)})
    evaluator = PartEvaluator(part=own, inputs=starts_at, reached="below", fidelity=level)
    columns = {**inputs, **{name: rows[name] for name in varied}}
    evaluated = Rows(columns=columns, starts=starts, held=fixed)
    more: dict[str, Any] = {"taken": taken, "warnings": warnings}
    more |= {"evaluator": evaluator, "rows": evaluated}
    plan = Plan(spec, level, *rows_and_lines, **more)
    plan.identity.update(_identity(plan, base, fixed, varied))
    return plan


def _column(given: Any, n: int) -> Array:
    """Return a column, or one number as a column that takes no memory and cannot be written."""
    return np.asarray(given, float) if np.ndim(given) else np.broadcast_to(float(given), n)


def _idle(params: Sequence[object], fidelity: str, model: str) -> Iterator[str]:
    """Yield a warning for each choice that leaves parameters unread, at the first row or last."""
    lines = [t for p in (params[0], params[-1]) if p for t in idle_warnings(model, p, fidelity)]
    yield from {text.partition(" = ")[0]: text for text in lines}.values()


def _of_oil(part: PartFile, params: Sequence[object], inputs: Mapping[str, Array]) -> Iterator[str]:
    """Yield what is doubtful of the oil at the coldest and warmest point, at first row or last."""
    column = inputs.get("oil_temperature")
    if column is None or not np.isfinite(column).any():
        return
    ends = float(np.nanmin(column)), float(np.nanmax(column))
    for own in filter(None, dict.fromkeys((params[0], params[-1]))):
        if lines := oil_doubts(part.oil, part.spec, own, ends):
            yield from lines
            return


def _doubt(
    spec: ModelSpec,
    fidelity: str,
    params: Sequence[object],
    part_of: NDArray[np.integer[Any]],
    columns: Mapping[str, Array],
) -> Iterator[str]:
    """Yield what the model says of all rows; of several parts what it says of the first of them.

    ParameterError: the only part has no answer to a row; of several that is a warning.
    """
    doubt = find_model(spec.key).sweep.doubt
    if doubt is None:
        return
    every = list(columns.values())
    sound = np.logical_and.reduce([np.isfinite(column) for column in every])
    for k, part in enumerate(params):
        if part is None:
            continue
        own = sound & (part_of == k)
        try:
            text = doubt(part, fidelity, every if own.all() else [c[own] for c in every])
        except ParameterError as problem:
            if len(params) == 1:
                raise
            text = str(problem)
        if text:
            yield text
            return


def _outside(part: PartFile, inputs: Mapping[str, Array]) -> Iterator[str]:
    """Yield a warning for each input of which some points lie outside the part's box."""
    for s in part.spec.inputs:
        if s.name not in part.box:
            continue
        low, high = part.box[s.name]
        every = inputs[s.name]
        column = every[np.isfinite(every)]
        beyond = column[(column < low) | (column > high)]
        if len(beyond):
            yield (
                f"{len(beyond)} of {len(every)} points, as {quantity_text(s, beyond[0])}, are "
                f"outside {range_text(s, (low, high))}, the part's box: solved all the same, "
                "but not what the part is meant for"
            )


def _parameters(
    base: Any,
    fixed: dict[str, Any],
    columns: list[Any],
    names: list[str],
    starts: NDArray[np.int64],
) -> tuple[tuple[Any, ...], NDArray[np.int64]]:
    """Return the parameter objects of all lines and the index of each line's."""
    keys = list(zip(*(column[starts[:-1]].tolist() for column in columns), strict=True))
    if not names:
        keys = [()] * (len(starts) - 1)
    numbers: dict[Any, int] = {}
    of_line = np.array([numbers.setdefault(key, len(numbers)) for key in keys], np.int64)
    found, first_error = [], None
    for key in numbers:
        try:
            found.append(replace(base, **fixed, **dict(zip(names, key, strict=True))))
        except ParameterError as error:
            first_error = first_error or error
            found.append(None)
    if first_error and not any(found):
        raise first_error
    return tuple(found), of_line


def _identity(
    plan: Plan, base: Any, fixed: dict[str, Any], varied: Iterable[str]
) -> dict[str, str]:
    """Return a digest of each thing that makes this sweep another one than the next."""
    from ...native.digest import digest as native_digest

    held = {k: v for k, v in {**asdict(base), **fixed}.items() if k not in set(varied)}
    parts: dict[str, Any] = {"model": plan.spec.key, "fidelity": plan.fidelity}
    parts |= {"parameters": repr(held), **plan.shown, "lines": plan.starts}
    parts["version of thrustwasher"] = native_digest(plan.spec.kernel)
    return {name: digest(part) for name, part in parts.items()}


def digest(part: Any) -> str:
    """Return the digest of a text or of a column."""
    if not isinstance(part, str):
        part = repr(part.tolist()) if part.dtype == object else np.ascontiguousarray(part)
    return hashlib.sha256(part.encode() if isinstance(part, str) else part).hexdigest()[:16]
