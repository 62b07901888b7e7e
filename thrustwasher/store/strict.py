"""JSON to frozen dataclasses, strictly: every key wanted, no other taken, types as declared."""

from __future__ import annotations

import types
from dataclasses import fields
from functools import cache
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from ..errors import ParameterError

T = TypeVar("T")
LARGEST = 1e300
SCALARS = (float, int, str, bool)


@cache
def _hints(cls: Any) -> dict[str, Any]:
    return get_type_hints(cls)


@cache
def _parts(kind: Any) -> tuple[Any, tuple[Any, ...]]:
    return get_origin(kind), get_args(kind)


def build(cls: type[T], raw: Any, where: str) -> T:
    """Return ``cls`` filled from a JSON object.

    Parameters
    ----------
    cls : a dataclass of numbers, text, tuples, dictionaries and other such dataclasses
    raw : what ``json.loads`` gave
    where : file and key, to begin the message with

    Raises
    ------
    ParameterError : a key is missing, unknown or of another type; file and key are named
    """
    if not isinstance(raw, dict):
        raise ParameterError(f"{where}: an object is wanted, got {_shown(raw)}")
    names = [f.name for f in fields(cls)]  # type: ignore[arg-type]
    for key in raw:
        if key not in names:
            raise ParameterError(f"{where}: key {key!r} is not known; allowed: {', '.join(names)}")
    for name in names:
        if name not in raw:
            raise ParameterError(f"{where}: key {name!r} is missing")
    hints = _hints(cls)  # type: ignore[arg-type]
    return cls(**{n: _value(hints[n], raw[n], f"{where}: {n}") for n in names})


def _value(kind: Any, raw: Any, where: str) -> Any:
    """Return ``raw`` as the annotation ``kind`` says."""
    if kind in SCALARS:
        return _scalar(kind, raw, where)
    origin, inner = _parts(kind)
    if kind is Any:
        return raw
    if origin in (Union, types.UnionType):
        return _either(inner, raw, where)
    if origin is tuple:
        if not isinstance(raw, list):
            raise ParameterError(f"{where}: a list is wanted, got {_shown(raw)}")
        return tuple(_value(inner[0], item, f"{where}[{k}]") for k, item in enumerate(raw))
    if origin is dict:
        if not isinstance(raw, dict):
            raise ParameterError(f"{where}: an object is wanted, got {_shown(raw)}")
        return {k: _value(inner[1], item, f"{where}: {k}") for k, item in raw.items()}
    return build(kind, raw, where)


def _either(kinds: tuple[Any, ...], raw: Any, where: str) -> Any:
    """Return None where it is allowed, else the one other kind."""
    if raw is None and type(None) in kinds:
        return None
    return _value(next(k for k in kinds if k is not type(None)), raw, where)


def _scalar(kind: Any, raw: Any, where: str) -> Any:
    """Return text, Boolean or number; a whole number passes as a float, a Boolean does not."""
    if kind is float and isinstance(raw, int | float) and not isinstance(raw, bool):
        if abs(raw) <= LARGEST:  # 1e999 is infinite to JSON, and whole numbers have no end
            return float(raw)
        raise ParameterError(f"{where}: a number up to {LARGEST:g} is wanted, got {_shown(raw)}")
    if kind is not float and isinstance(raw, kind) and (kind is bool or not isinstance(raw, bool)):
        return raw
    wanted = {str: "text", bool: "true or false", int: "a whole number", float: "a number"}
    raise ParameterError(f"{where}: {wanted[kind]} is wanted, got {_shown(raw)}")


def _shown(raw: Any) -> str:
    text = repr(raw)
    return text if len(text) <= 40 else text[:37] + "..."
