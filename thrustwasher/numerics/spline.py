"""Splines: weights that integrate the not-a-knot cubic one, the quintic between two knots."""

from .arrays import clear
from .dense import dense_solve
from .jit import Array, kernel


@kernel
def spline_weights(x: Array, weights: Array, n: int, work: Array) -> bool:
    """Fill ``weights`` so that sum(weights f) is the integral of the spline through (x, f).

    Parameters
    ----------
    x : (n,) nodes, ascending, n >= 4; weights : (n,) out
    work : (n * n + n,) overwritten

    Notes
    -----
    Derived: the integral is the trapezoid sum less sum h^3/24 (M_i + M_i+1), where the second
    derivatives M solve A M = B f; so the weights are the trapezoid's less B^T A^-T v. Exact for
    cubics; error of order 4 for smooth f, also on graded nodes.
    """
    v = n * n
    clear(work[: v + n])
    clear(weights[:n])
    for i in range(n - 1):
        h = x[i + 1] - x[i]
        weights[i] += 0.5 * h
        weights[i + 1] += 0.5 * h
        work[v + i] += h**3 / 24.0
        work[v + i + 1] += h**3 / 24.0
    # A transposed: entry (row, col) of A goes to work[col * n + row]
    h0, h1 = x[1] - x[0], x[2] - x[1]
    work[0], work[n], work[2 * n] = h1, -(h0 + h1), h0
    h0, h1 = x[n - 2] - x[n - 3], x[n - 1] - x[n - 2]
    work[(n - 3) * n + n - 1], work[(n - 2) * n + n - 1] = h1, -(h0 + h1)
    work[(n - 1) * n + n - 1] = h0
    for i in range(1, n - 1):
        h0, h1 = x[i] - x[i - 1], x[i + 1] - x[i]
        work[(i - 1) * n + i] = h0 / 6.0
        work[i * n + i] = (h0 + h1) / 3.0
        work[(i + 1) * n + i] = h1 / 6.0
    y = work[n * n : n * n + n]
    if not dense_solve(work[: n * n], y, n):
        return False
    for i in range(1, n - 1):
        h0, h1 = x[i] - x[i - 1], x[i + 1] - x[i]
        weights[i - 1] -= y[i] / h0
        weights[i] += y[i] * (1.0 / h0 + 1.0 / h1)
        weights[i + 1] -= y[i] / h1
    return True


@kernel
def quintic(
    one: tuple[float, float, float], two: tuple[float, float, float], t: float
) -> tuple[float, float]:
    """Return value and slope at ``t`` in 0 .. 1 of the quintic between two knots.

    ``one``, ``two``: value, slope and curvature there, over ``t``.
    """
    (f0, g0, c0), (f1, g1, c1) = one, two
    a = f1 - f0 - g0 - 0.5 * c0
    b = g1 - g0 - c0
    c = c1 - c0
    e3 = 10.0 * a - 4.0 * b + 0.5 * c
    e4 = -15.0 * a + 7.0 * b - c
    e5 = 6.0 * a - 3.0 * b + 0.5 * c
    value = f0 + t * (g0 + t * (0.5 * c0 + t * (e3 + t * (e4 + t * e5))))
    return value, g0 + t * (c0 + t * (3.0 * e3 + t * (4.0 * e4 + t * 5.0 * e5)))
