"""Whole arrays: copied, cleared, added up, compared."""

import math

import numpy as np

from .jit import Array, kernel


@kernel
def copy(fro: Array, to: Array) -> None:
    """Fill an array from the beginning of another one."""
    for k in range(to.size):
        to[np.uintp(k)] = fro[np.uintp(k)]


@kernel
def clear(a: Array) -> None:
    """Fill an array with 0."""
    for k in range(a.size):
        a[np.uintp(k)] = 0.0


@kernel
def negate(a: Array) -> None:
    """Turn the signs of all numbers."""
    for k in range(a.size):
        a[np.uintp(k)] = -a[np.uintp(k)]


@kernel
def size_of(a: Array) -> float:
    """Return the sum of the sizes of all numbers."""
    total = 0.0
    for k in range(a.size):
        total += abs(a[np.uintp(k)])
    return total


@kernel
def are_equal(one: Array, two: Array) -> bool:
    """Tell if all numbers of two arrays are the same."""
    for k in range(one.size):
        if one[np.uintp(k)] != two[np.uintp(k)]:
            return False
    return True


@kernel
def are_finite(a: Array) -> bool:
    """Tell if all numbers are finite."""
    good = True
    for k in range(a.size):
        good = good and math.isfinite(a[np.uintp(k)])
    return good
