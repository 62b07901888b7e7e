"""A dataclass made of another one by a call, at home in the same module."""

from collections.abc import Sequence
from dataclasses import make_dataclass
from typing import Any, TypeVar

T = TypeVar("T")


def derived(base: type[T], name: str, fields: Sequence[tuple[str, Any, Any]]) -> type[T]:
    """Return a frozen dataclass of this name: the base's fields, then (name, type, field).

    It belongs to the base's module, where digests look for its source and pickle for its name.
    ``make_dataclass`` alone writes its caller's module from Python 3.12 on, whatever is given.
    """
    made = make_dataclass(
        name, fields, bases=(base,), frozen=True, kw_only=True, namespace={"__doc__": base.__doc__}
    )
    made.__module__ = base.__module__
    return made
