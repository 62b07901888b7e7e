"""Small dense linear systems: Gaussian elimination with row exchange, in place."""

import math

import numpy as np

from .jit import Array, kernel


@kernel
def dense_solve(a: Array, b: Array, n: int) -> bool:
    """Solve ``a x = b`` in place; return False if a pivot is zero or not finite.

    Parameters
    ----------
    a : (n * n,) row by row, overwritten
    b : (n,) right side in, solution out
    """
    for j in range(n):
        best = j
        for i in range(j + 1, n):
            if abs(a[i * n + j]) > abs(a[best * n + j]):
                best = i
        pivot = a[best * n + j]
        if not (math.isfinite(pivot) and pivot != 0.0):
            return False
        if best != j:
            for k in range(j, n):
                a[j * n + k], a[best * n + k] = a[best * n + k], a[j * n + k]
            b[j], b[best] = b[best], b[j]
        for i in range(j + 1, n):
            f = a[i * n + j] / pivot
            for k in range(j + 1, n):
                a[i * n + k] -= f * a[j * n + k]
            b[i] -= f * b[j]
    for j in range(n - 1, -1, -1):
        x = b[j]
        for i in range(j + 1, n):
            x -= a[j * n + i] * b[i]
        b[j] = x / a[j * n + j]
    return True


@kernel
def dense_factor(a: Array, n: int) -> bool:
    """Replace a matrix by its LU factors, no row exchange; return False at a zero pivot.

    ``a`` (n * (n + 1),): the matrix row by row, then room for the reciprocal pivots.
    """
    for j in range(n):
        pivot = a[j * n + j]
        if not (math.isfinite(pivot) and pivot != 0.0):
            return False
        a[n * n + j] = 1.0 / pivot
        for i in range(j + 1, n):
            f = a[i * n + j] / pivot
            a[i * n + j] = f
            if f != 0.0:
                for k in range(j + 1, n):
                    a[np.uintp(i * n + k)] -= f * a[np.uintp(j * n + k)]
    return True


@kernel
def dense_substitute(a: Array, b: Array, n: int) -> None:
    """Replace the right side ``b`` (n,) by the solution, given the factors of `dense_factor`."""
    for i in range(n):
        s = b[i]
        for k in range(i):
            s -= a[np.uintp(i * n + k)] * b[np.uintp(k)]
        b[i] = s
    for i in range(n - 1, -1, -1):
        s = b[i]
        for k in range(i + 1, n):
            s -= a[np.uintp(i * n + k)] * b[np.uintp(k)]
        b[i] = s * a[n * n + i]
