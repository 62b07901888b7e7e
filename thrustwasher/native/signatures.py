"""What a kernel takes and returns, read off its annotations.

An argument is a number, one of the kinds of array that are named here, or a tuple of these. Arrays
are known by these names alone: what an annotation of another package is made of is nobody else's
business and changes with its releases.
"""

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from .entries import called, symbol_of

Array = NDArray[np.float64]
Ints = NDArray[np.int32]
Longs = NDArray[np.int64]
Bytes = NDArray[np.uint8]
ITEMS: dict[object, str] = {Array: "float64", Ints: "int32", Longs: "int64", Bytes: "uint8"}
NUMBERS = {float: "float", int: "int", bool: "bool"}


@dataclass(frozen=True, slots=True)
class Kind:
    """What an argument is to a C function.

    ``name``: "float", "int", "bool" or "array"; an array's ``item`` is the name of its numpy type,
    ``ndim`` its dimensions. ``parts``: of a tuple, whose class is ``made_by`` (None: a plain one).
    """

    name: str
    item: str = ""
    ndim: int = 0
    parts: tuple["Kind", ...] = ()
    made_by: Any = None


@dataclass(frozen=True, slots=True)
class Entry:
    """A function, its symbol in a library, what it takes and returns."""

    symbol: str
    function: Callable[..., Any]
    takes: tuple[Kind, ...]
    returns: tuple[Kind, ...]
    is_tuple: bool  # what it returns is a tuple, also of one


def entries(library: str) -> list[Entry]:
    """Return the functions of a library that Python calls; imports all their modules."""
    return [
        describe(getattr(importlib.import_module(module), name), two)
        for module, name, two in called(library)
    ]


def describe(function: Any, two: Sequence[str]) -> Entry:
    """Return what a function takes and returns; ``two``: its arrays of two dimensions.

    Raises
    ------
    ParameterError : an annotation is none of those that a compiled function has
    """
    plain = getattr(function, "py_func", function)
    module, name = plain.__module__, plain.__name__
    place = f"{module}.{name}"
    hints = get_type_hints(plain)
    back = hints.pop("return")
    takes = tuple(
        _kind(hint, 2 if arg in two else 1, f"{place}: {arg}") for arg, hint in hints.items()
    )
    is_tuple = get_origin(back) is tuple
    given = get_args(back) if is_tuple else (() if back is type(None) else (back,))
    returns = tuple(_kind(b, 1, f"{place}: return") for b in given)
    return Entry(symbol_of(module, name), function, takes, returns, is_tuple)


def _kind(hint: Any, ndim: int, place: str) -> Kind:
    """Return the kind of an annotation; ``place`` names it where it is none that is known."""
    if hint in NUMBERS:
        return Kind(NUMBERS[hint])
    if hint in ITEMS:
        return Kind("array", item=ITEMS[hint], ndim=ndim)
    if get_origin(hint) is tuple:
        return Kind("tuple", parts=tuple(_kind(part, 1, place) for part in get_args(hint)))
    if isinstance(hint, type) and issubclass(hint, tuple):
        parts = tuple(_kind(part, 1, place) for part in get_type_hints(hint).values())
        return Kind("tuple", parts=parts, made_by=hint)
    raise ParameterError(
        f"{place} is annotated {hint}; a compiled function has float, int, bool, "
        "Array (float64), Ints (int32), Longs (int64), Bytes (uint8), and tuples of these"
    )
