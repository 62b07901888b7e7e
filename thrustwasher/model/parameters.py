"""One field, one source: the metadata feeds checks, FMU variables, command line and docs.

Numbers that come with a call are checked here too.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field, fields
from functools import cache, wraps
from operator import attrgetter, contains, le
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from ..errors import ParameterError, UnknownParameter, suggestion
from ..units import into_range, meant
from .spec import ModelSpec, Rule, derived
from .unread import condition_words

T = TypeVar("T")
Renew = Callable[[dict[str, Any]], dict[str, Any]]
NOTHING: Mapping[str, str] = MappingProxyType({})
_NUMBERS = {float, int}
_TYPES = {"integer": int, "boolean": bool, "enumeration": str}
EARLIER: dict[type[Any], tuple[dict[str, Any], Renew, Callable[[Any], dict[str, float]]]] = {}


def quantity(default: float, unit: str, low: float, high: float, text: str, **extra: object) -> Any:
    """Return a real-valued field; ``low`` and ``high`` belong to the allowed range.

    ``tunable=True``: an FMU's host may change it between two steps. ``overrides``, ``belongs_to``:
    see ``model.idle``; ``read_by``, ``read_with``, ``only_for``: ``model.unread``; ``decides``:
    ``held_choices``. ``at_zero``: what counts where the value is 0, the name of a parameter or
    input, or a function of all parameters; else the one parameter it ``overrides``. ``instant``: a
    time that counts from the run's start.
    """
    meta = {"kind": "real", "unit": unit, "min": low, "max": high}
    return field(default=default, metadata=_described(meta, text, extra))


def count(default: int, low: int, high: int, text: str, **extra: object) -> Any:
    """Return an integer field; both bounds are allowed."""
    meta = {"kind": "integer", "unit": "1", "min": low, "max": high}
    return field(default=default, metadata=_described(meta, text, extra))


def flag(default: bool, text: str, **extra: object) -> Any:
    """Return a Boolean field."""
    meta = {"kind": "boolean", "unit": "1", "min": 0, "max": 1}
    return field(default=default, metadata=_described(meta, text, extra))


def choice(
    default: str, options: dict[str, str], type_name: str, text: str, **extra: object
) -> Any:
    """Return an enumeration field; ``options`` maps each name to one sentence."""
    meta = {
        "kind": "enumeration",
        "unit": "1",
        "min": 1,
        "max": len(options),
        "options": dict(options),
        "type": type_name,
    }
    return field(default=default, metadata=_described(meta, text, extra))


def _described(
    meta: dict[str, object], text: str, extra: Mapping[str, object]
) -> dict[str, object]:
    """Return all metadata of a field; its help names the condition under which it is read."""
    return {**meta, **extra, "help": text + condition_words(extra)}


def read_with(conditions: tuple[Any, ...], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return fields that are read only where these conditions hold, see ``model.unread``."""
    found = {}
    for name, f in given.items():
        text = f.metadata["help"].removesuffix(condition_words(f.metadata))
        more = {**f.metadata, "read_with": (*f.metadata.get("read_with", ()), *conditions)}
        found[name] = field(default=f.default, metadata=_described({}, text, more))
    return found


def allowed(meta: Any) -> str:
    """Say the allowed range of a field in words."""
    if meta["kind"] == "enumeration":
        return " or ".join(repr(name) for name in meta["options"])
    if meta["kind"] == "boolean":
        return "true or false"
    unit = "" if meta["unit"] == "1" else f" {meta['unit']}"
    whole = ", a whole number" if meta["kind"] == "integer" else ""
    return f"{meta['min']:g} .. {meta['max']:g}{unit}{whole}"


def extended(params: type[T], name: str, more: Mapping[str, object]) -> type[T]:
    """Return a parameter dataclass of this name with more fields, behind its own."""
    return derived(params, name, [(n, float, f) for n, f in more.items()])


def naming_unknown(params: type[T]) -> type[T]:
    """Let a wrong name of a field raise UnknownParameter with the nearest one."""
    plain = params.__init__

    @wraps(plain)
    def init(self: object, *args: object, **given: object) -> None:
        try:
            plain(self, *args, **given)
        except TypeError:
            known = [f.name for f in fields(params)]  # type: ignore[arg-type]
            known += [*other_names_of(params), *earlier_of(params)]
            for name in given:
                if name not in known:
                    hint = suggestion(name, known, "; did you mean {}?")
                    text = f"{params.__name__} has no parameter {name!r}{hint}"
                    raise UnknownParameter(text) from None
            raise

    params.__init__ = init  # type: ignore[method-assign]
    return params


def other_names(params: type[T]) -> type[T]:
    """Let fields be given and read by another name in their metadata as well.

    ``also``: a name that means the same.
    """
    others, plain = other_names_of(params), params.__init__

    @wraps(plain)
    def init(self: object, **given: object) -> None:
        plain(self, **plainly_named(others, given))

    params.__init__ = init  # type: ignore[method-assign]
    for other, name in others.items():
        setattr(params, other, property(attrgetter(name)))
    return params


def renewed(
    old: Mapping[str, tuple[str, float, float, str]],
    renew: Renew,
    former: Callable[[Any], dict[str, float]],
) -> Callable[[type[T]], type[T]]:
    """Let parameters of an earlier form be given and read: unit and range of each by its name.

    ``renew`` makes fields of them and of all that is given in addition to them, ``former`` them of
    all fields.
    """

    def decorate(params: type[T]) -> type[T]:
        plain = params.__init__

        @wraps(plain)
        def init(self: object, **given: object) -> None:
            plain(self, **renew(given))

        params.__init__ = init  # type: ignore[method-assign]
        meta = {
            name: {"kind": "real", "unit": unit, "min": low, "max": high, "help": text}
            for name, (unit, low, high, text) in old.items()
        }
        EARLIER[params] = meta, renew, former
        return params

    return decorate


def earlier_of(params: type[Any]) -> dict[str, Any]:
    """Return the metadata of parameters of an earlier form by name."""
    return next((dict(EARLIER[c][0]) for c in params.__mro__ if c in EARLIER), {})


def renewed_values(params: type[Any], given: dict[str, Any]) -> dict[str, Any]:
    """Return values [SI] by name with none of an earlier form."""
    return next((EARLIER[c][1](given) for c in params.__mro__ if c in EARLIER), given)


def former_values(params: object) -> dict[str, float]:
    """Return parameters of an earlier form that are those of now."""
    return next((EARLIER[c][2](params) for c in type(params).__mro__ if c in EARLIER), {})


def written_out(params: T, fitted: Iterable[str] = ()) -> T:
    """Return the same parameters with what a choice ``auto`` lets act written out.

    ``fitted``: names of parameters that are to act too.
    """
    own = getattr(params, "decided", None)
    return own(fitted) if own else params


def held_choices(params: Any, changed: Iterable[str]) -> dict[str, Any]:
    """Return choices ``auto`` written out that the changed parameters would make anew.

    Over derivatives, draws and fits they are to hold as they are before the change. Metadata
    ``decides`` of a parameter: such a choice.
    """
    names, known = set(changed), type(params).__dataclass_fields__
    made = {known[n].metadata.get("decides", "") for n in names if n in known} - names - {""}
    new = {n: getattr(written_out(params), n) for n in made}
    return {n: value for n, value in new.items() if value != getattr(params, n)}


def with_changes(params: object, given: Mapping[str, object], changes: Mapping[str, object]) -> Any:
    """Return parameters with changes, those of an earlier form too.

    ``given`` are the values that ``params`` were made of, none of an earlier form.
    """
    former = former_values(params)
    if former.keys() & changes.keys():
        replaced = renewed_values(type(params), former).keys()
        given = {**{n: v for n, v in given.items() if n not in replaced}, **former}
    return type(params)(**{**given, **changes})


def other_names_of(params: type[Any]) -> dict[str, str]:
    """Return the other names of fields: other name -> name."""
    return {f.metadata["also"]: f.name for f in fields(params) if "also" in f.metadata}


def plainly_named(others: Mapping[str, str], given: Mapping[str, object]) -> dict[str, Any]:
    """Return values by the fields' own names; ParameterError if one comes by both of its names."""
    if others.keys().isdisjoint(given):
        return dict(given)
    for other, name in others.items():
        if other in given and name in given:
            raise ParameterError(f"{other}: another name of {name}, allowed: one of the two")
    return {others.get(key, key): value for key, value in given.items()}


def params_of(spec: ModelSpec, given: object) -> Any:
    """Return the parameters given, for None the model's defaults; refuse another model's."""
    params = spec.params() if given is None else given
    if not isinstance(params, spec.params):
        raise ParameterError(f"params: {type(params).__name__}, allowed: {spec.params.__name__}")
    return params


def check_ranges(params: Any) -> None:
    """Raise ParameterError for the first field out of range; the message names it.

    What only rounding put outside becomes the end of its range, in a frozen dataclass too.
    """
    if _is_in_range(params):
        return
    for f in fields(params):
        value = getattr(params, f.name)
        taken = check_value(f.name, value, f.metadata)
        if taken is not value:
            object.__setattr__(params, f.name, taken)


class _Ranges(NamedTuple):
    """The ranges of a dataclass's fields, so that all of them are looked at together."""

    reals: Callable[[Any], tuple[Any, ...]]
    low: tuple[float, ...]
    high: tuple[float, ...]
    others: Callable[[Any], tuple[Any, ...]]
    types: tuple[type, ...]
    allowed: tuple[Any, ...]


def _is_in_range(params: Any) -> bool:
    """Tell if all fields have the usual types and lie in their ranges; False: look closer."""
    known = _ranges(params.__class__)
    reals, others = known.reals(params), known.others(params)
    return (
        _NUMBERS.issuperset(map(type, reals))
        and tuple(map(type, others)) == known.types
        and all(map(le, known.low, reals))
        and all(map(le, reals, known.high))
        and all(map(contains, known.allowed, others))
    )


@cache
def _ranges(kind: Any) -> _Ranges:
    """Return the ranges of all fields."""
    metas = {f.name: f.metadata for f in fields(kind)}
    real = {n: m for n, m in metas.items() if m["kind"] == "real"}
    whole = {n: m for n, m in metas.items() if n not in real}
    return _Ranges(
        _getter(real),
        tuple(m["min"] for m in real.values()),
        tuple(m["max"] for m in real.values()),
        _getter(whole),
        tuple(_TYPES[m["kind"]] for m in whole.values()),
        tuple(m.get("options") or range(m["min"], m["max"] + 1) for m in whole.values()),
    )


def _getter(names: Iterable[str]) -> Callable[[Any], tuple[Any, ...]]:
    """Return what gives these attributes of an object, as a tuple whatever their number."""
    get: Any = attrgetter(*names, "__class__", "__class__")
    return lambda params: get(params)[:-2]


def check_value(name: str, value: Any, m: Mapping[str, Any], *, stated: bool = False) -> Any:
    """Return a value that a field's metadata allow, else raise ParameterError.

    A real number that only rounding put outside comes back as the end of its range. ``stated``: it
    came with its unit, so that no other one was meant.
    """
    if m["kind"] == "enumeration":
        good = isinstance(value, str) and value in m["options"]
    elif m["kind"] == "boolean":
        good = isinstance(value, bool) or value in (0, 1)
    else:
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if is_number and m["kind"] == "real":
            value = into_range(m["min"], m["max"], value)
        good = is_number and m["min"] <= value <= m["max"]  # False for NaN too
        if m["kind"] == "integer":
            good = good and value == int(value)
    if not good:
        unit = "" if m["unit"] == "1" else f" {m['unit']}"
        hint = ""
        if m["kind"] == "real" and isinstance(value, int | float) and not stated:
            hint = meant(
                float(value), m["unit"], m["min"], m["max"], difference=bool(m.get("relative"))
            )
        raise ParameterError(f"{name} = {value!r}{unit}, allowed: {allowed(m)}{hint}")
    return value


def check_number(
    name: str, value: float, unit: str, low: float, high: float, *, stated: bool = False
) -> float:
    """Return ``value`` as a float, or raise ParameterError naming it, its unit and its range.

    One that only rounding put outside comes back as the end of the range.
    ``stated``: it came with its unit, so that no other one was meant.
    """
    if type(value) is float and low <= value <= high:
        return value
    try:
        if isinstance(value, bool | str):
            raise TypeError
        number = into_range(low, high, float(value))
    except (TypeError, ValueError):
        raise ParameterError(f"{name} = {value!r}, a number in {unit} is required") from None
    except OverflowError:
        number = math.inf
    if not low <= number <= high:
        hint = "" if stated else meant(number, unit, low, high)
        unit = "" if unit == "1" else f" {unit}"
        raise ParameterError(f"{name} = {number!r}{unit}, allowed: {low:g} .. {high:g}{unit}{hint}")
    return number


def as_numbers(params: Any, instead: Mapping[str, str] = NOTHING) -> list[float]:
    """Return the fields as floats in declared order; an enumeration counts from 1.

    ``instead``: options of enumerations by name that count in place of the parameters' own.
    """
    get, choices = _codes(params.__class__)
    values = list(get(params))
    for place, name, codes in choices:
        values[place] = codes[instead.get(name, values[place])]
    return list(map(float, values))


@cache
def _codes(kind: Any) -> tuple[Callable[[Any], Any], list[tuple[int, str, dict[str, int]]]]:
    """Return what gives all fields; place, name and numbers of the options of enumerations."""
    every = [(f.name, f.metadata.get("options", ())) for f in fields(kind)]
    numbered = [
        (place, name, {option: i for i, option in enumerate(own, 1)})
        for place, (name, own) in enumerate(every)
        if own
    ]
    return _getter(name for name, _ in every), numbered


def check_rules(
    params: object, rules: tuple[Rule, ...], broken_rule: Callable[[Any], int], *more: float
) -> None:
    """Raise ParameterError for the first broken rule; every value must be in its range already."""
    import numpy as np  # late: --help needs none

    if number := broken_rule(np.array([*as_numbers(params), *more], float)):
        raise ParameterError(rules[number - 1].message(params))
