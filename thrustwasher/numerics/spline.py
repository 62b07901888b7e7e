"""Quadrature weights of the not-a-knot cubic spline through given nodes."""

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
    for k in range(n * n + n):
        work[k] = 0.0
    v = n * n
    for i in range(n):
        weights[i] = 0.0
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
    if not dense_solve(work[: n * n], y, n, 1):
        return False
    for i in range(1, n - 1):
        h0, h1 = x[i] - x[i - 1], x[i + 1] - x[i]
        weights[i - 1] -= y[i] / h0
        weights[i] += y[i] * (1.0 / h0 + 1.0 / h1)
        weights[i + 1] -= y[i] / h1
    return True
