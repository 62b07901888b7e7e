"""Charts: functions of three parameters as piecewise Chebyshev interpolants, read at one place.

Each axis is cut into patches of equal width. A patch has the four Chebyshev-Lobatto nodes -1, -1/2,
1/2, 1, so that neighbours share the nodes on their border and the interpolant is continuous; an
axis that is fixed has no patch and one node. At each node of the tensor grid lies a *line* of
numbers, itself the Chebyshev coefficients over a fourth coordinate.

``cell`` says where a place is: for each axis the first node, four weights and their four slopes.
"""

import numpy as np

from .jit import Array, kernel

N_AXES = 3
N_NODES = 4  # of a patch
N_TERMS = 8  # coefficients over the fourth coordinate
FIRST, WEIGHT, SLOPE = 0, 1, 5  # places of one axis in `cell`
N_AXIS = 9
N_CELL = N_AXES * N_AXIS


def nodes_of(patches: int) -> int:
    """Return how many nodes an axis of so many patches has."""
    return (N_NODES - 1) * patches + 1


@kernel
def enter_cell(cell: Array, axis: int, x: float, low: float, high: float, patches: int) -> None:
    """Write weights and slopes of one axis at ``x``; beyond ``low .. high`` it extrapolates."""
    base = axis * N_AXIS
    if patches < 1:
        for k in range(N_AXIS):
            cell[base + k] = 0.0
        cell[base + WEIGHT] = 1.0
        return
    width = (high - low) / patches
    patch = min(max(int((x - low) / width), 0), patches - 1)
    t = 2.0 * (x - low - patch * width) / width - 1.0
    scale = 2.0 / width
    square = t * t
    w = base + WEIGHT
    cell[base + FIRST] = (N_NODES - 1) * patch
    cell[w] = (t - 1.0) * (square - 0.25) / -1.5
    cell[w + 1] = (square - 1.0) * (t - 0.5) / 0.75
    cell[w + 2] = (square - 1.0) * (t + 0.5) / -0.75
    cell[w + 3] = (t + 1.0) * (square - 0.25) / 1.5
    s = base + SLOPE
    cell[s] = scale * (3.0 * square - 2.0 * t - 0.25) / -1.5
    cell[s + 1] = scale * (3.0 * square - t - 1.0) / 0.75
    cell[s + 2] = scale * (3.0 * square + t - 1.0) / -0.75
    cell[s + 3] = scale * (3.0 * square + 2.0 * t - 0.25) / 1.5


@kernel
def contract(
    data: Array, at: int, step1: int, step2: int, step3: int,
    cell: Array, slope_of: int, width: int, out: Array, to: int,
) -> None:  # fmt: skip
    """Interpolate ``width`` numbers of the lines into ``out[to:]``.

    Parameters
    ----------
    data, at : where the first number of the first line lies
    step1, step2, step3 : from one node to the next along each axis; 0 for a fixed axis
    slope_of : axis to differentiate over, -1 for values
    """
    for k in range(width):
        out[np.uintp(to + k)] = 0.0
    w1 = SLOPE if slope_of == 0 else WEIGHT
    w2 = N_AXIS + (SLOPE if slope_of == 1 else WEIGHT)
    w3 = 2 * N_AXIS + (SLOPE if slope_of == 2 else WEIGHT)
    c0, c1, c2, c3 = cell[w3], cell[w3 + 1], cell[w3 + 2], cell[w3 + 3]
    first = at + int(cell[FIRST]) * step1 + int(cell[N_AXIS + FIRST]) * step2
    first += int(cell[2 * N_AXIS + FIRST]) * step3
    for a in range(N_NODES):
        for b in range(N_NODES):
            ab = cell[w1 + a] * cell[w2 + b]
            x0, x1, x2, x3 = ab * c0, ab * c1, ab * c2, ab * c3
            p0 = first + a * step1 + b * step2
            p1, p2, p3 = p0 + step3, p0 + 2 * step3, p0 + 3 * step3
            # four lines at a time, so that sums are stored once: a third of the time
            for k in range(width):
                out[np.uintp(to + k)] += (
                    x0 * data[np.uintp(p0 + k)] + x1 * data[np.uintp(p1 + k)]
                    + x2 * data[np.uintp(p2 + k)] + x3 * data[np.uintp(p3 + k)]
                )  # fmt: skip


@kernel
def polynomial(c: Array, at: int, u: float) -> float:
    """Return the Chebyshev sum of ``N_TERMS`` coefficients at ``u`` (Clenshaw)."""
    one, two = 0.0, 0.0
    for k in range(N_TERMS - 1, 0, -1):
        one, two = c[np.uintp(at + k)] + 2.0 * u * one - two, one
    return float(c[at] + u * one - two)


@kernel
def polynomial_slope(c: Array, at: int, u: float) -> tuple[float, float]:
    """Return value and slope over ``u`` of a Chebyshev sum."""
    before, now = 1.0, u  # T of the last two orders
    slope_before, slope_now = 0.0, 1.0
    value, slope = c[at] + u * c[at + 1], c[at + 1]
    for k in range(2, N_TERMS):
        following = 2.0 * u * now - before
        slope_following = 2.0 * now + 2.0 * u * slope_now - slope_before
        before, now = now, following
        slope_before, slope_now = slope_now, slope_following
        value += c[np.uintp(at + k)] * now
        slope += c[np.uintp(at + k)] * slope_now
    return float(value), float(slope)
