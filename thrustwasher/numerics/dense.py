"""Small dense linear systems: Gaussian elimination with row exchange, in place."""

import math

from .jit import Array, kernel


@kernel
def dense_solve(a: Array, b: Array, n: int, n_rhs: int) -> bool:
    """Solve ``a x = b`` in place; return False if a pivot is zero or not finite.

    Parameters
    ----------
    a : (n * n,) row by row, overwritten
    b : (n * n_rhs,) row by row; right sides in, solutions out
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
            for k in range(n_rhs):
                b[j * n_rhs + k], b[best * n_rhs + k] = b[best * n_rhs + k], b[j * n_rhs + k]
        for i in range(j + 1, n):
            f = a[i * n + j] / pivot
            for k in range(j + 1, n):
                a[i * n + k] -= f * a[j * n + k]
            for k in range(n_rhs):
                b[i * n_rhs + k] -= f * b[j * n_rhs + k]
    for j in range(n - 1, -1, -1):
        for k in range(n_rhs):
            x = b[j * n_rhs + k]
            for i in range(j + 1, n):
                x -= a[j * n + i] * b[i * n_rhs + k]
            b[j * n_rhs + k] = x / a[j * n + j]
    return True
