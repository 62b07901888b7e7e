"""One field, one source: the metadata feeds checks, FMU variables, command line and docs.

Numbers and their courses over time that come with a call are checked here too.
"""

import math
from dataclasses import field, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError

Array = NDArray[np.float64]


def quantity(default: float, unit: str, low: float, high: float, text: str, **extra: Any) -> Any:
    """Return a real-valued field; ``low`` and ``high`` belong to the allowed range."""
    meta = {"kind": "real", "unit": unit, "min": low, "max": high, "help": text, **extra}
    return field(default=default, metadata=meta)


def count(default: int, low: int, high: int, text: str) -> Any:
    """Return an integer field; both bounds are allowed."""
    meta = {"kind": "integer", "unit": "1", "min": low, "max": high, "help": text}
    return field(default=default, metadata=meta)


def flag(default: bool, text: str) -> Any:
    """Return a Boolean field."""
    meta = {"kind": "boolean", "unit": "1", "min": 0, "max": 1, "help": text}
    return field(default=default, metadata=meta)


def choice(default: str, options: dict[str, str], type_name: str, text: str) -> Any:
    """Return an enumeration field; ``options`` maps each name to one sentence."""
    meta = {
        "kind": "enumeration", "unit": "1", "min": 1, "max": len(options), "help": text,
        "options": dict(options), "type": type_name,
    }  # fmt: skip
    return field(default=default, metadata=meta)


def allowed(meta: Any) -> str:
    """Say the allowed range of a field in words."""
    if meta["kind"] == "enumeration":
        return " or ".join(repr(name) for name in meta["options"])
    if meta["kind"] == "boolean":
        return "True or False"
    unit = "" if meta["unit"] == "1" else f" {meta['unit']}"
    whole = ", a whole number" if meta["kind"] == "integer" else ""
    return f"{meta['min']:g} .. {meta['max']:g}{unit}{whole}"


def check_ranges(params: Any) -> None:
    """Raise ParameterError for the first field out of range; the message names it."""
    for f in fields(params):
        value, m = getattr(params, f.name), f.metadata
        if m["kind"] == "enumeration":
            good = isinstance(value, str) and value in m["options"]
        elif m["kind"] == "boolean":
            good = isinstance(value, bool) or value in (0, 1)
        else:
            is_number = isinstance(value, int | float) and not isinstance(value, bool)
            good = is_number and m["min"] <= value <= m["max"]  # False for NaN too
            if m["kind"] == "integer":
                good = good and value == int(value)
        if not good:
            unit = "" if m["unit"] == "1" else f" {m['unit']}"
            raise ParameterError(f"{f.name} = {value!r}{unit}, allowed: {allowed(m)}")


def check_number(name: str, value: float, unit: str, low: float, high: float) -> float:
    """Return ``value`` as a float, or raise ParameterError naming it, its unit and its range."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ParameterError(f"{name} = {value!r}, a number in {unit} is wanted") from None
    except OverflowError:
        number = math.inf
    if not low <= number <= high:
        raise ParameterError(f"{name} = {number!r} {unit}, allowed: {low:g} .. {high:g} {unit}")
    return number


def as_numbers(params: Any) -> list[float]:
    """Return the fields as floats in declared order; an enumeration counts from 1."""
    numbers = []
    for f in fields(params):
        value = getattr(params, f.name)
        if f.metadata["kind"] == "enumeration":
            value = list(f.metadata["options"]).index(value) + 1
        numbers.append(float(value))
    return numbers


def rising(time: ArrayLike) -> Array:
    """Return points in time [s]; at least two, rising."""
    points = course_of("time", time, "s", -1e9, 1e9)
    if len(points) < 2 or not (np.diff(points) > 0.0).all():
        raise ParameterError("time: at least two rising points [s] are wanted")
    return points


def course_of(
    name: str, values: ArrayLike, unit: str, low: float, high: float, n: int | None = None
) -> Array:
    """Return a checked array; one number stands for ``n`` equal ones."""
    array = np.asarray(values, float)
    if n is not None and array.ndim == 0:
        array = np.full(n, float(array))
    if array.ndim != 1 or (n is not None and len(array) != n):
        raise ParameterError(
            f"{name}: shape {array.shape}, allowed: one number per point"
            + ("" if n is None else f" ({n})")
        )
    bad = ~((array >= low) & (array <= high))
    if bad.any():
        i = int(np.argmax(bad))
        raise ParameterError(
            f"{name}[{i}] = {float(array[i])!r} {unit}, allowed: {low:g} .. {high:g} {unit}"
        )
    return array
