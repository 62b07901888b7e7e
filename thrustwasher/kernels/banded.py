"""Band matrices: symmetric (Cholesky) and general (LU without exchange), factor and solve.

A symmetric matrix is stored by columns of its lower half: ``a[j * (band + 1) + k]`` is row j + k,
column j. A general one by rows: ``a[i * (2 * band + 1) + band + k]`` is row i, column i + k.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel

N_SIDES = 8  # right sides solved together: a full vector register


@kernel
def cholesky(a: NDArray[np.float64], n: int, band: int) -> bool:
    """Replace ``a`` by its Cholesky factor; return False if it is not positive definite.

    Columns go in pairs: each pair updates the rest in one pass, which halves the memory traffic.
    """
    w = band + 1
    j = 0
    while j < n:
        end = min(band, n - 1 - j)
        c0 = j * w
        if not (a[c0] > 0.0 and math.isfinite(a[c0])):
            return False
        scale = 1.0 / math.sqrt(a[c0])
        for k in range(end + 1):
            a[np.uintp(c0 + k)] *= scale
        if end == 0:
            return True
        # second column of the pair
        c1 = c0 + w
        f = a[c0 + 1]
        for k in range(end):
            a[np.uintp(c1 + k)] -= f * a[np.uintp(c0 + 1 + k)]
        end1 = min(band, n - 2 - j)
        if not (a[c1] > 0.0 and math.isfinite(a[c1])):
            return False
        scale = 1.0 / math.sqrt(a[c1])
        for k in range(end1 + 1):
            a[np.uintp(c1 + k)] *= scale
        for m in range(2, end + 1):
            f0 = a[c0 + m]
            f1 = a[c1 + m - 1]
            target = c0 + m * w
            s0, s1 = c0 + m, c1 + m - 1
            for k in range(end - m + 1):
                a[np.uintp(target + k)] -= f0 * a[np.uintp(s0 + k)] + f1 * a[np.uintp(s1 + k)]
            if end1 == end:  # the second column reaches one row further down
                a[target + end - m + 1] -= f1 * a[c1 + end1]
        if end1 == end and end >= 1:
            a[c0 + (end + 1) * w] -= a[c1 + end1] * a[c1 + end1]
        j += 2
    return True


@kernel
def cholesky_solve(a: NDArray[np.float64], b: NDArray[np.float64], n: int, band: int) -> None:
    """Replace the right side ``b`` (n,) by the solution, given the factor of `cholesky`."""
    w = band + 1
    for j in range(n):
        end = min(band, n - 1 - j)
        c = j * w
        x = b[j] / a[c]
        b[j] = x
        for k in range(1, end + 1):
            b[np.uintp(j + k)] -= x * a[np.uintp(c + k)]
    for j in range(n - 1, -1, -1):
        end = min(band, n - 1 - j)
        c = j * w
        # four sums at a time: one alone waits for each addition
        s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
        k = 1
        while k + 3 <= end:
            s0 += a[np.uintp(c + k)] * b[np.uintp(j + k)]
            s1 += a[np.uintp(c + k + 1)] * b[np.uintp(j + k + 1)]
            s2 += a[np.uintp(c + k + 2)] * b[np.uintp(j + k + 2)]
            s3 += a[np.uintp(c + k + 3)] * b[np.uintp(j + k + 3)]
            k += 4
        while k <= end:
            s0 += a[np.uintp(c + k)] * b[np.uintp(j + k)]
            k += 1
        b[j] = (b[j] - ((s0 + s1) + (s2 + s3))) / a[c]


@kernel
def cholesky_solve_many(a: NDArray[np.float64], b: NDArray[np.float64], n: int, band: int) -> None:
    """Solve for ``N_SIDES`` right sides at once; ``b[row * N_SIDES + side]``, in place."""
    w = band + 1
    for j in range(n):
        end = min(band, n - 1 - j)
        c = j * w
        here = j * N_SIDES
        scale = 1.0 / a[c]
        for s in range(N_SIDES):
            b[np.uintp(here + s)] *= scale
        for k in range(1, end + 1):
            f = a[np.uintp(c + k)]
            there = (j + k) * N_SIDES
            for s in range(N_SIDES):
                b[np.uintp(there + s)] -= f * b[np.uintp(here + s)]
    for j in range(n - 1, -1, -1):
        end = min(band, n - 1 - j)
        c = j * w
        here = j * N_SIDES
        for k in range(1, end + 1):
            f = a[np.uintp(c + k)]
            there = (j + k) * N_SIDES
            for s in range(N_SIDES):
                b[np.uintp(here + s)] -= f * b[np.uintp(there + s)]
        scale = 1.0 / a[c]
        for s in range(N_SIDES):
            b[np.uintp(here + s)] *= scale


@kernel
def lu(a: NDArray[np.float64], n: int, band: int) -> bool:
    """Replace ``a`` by its LU factors, no row exchange; return False at a zero pivot.

    Holds for matrices dominated by their diagonal, as conduction with a falling source is.
    """
    w = 2 * band + 1
    for j in range(n):
        row = j * w + band
        if not (a[row] != 0.0 and math.isfinite(a[row])):
            return False
        end = min(band, n - 1 - j)
        for m in range(1, end + 1):
            target = (j + m) * w + band - m
            f = a[target] / a[row]
            a[target] = f
            for k in range(1, end + 1):
                a[np.uintp(target + k)] -= f * a[np.uintp(row + k)]
    return True


@kernel
def lu_solve(a: NDArray[np.float64], b: NDArray[np.float64], n: int, band: int) -> None:
    """Replace the right side ``b`` (n,) by the solution, given the factors of `lu`."""
    w = 2 * band + 1
    for i in range(n):
        row = i * w + band
        s = b[i]
        for k in range(max(-band, -i), 0):
            s -= a[np.uintp(row + k)] * b[np.uintp(i + k)]
        b[i] = s
    for i in range(n - 1, -1, -1):
        row = i * w + band
        s = b[i]
        for k in range(1, min(band, n - 1 - i) + 1):
            s -= a[np.uintp(row + k)] * b[np.uintp(i + k)]
        b[i] = s / a[row]
