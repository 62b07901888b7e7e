"""Checked courses of inputs over time."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError

Array = NDArray[np.float64]


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
