"""Band matrices: symmetric (Cholesky) and general (LU without exchange), factor and solve.

A symmetric matrix is stored by columns of its lower half: ``a[j * (band + 1) + k]`` is row j + k,
column j. A general one by rows: ``a[i * (2 * band + 1) + band + k]`` is row i, column i + k.

Inner loops go in groups of four, all read before any is written: vectors with the same numbers on
every machine.
"""

import math

import numpy as np

from .jit import Array, inlined, kernel

N_SIDES = 8  # right sides solved together: a full vector register


@inlined
def _four(a: Array, at: int) -> tuple[float, float, float, float]:
    """Return four numbers from ``at`` on."""
    return a[np.uintp(at)], a[np.uintp(at + 1)], a[np.uintp(at + 2)], a[np.uintp(at + 3)]


@inlined
def _put(a: Array, at: int, x0: float, x1: float, x2: float, x3: float) -> None:
    """Write four numbers from ``at`` on."""
    a[np.uintp(at)], a[np.uintp(at + 1)], a[np.uintp(at + 2)], a[np.uintp(at + 3)] = x0, x1, x2, x3


@inlined
def _less_two(a: Array, to: int, one: int, two: int, n: int, f0: float, f1: float) -> None:
    """Take two rows, ``f0`` and ``f1`` times, from a third of ``n`` numbers; none overlap."""
    for k in range(0, n - (n & 3), 4):
        x0, x1, x2, x3 = _four(a, one + k)
        y0, y1, y2, y3 = _four(a, two + k)
        z0, z1, z2, z3 = _four(a, to + k)
        z0, z1 = z0 - (f0 * x0 + f1 * y0), z1 - (f0 * x1 + f1 * y1)
        z2, z3 = z2 - (f0 * x2 + f1 * y2), z3 - (f0 * x3 + f1 * y3)
        _put(a, to + k, z0, z1, z2, z3)
    for over in range(n & 3):
        k = n - (n & 3) + over
        a[np.uintp(to + k)] -= f0 * a[np.uintp(one + k)] + f1 * a[np.uintp(two + k)]


@kernel
def cholesky(a: Array, n: int, band: int) -> bool:
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
            _less_two(a, target, s0, s1, end - m + 1, f0, f1)
            if end1 == end:  # the second column reaches one row further down
                a[target + end - m + 1] -= f1 * a[c1 + end1]
        if end1 == end and end >= 1:
            a[c0 + (end + 1) * w] -= a[c1 + end1] * a[c1 + end1]
        j += 2
    return True


@kernel
def mirror(a: Array, to: Array, n: int, band: int) -> None:
    """Write a factor to ``to`` once more, by rows, last row first.

    The way back of a solve is then the way forth with everything reversed, along memory.
    """
    w = band + 1
    for j in range(n):
        row = n - 1 - j
        for k in range(min(band, row) + 1):
            to[np.uintp(j * w + k)] = a[np.uintp((row - k) * w + k)]


@kernel
def _forth(a: Array, b: Array, n: int, band: int) -> None:
    """Solve with the lower factor ``a`` (by columns) in place of ``b``.

    Columns go in fours, which takes ``b`` through the registers a quarter as often.
    """
    w, rest = band + 1, (band + 1) & 3
    full = (n - 3 - band) // 4 * 4 if band >= 4 and n > band + 3 else 0
    for j in range(0, full, 4):
        c0 = j * w
        c1, c2, c3 = c0 + w, c0 + 2 * w, c0 + 3 * w
        x0 = b[j] / a[c0]
        x1 = (b[j + 1] - x0 * a[c0 + 1]) / a[c1]
        x2 = (b[j + 2] - x0 * a[c0 + 2] - x1 * a[c1 + 1]) / a[c2]
        x3 = (b[j + 3] - x0 * a[c0 + 3] - x1 * a[c1 + 2] - x2 * a[c2 + 1]) / a[c3]
        b[j], b[j + 1], b[j + 2], b[j + 3] = x0, x1, x2, x3
        for k in range(0, band - 3 - rest, 4):
            d0, d1, d2, d3 = _four(a, c0 + 4 + k)
            e0, e1, e2, e3 = _four(a, c1 + 3 + k)
            g0, g1, g2, g3 = _four(a, c2 + 2 + k)
            h0, h1, h2, h3 = _four(a, c3 + 1 + k)
            y0, y1, y2, y3 = _four(b, j + 4 + k)
            y0 -= (x0 * d0 + x1 * e0) + (x2 * g0 + x3 * h0)
            y1 -= (x0 * d1 + x1 * e1) + (x2 * g1 + x3 * h1)
            y2 -= (x0 * d2 + x1 * e2) + (x2 * g2 + x3 * h2)
            y3 -= (x0 * d3 + x1 * e3) + (x2 * g3 + x3 * h3)
            _put(b, j + 4 + k, y0, y1, y2, y3)
        for over in range(rest):
            k = w - rest + over
            b[np.uintp(j + k)] -= (x0 * a[np.uintp(c0 + k)] + x1 * a[np.uintp(c1 + k - 1)]) + (
                x2 * a[np.uintp(c2 + k - 2)] + x3 * a[np.uintp(c3 + k - 3)]
            )
        b[j + w] -= x1 * a[c1 + band] + x2 * a[c2 + band - 1] + x3 * a[c3 + band - 2]
        b[j + w + 1] -= x2 * a[c2 + band] + x3 * a[c3 + band - 1]
        b[j + w + 2] -= x3 * a[c3 + band]
    for j in range(full, n):
        c = j * w
        x = b[j] / a[c]
        b[j] = x
        for k in range(1, min(band, n - 1 - j) + 1):
            b[np.uintp(j + k)] -= x * a[np.uintp(c + k)]


@kernel
def _reverse(b: Array, n: int) -> None:
    for k in range(n // 2):
        x = b[np.uintp(k)]
        b[np.uintp(k)] = b[np.uintp(n - 1 - k)]
        b[np.uintp(n - 1 - k)] = x


@kernel
def factor_solve(lower: Array, mirrored: Array, b: Array, n: int, band: int) -> None:
    """Replace the right side ``b`` (n,) by the solution.

    ``lower`` and ``mirrored`` are the factor of `cholesky` and its `mirror`, or those of `halve`.
    """
    _forth(lower, b, n, band)
    _reverse(b, n)
    _forth(mirrored, b, n, band)
    _reverse(b, n)


@kernel
def cholesky_solve_many(a: Array, b: Array, n: int, band: int) -> None:
    """Solve for ``N_SIDES`` right sides at once; ``b[row * N_SIDES + side]``, in place."""
    _forth_many(a, b, n, band)
    w = band + 1
    for j in range(n - 1, -1, -1):
        end = min(band, n - 1 - j)
        c = j * w
        x0, x1, x2, x3 = _four(b, j * N_SIDES)
        x4, x5, x6, x7 = _four(b, j * N_SIDES + 4)
        for k in range(1, end + 1):
            f, there = a[np.uintp(c + k)], (j + k) * N_SIDES
            y0, y1, y2, y3 = _four(b, there)
            y4, y5, y6, y7 = _four(b, there + 4)
            x0, x1, x2, x3 = x0 - f * y0, x1 - f * y1, x2 - f * y2, x3 - f * y3
            x4, x5, x6, x7 = x4 - f * y4, x5 - f * y5, x6 - f * y6, x7 - f * y7
        scale = 1.0 / a[c]
        _put(b, j * N_SIDES, x0 * scale, x1 * scale, x2 * scale, x3 * scale)
        _put(b, j * N_SIDES + 4, x4 * scale, x5 * scale, x6 * scale, x7 * scale)


@kernel
def band_solve(a: Array, b: Array, n: int, band: int) -> None:
    """Replace ``b[:n]`` by the solution, given the factor of `cholesky` alone."""
    _forth(a, b, n, band)
    w = band + 1
    for j in range(n - 1, -1, -1):
        c = j * w
        s = b[j]
        for k in range(1, min(band, n - 1 - j) + 1):
            s -= a[np.uintp(c + k)] * b[np.uintp(j + k)]
        b[j] = s / a[c]


@kernel
def lu(a: Array, n: int, band: int) -> bool:
    """Replace ``a`` by its LU factors, no row exchange; return False at a zero pivot.

    Holds for matrices dominated by their diagonal, as conduction and transport with a falling
    source are. Rows go in pairs: each pair updates the rest in one pass.
    """
    w = 2 * band + 1
    j = 0
    while j < n:
        one = j * w + band
        if not (a[one] != 0.0 and math.isfinite(a[one])):
            return False
        per_one = 1.0 / a[one]
        end = min(band, n - 1 - j)
        if end == 0:
            return True
        two = one + w - 1  # row j + 1, column j
        f = a[two] * per_one
        a[two] = f
        for k in range(1, end + 1):
            a[np.uintp(two + k)] -= f * a[np.uintp(one + k)]
        pivot = a[two + 1]
        if not (pivot != 0.0 and math.isfinite(pivot)):
            return False
        per_two = 1.0 / pivot
        last = min(band, n - 2 - j)  # of the second row's columns
        for m in range(2, end + 1):
            target = one + m * (w - 1)
            f0 = a[target] * per_one
            f1 = (a[target + 1] - f0 * a[one + 1]) * per_two
            a[target], a[target + 1] = f0, f1
            _less_two(a, target + 2, one + 2, two + 2, end - 1, f0, f1)
            if last == end:
                a[target + end + 1] -= f1 * a[two + end + 1]
        if last == end:
            target = one + (end + 1) * (w - 1) + 1  # the row that only the second reaches
            f1 = a[target] * per_two
            a[target] = f1
            for k in range(1, end + 1):
                a[np.uintp(target + k)] -= f1 * a[np.uintp(two + 1 + k)]
        j += 2
    return True


@kernel
def halve(a: Array, lower: Array, mirrored: Array, n: int, band: int) -> None:
    """Write the factors of `lu` to two arrays that `factor_solve` takes."""
    w, wide = band + 1, 2 * band + 1
    for j in range(n):
        lower[j * w] = 1.0
        for k in range(1, min(band, n - 1 - j) + 1):
            lower[np.uintp(j * w + k)] = a[np.uintp((j + k) * wide + band - k)]
        row = n - 1 - j
        for k in range(min(band, row) + 1):
            mirrored[np.uintp(j * w + k)] = a[np.uintp((row - k) * wide + band + k)]


@kernel
def _forth_many(a: Array, b: Array, n: int, band: int) -> None:
    """Solve with the lower factor ``a`` (by columns) in place of ``b[row * N_SIDES + side]``."""
    w = band + 1
    for j in range(n):
        c, here = j * w, j * N_SIDES
        scale = 1.0 / a[c]
        x0, x1, x2, x3 = _four(b, here)
        x4, x5, x6, x7 = _four(b, here + 4)
        x0, x1, x2, x3 = x0 * scale, x1 * scale, x2 * scale, x3 * scale
        x4, x5, x6, x7 = x4 * scale, x5 * scale, x6 * scale, x7 * scale
        _put(b, here, x0, x1, x2, x3)
        _put(b, here + 4, x4, x5, x6, x7)
        for k in range(1, min(band, n - 1 - j) + 1):
            f, there = a[np.uintp(c + k)], (j + k) * N_SIDES
            y0, y1, y2, y3 = _four(b, there)
            y4, y5, y6, y7 = _four(b, there + 4)
            _put(b, there, y0 - f * x0, y1 - f * x1, y2 - f * x2, y3 - f * x3)
            _put(b, there + 4, y4 - f * x4, y5 - f * x5, y6 - f * x6, y7 - f * x7)


@kernel
def _reverse_many(b: Array, n: int) -> None:
    for k in range(n // 2):
        for s in range(N_SIDES):
            one, two = np.uintp(k * N_SIDES + s), np.uintp((n - 1 - k) * N_SIDES + s)
            b[one], b[two] = b[two], b[one]


@kernel
def factor_solve_many(lower: Array, mirrored: Array, b: Array, n: int, band: int) -> None:
    """Solve for ``N_SIDES`` right sides at once, in place; see `factor_solve`."""
    _forth_many(lower, b, n, band)
    _reverse_many(b, n)
    _forth_many(mirrored, b, n, band)
    _reverse_many(b, n)
