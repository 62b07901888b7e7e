"""Solutions of a model, at a point and over time, as a person reads them: in its record's words."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from enum import Enum
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self

from ..errors import Status
from ..face_load import LIMITED
from ..shown import (
    Card,
    Line,
    Shown,
    Tabled,
    Words,
    column_lines,
    pandas_for,
    plain,
    public_names,
    short_text,
    text_of,
)
from .point import Point
from .record import Model
from .registry import find_model
from .spec import ModelSpec


class Asked(NamedTuple):
    """What a result was requested with."""

    model: str
    params: Any
    point: Mapping[str, Any]  # level included


class AtPoint(Shown):
    """Base of results at an operating point."""

    __slots__ = ()
    warnings: tuple[str, ...]
    status: Status

    def __init_subclass__(cls, **more: Any) -> None:
        """Keep the short text: that of a dataclass would be all fields and parameters."""
        super().__init_subclass__(**more)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = AtPoint.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        """Return point, status, number of warnings and results, in under 1500 characters."""
        key, params, point = self.request()
        model = find_model(key)
        head = f"{type(self).__name__}: {heading(model, params, point)}"
        said = f"  {self.status.name}, warnings: {len(self.warnings)}"
        return short_text([head, said], point_lines(model, self, point), "results")

    def request(self) -> Asked:
        """Return model, parameters and point that it is the solution of."""
        raise NotImplementedError(type(self).__name__)

    def to_pandas(self) -> Any:
        """Return inputs and results that are numbers as a ``pandas.Series``, NaN where none is.

        Units [SI] are in ``attrs["units"]``, the status by name in ``attrs["status"]``.

        Raises
        ------
        EnvironmentProblem : there is no pandas; the message says how to get it
        """
        pandas = pandas_for(self)
        key, _, point = self.request()
        model = find_model(key)
        words = words_at_points(model)
        given = {name: point.get(name) for name in (s.name for s in model.inputs())}
        found = {**given, **scalars(self)}
        numbers = {
            name: math.nan if value is None else float(value)
            for name, value in found.items()
            if name in words and (value is None or _is_number(value))
        }
        series = pandas.Series(numbers, name=key, dtype=float)
        series.attrs = {
            "units": {name: words[name].unit for name in numbers},
            "status": self.status.name,
        }
        return series

    def _card(self) -> Card:
        key, params, point = self.request()
        model = find_model(key)
        lines = [*point_lines(model, self, point), *_variant_lines(model, self)]
        return Card(
            heading(model, params, point), lines, [f"{closing(model, self)}."], self.warnings
        )


class Late(AtPoint):
    """Base of results at a point whose fields are filled in when they are first read.

    Most are read for a number or two, and making texts takes longer than a solution.
    """

    __slots__ = ("_fill", "_say")

    @classmethod
    def later(
        cls,
        fill: Callable[[], Mapping[str, Any]],
        say: Callable[[], tuple[str, ...]],
        status: Status,
    ) -> Self:
        """Return a result: ``fill`` gives its fields by name but ``warnings``, ``say`` these."""
        made = object.__new__(cls)
        object.__setattr__(made, "status", status)
        object.__setattr__(made, "_fill", fill)
        object.__setattr__(made, "_say", say)
        return made

    if not TYPE_CHECKING:  # else any name would pass

        def __getattr__(self, name: str) -> Any:
            """Return a field that was not filled in yet, and fill in what is made with it."""
            if name not in type(self).__dataclass_fields__:
                kind = type(self).__name__
                raise AttributeError(f"{kind!r} object has no attribute {name!r}")
            made = {"warnings": self._say()} if name == "warnings" else self._fill()
            for key, value in made.items():
                object.__setattr__(self, key, value)
            return made[name]


class OverTime(Tabled):
    """Base of results over time: fields that are arrays or lists over ``time``."""

    __slots__ = ()
    _model: ClassVar[str]
    _index = "time"
    fidelity: str
    warnings: tuple[str, ...]

    def _axes(self) -> tuple[str, ...]:
        return ("time",)

    def _columns(self) -> dict[str, Any]:
        found = {name: getattr(self, name) for name in public_names(self)}
        return {
            name: plain(column) if isinstance(column, list) else column
            for name, column in found.items()
            if isinstance(column, list) or getattr(column, "ndim", 0) == 1
        }

    def _words(self) -> dict[str, Words]:
        loads = {name: Words(*words) for name, words in LIMITED.items()}
        return {
            **words_of(find_model(self._model).spec),
            **loads,
            "time": Words("s", "points in time"),
        }

    def _card(self) -> Card:
        columns, model = self._columns(), find_model(self._model)
        title = f"{model.spec.name} at {len(columns['time'])} points in time, {self.fidelity}"
        lines = column_lines(without_idle(model.spec, columns), self._words())
        return Card(title, lines, (), self.warnings)


def words_of(spec: ModelSpec) -> dict[str, Words]:
    """Return unit and meaning of a model's parameters, inputs and outputs."""
    metas = {f.name: f.metadata for f in fields(spec.params)}
    found = {n: Words(m["unit"], m["help"], bool(m.get("relative"))) for n, m in metas.items()}
    signals = (*spec.inputs, *spec.outputs)
    return found | {s.name: Words(s.unit, s.help, s.relative) for s in signals}


def words_at_points(model: Model) -> dict[str, Words]:
    """Return unit and meaning of parameters, inputs and results where a model is solved."""
    assert model.command is not None
    found = words_of(model.spec)
    found |= {s.name: Words(s.unit, s.help, s.relative) for s in model.inputs()}
    return found | {name: Words(*words) for name, words in model.command.extra.items()}


def without_idle(spec: ModelSpec, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Return the columns but those of inputs that may be left out and are, all over."""
    start = {s.name: s.start for s in spec.inputs if s.optional}
    return {
        name: column
        for name, column in columns.items()
        if name not in start or any(value != start[name] for value in column)
    }


def scalars(result: object) -> dict[str, Any]:
    """Return what of ``to_dict()`` is no array, no parameters, and nothing else that is large."""
    shown = ((name, getattr(result, name)) for name in public_names(result))
    return {name: plain(value) for name, value in shown if _is_small(value)}


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_small(value: object) -> bool:
    if isinstance(value, tuple | list):
        return all(map(_is_small, value))
    if isinstance(value, Mapping):
        return all(map(_is_small, value.values()))
    is_one = value is None or isinstance(value, bool | str | int | float | Enum)
    return is_one or getattr(value, "ndim", 1) == 0


def heading(model: Model, params: Any, point: Mapping[str, Any]) -> str:
    """Return what was solved and where; inputs that may be left out only where they are given."""
    assert model.command is not None
    values = {f.name: getattr(params, f.name) for f in fields(params)}
    where = ", ".join(
        f"{s.name} {text_of(point[s.name], s.unit)}{_turns(point[s.name], s.unit)}"
        for s in model.inputs()
        if s.name in point and not (s.optional and point[s.name] == s.start)
    )
    return f"{model.command.title.format(**values)} at {where}"


def title_of(model: Model, params: Any) -> str:
    """Return what was solved."""
    assert model.command is not None
    values = {f.name: getattr(params, f.name) for f in fields(params)}
    return model.command.title.format(**values).rstrip(",")


def input_lines(model: Model, there: Point) -> Iterator[Line]:
    """Yield the inputs and where they come from; those that may be left out only where given."""
    for s in model.inputs():
        value = there.values.get(s.name)
        if value is not None and not (s.optional and value == s.start):
            shown = f"{text_of(value, s.unit)}{_turns(value, s.unit)}"
            yield Line(s.name, shown, f"input, {there.origin(s.name)}: {s.help}")


def _turns(value: float, unit: str) -> str:
    """Return a speed in rpm as well; "" for other quantities."""
    return f" ({value * 30.0 / math.pi:.5g} rpm)" if unit == "rad/s" and value else ""


def point_lines(model: Model, result: object, point: Mapping[str, object]) -> Iterator[Line]:
    """Yield all results there are, but inputs and those of variants."""
    command = model.command
    assert command is not None
    known = {s.name: Words(s.unit, s.help, s.relative) for s in model.spec.outputs}
    known |= {name: Words(*words) for name, words in command.extra.items()}
    apart = command.variants.fields() if command.variants else set()
    for name, value in scalars(result).items():
        if name not in known or name in point or name in apart:
            continue
        unit, words, difference = known[name]
        if value is not None:
            yield Line(name, text_of(getattr(result, name), unit, difference), words)
        elif name in command.extra:
            yield Line(name, "not known", words)


def _variant_lines(model: Model, result: object) -> Iterator[Line]:
    """Yield the results of variants, as far as there are any."""
    variants = model.command.variants if model.command else None
    for row in variants.rows if variants else ():
        assert variants is not None
        for column, head in variants.columns.items():
            name = variants.name(column, row)
            if (value := getattr(result, name)) is not None:
                yield Line(name, text_of(value, "1"), f"{head}, {variants.head} {row}")


def closing(model: Model, result: Any) -> str:
    """Return how it was solved, and what is to be known of that."""
    assert model.command is not None
    return f"{status_words(result.status)}; {model.command.closing.format(**scalars(result))}"


def status_words(status: Status) -> str:
    """Return the advice of a sound solution, else the name of what is to be known of it."""
    return status.advice if status is Status.OK else status.name
