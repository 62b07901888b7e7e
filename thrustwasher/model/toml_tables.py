"""TOML files and their tables: read, with quantities in SI units, or an error that says where."""

import json
import re
import tomllib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import is_dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints

from ..errors import ParameterError, refuse_pipe, suggestion, within
from ..units import has_unit, parse_quantity
from .parameters import allowed, check_number, check_value, naming_unknown
from .spec import ModelSpec, Rule

# What XML 1.0 has no place for, as it is and as TOML's texts may spell it.
NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
ESCAPED = re.compile(
    r"\\\\|(\\(?:[bfe]|(?:x|u00|U000000)(?:0[0-8bcef]|1[\da-f])|(?:u|U0000)fff[ef]))",
    re.IGNORECASE,
)


def read_file(what: str, path: str | Path) -> dict[str, Any]:
    """Return the tables of a TOML file; ``what`` it is ("scene") begins the message of an error."""
    try:
        refuse_pipe(path)
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as problem:  # bytes that are no text, a path that is none
        reason = getattr(problem, "strerror", None) or "not UTF-8 text"
        raise ParameterError(f"{what} = {str(path)!r}: cannot be read ({reason})") from None
    return parse(f"{what} = {str(path)!r}", text)


def parse(where: str, text: str) -> dict[str, Any]:
    """Return the tables of a TOML text; characters that no XML file may hold are refused."""
    try:
        table = tomllib.loads(text)
        if strange := _strange(table):
            raise ParameterError(
                f"{where}: line {_line_of_strange(text, len(strange))}: character "
                f"U+{ord(strange[0]):04X} in a text, allowed: those of XML, which FMUs are made "
                "of (no control characters but tab and line end)"
            )
        return table
    except ParameterError:
        raise
    except (ValueError, RecursionError) as problem:  # also numbers and nesting without end
        raise ParameterError(f"{where}: not valid TOML ({problem})") from None


def _strange(value: object) -> str:
    """Return all characters in keys and texts that XML 1.0 does not know."""
    if isinstance(value, dict):
        return "".join(_strange(k) + _strange(x) for k, x in value.items())
    if isinstance(value, list):
        return "".join(map(_strange, value))
    return "".join(NO_XML.findall(value)) if isinstance(value, str) else ""


def _line_of_strange(text: str, n: int) -> int:
    """Return the first line without whose escapes fewer than ``n`` strange characters are left."""
    lines = text.split("\n")
    for i, line in enumerate(lines):
        plain = NO_XML.sub(" ", ESCAPED.sub(lambda found: " " if found[1] else found[0], line))
        changed = "\n".join([*lines[:i], plain, *lines[i + 1 :]])
        if plain != line and len(_strange(tomllib.loads(changed))) < n:
            return i + 1
    return len(lines)


def table_beside(module: str, name: str) -> dict[str, Any]:
    """Return the TOML table that lies next to a module, which is given by its ``__file__``."""
    return read_file("table", Path(module).with_name(name))


@cache
def _anatomy(kind: object) -> tuple[Any, tuple[Any, ...], dict[str, Any]]:
    """Return the parts of an annotation: its origin, arguments, and fields if a dataclass."""
    fields = get_type_hints(kind) if is_dataclass(kind) else {}
    return get_origin(kind), get_args(kind), fields


def from_plain(kind: Any, raw: Any) -> Any:
    """Return what was read from JSON or TOML as the annotation ``kind`` says, lists as tuples.

    KeyError, TypeError or AttributeError if it has other keys or another shape.
    """
    origin, inner, fields = _anatomy(kind)
    if fields:
        return kind(**{k: from_plain(fields[k], v) for k, v in raw.items()})
    if origin is tuple:
        return tuple(from_plain(inner[0], item) for item in raw)
    if origin in (dict, Mapping):
        return {k: from_plain(inner[1], item) for k, item in raw.items()}
    if inner:  # one kind or None
        return None if raw is None else from_plain(inner[0], raw)
    return raw


def spec_beside(
    module: str, params: type[Any], rules: tuple[Rule, ...] = (), **more: Any
) -> ModelSpec:
    """Return what a model shows to the outside, of the ``interface.toml`` next to a module.

    A row of an input is its unit, minimum, maximum, nominal and start value, meaning; one of an
    output its unit, nominal value if it is a real number, meaning. Other fields of its ``Signal``
    may follow; an output depends on all inputs unless these say otherwise. ``more`` are fields of
    the ``ModelSpec`` that are no data.
    """
    path = Path(module).with_name("interface.toml")
    table = table_beside(module, path.name)
    numbers = {"inputs": ("low", "high", "nominal", "start"), "outputs": ("nominal",)}
    signals: dict[str, Any] = {"inputs": [], "outputs": []}
    for kind, names in numbers.items():
        for name, row in table[kind].items():
            *most, rest = row if isinstance(row[-1], dict) else [*row, {}]
            unit, *values, text = most
            signal = {
                "name": name,
                "unit": unit,
                "help": text,
                **dict(zip(names, values, strict=False)),
            }
            if kind == "outputs":
                signal["depends"] = [*table["inputs"]]
            signals[kind].append(signal | rest)
    own = {"params": naming_unknown(params)}
    spec: ModelSpec = from_plain(ModelSpec, table | signals | own)
    return replace(spec, rules=rules, **more)


def key_text(key: str) -> str:
    """Return a key as TOML has it."""
    bare = key.replace("_", "").replace("-", "")
    return key if bare.isascii() and bare.isalnum() else json.dumps(key)


def value_text(value: object) -> str:
    """Return a value as TOML has it on one line: a text, number, Boolean, list or table of them."""
    if isinstance(value, Mapping):
        parts = (f"{key_text(k)} = {value_text(v)}" for k, v in value.items())
        return f"{{ {', '.join(parts)} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(value_text, value))}]"
    return json.dumps(value, ensure_ascii=False)


def unknown(where: str, key: str, known: Iterable[str]) -> ParameterError:
    """Return the error of a key that is not known."""
    known = list(known)
    hint = suggestion(key, known, "; did you mean {!r}?", f", allowed: {', '.join(known)}")
    return ParameterError(f"{where}: there is no {key!r} here{hint}")


def nothing_else(where: str, keys: Iterable[str], known: Collection[str]) -> None:
    """Refuse keys that are not known."""
    for key in keys:
        if key not in known:
            raise unknown(where, key, known)


def quantity(where: str, key: str, value: object, unit: str) -> float:
    """Return a number in SI units."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ParameterError(f"{where}: {key} = {value!r}, a number in {unit} is required")
    with within(where):
        return parse_quantity(value, unit, key)


def number(where: str, key: str, value: object, rule: tuple[str, float, float]) -> float:
    """Return a number in SI units within its range; ``rule``: unit, minimum, maximum."""
    unit, low, high = rule
    found = quantity(where, key, value, unit)
    with within(where):
        return check_number(key, found, unit, low, high, stated=has_unit(value))


def read_value(where: str, key: str, value: Any, meta: Any) -> Any:
    """Return the value of a parameter, of the kind that its metadata say."""
    if meta["kind"] == "real":
        found = quantity(where, key, value, meta["unit"])
        if has_unit(value):
            with within(where):
                found = check_value(key, found, meta, stated=True)
        return found
    required = {"integer": int, "boolean": bool, "enumeration": str}[meta["kind"]]
    if not isinstance(value, required) or (required is int and isinstance(value, bool)):
        raise ParameterError(f"{where}: {key} = {value!r}, allowed: {allowed(meta)}")
    return value
