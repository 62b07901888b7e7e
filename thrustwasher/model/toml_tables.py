"""TOML files and their tables: read, with quantities in SI units, or an error that says where."""

import tomllib
from collections.abc import Collection, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import ParameterError, suggestion, within
from ..units import has_unit, parse_quantity
from .parameters import allowed, check_number, check_value
from .record import from_plain
from .spec import ModelSpec, Rule


def read_file(what: str, path: str | Path) -> dict[str, Any]:
    """Return the tables of a TOML file; ``what`` it is ("scene") begins the message of an error."""
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as problem:  # bytes that are no text, a path that is none
        reason = getattr(problem, "strerror", None) or "not UTF-8 text"
        raise ParameterError(f"{what} = {str(path)!r}: cannot be read ({reason})") from None
    return parse(f"{what} = {str(path)!r}", text)


def parse(where: str, text: str) -> dict[str, Any]:
    """Return the tables of a TOML text."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as problem:  # also numbers and nesting without end
        raise ParameterError(f"{where}: not valid TOML ({problem})") from None


def table_beside(module: str, name: str) -> dict[str, Any]:
    """Return the TOML table that lies beside a module, which is given by its ``__file__``."""
    return read_file("table", Path(module).with_name(name))


def spec_beside(module: str, params: type[Any], rules: tuple[Rule, ...] = ()) -> ModelSpec:
    """Return what a model shows to the outside, of the ``interface.toml`` beside a module.

    A row of an output is its unit, nominal value if it is a real number, meaning, then the other
    fields of its ``Signal``; it depends on all inputs unless these say otherwise.
    """
    told = table_beside(module, "interface.toml")
    inputs = [{"name": name, **fields} for name, fields in told["inputs"].items()]
    outputs = []
    for name, row in told["outputs"].items():
        *most, more = row if isinstance(row[-1], dict) else [*row, {}]
        unit, *nominal, text = most
        usual = {"nominal": nominal[0]} if nominal else {}
        signal = {"name": name, "unit": unit, "help": text, "depends": [*told["inputs"]]}
        outputs.append(signal | usual | more)
    told |= {"inputs": inputs, "outputs": outputs, "params": params}
    spec: ModelSpec = from_plain(ModelSpec, told)
    return replace(spec, rules=rules)


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


def quantity(where: str, key: str, value: Any, unit: str) -> float:
    """Return a number in SI units."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ParameterError(f"{where}: {key} = {value!r}, a number in {unit} is wanted")
    with within(where):
        return parse_quantity(value, unit, key)


def number(where: str, key: str, value: Any, rule: tuple[str, float, float]) -> float:
    """Return a number in SI units within its range; ``rule``: unit, least, largest."""
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
                check_value(key, found, meta, stated=True)
        return found
    wanted = {"integer": int, "boolean": bool, "enumeration": str}[meta["kind"]]
    if not isinstance(value, wanted) or (wanted is int and isinstance(value, bool)):
        raise ParameterError(f"{where}: {key} = {value!r}, allowed: {allowed(meta)}")
    return value
