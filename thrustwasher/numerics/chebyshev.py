"""Charts: functions of three parameters as piecewise Chebyshev interpolants, read at one place.

Each axis is cut into patches of equal width. A patch has the four Chebyshev-Lobatto nodes -1, -1/2,
1/2, 1, so that neighbours share the nodes on their border and the interpolant is continuous; an
axis that is fixed has no patch and one node. Over the first and the third axis a patch is a product
of cubics. Over the second it is a cubic at their corners only; between them what this cubic adds to
a straight line is interpolated linearly (as in serendipity elements): 40 nodes instead of 64.

At each node lies a *line* of numbers. First come those at the ends of the second axis's patches,
the second axis running fastest, the first slowest; then those inside of its patches, at corners of
the others, the third axis running fastest, the second slowest.

``cell`` says where a place is: for each axis the first node, weights and their slopes; then the
weights of the 40 nodes, and the change of these along a direction.
"""

import numpy as np

from .arrays import clear
from .jit import Array, inlined, kernel

N_AXES = 3
N_NODES = 4  # of a patch
MOST_TERMS = 12  # coefficients of a polynomial over the fourth coordinate
# places of one axis in `cell`: cubic weights (4), their slopes (4), linear weights (2), their slope
FIRST, WEIGHT, SLOPE, LINEAR, LINEAR_SLOPE = 0, 1, 5, 9, 11
N_AXIS = 12
N_SHARES = 40  # nodes of a patch
SHARES = N_AXES * N_AXIS
CHANGES = SHARES + N_SHARES
N_CELL = CHANGES + N_SHARES
INNER = 32  # place of the nodes inside of the second axis among the shares


def lines_of(patches1: int, patches2: int, patches3: int) -> int:
    """Return how many lines a chart has."""
    ends = (3 * patches1 + 1) * (3 * patches3 + 1) * (patches2 + 1)
    return ends + 2 * patches2 * (patches1 + 1) * (patches3 + 1)


@kernel
def enter_cell(cell: Array, axis: int, x: float, low: float, high: float, patches: int) -> None:
    """Write weights and slopes of one axis at ``x``; beyond ``low .. high`` it extrapolates."""
    base = axis * N_AXIS
    if patches < 1:
        clear(cell[base : base + N_AXIS])
        cell[base + WEIGHT] = 1.0
        cell[base + LINEAR] = 1.0
        return
    width = (high - low) / patches
    patch = min(max(int((x - low) / width), 0), patches - 1)
    t = 2.0 * (x - low - patch * width) / width - 1.0
    scale = 2.0 / width
    square = t * t
    w = base + WEIGHT
    cell[base + FIRST] = patch
    cell[w] = (t - 1.0) * (square - 0.25) / -1.5
    cell[w + 1] = (square - 1.0) * (t - 0.5) / 0.75
    cell[w + 2] = (square - 1.0) * (t + 0.5) / -0.75
    cell[w + 3] = (t + 1.0) * (square - 0.25) / 1.5
    s = base + SLOPE
    cell[s] = scale * (3.0 * square - 2.0 * t - 0.25) / -1.5
    cell[s + 1] = scale * (3.0 * square - t - 1.0) / 0.75
    cell[s + 2] = scale * (3.0 * square + t - 1.0) / -0.75
    cell[s + 3] = scale * (3.0 * square + 2.0 * t - 0.25) / 1.5
    cell[base + LINEAR] = 0.5 * (1.0 - t)
    cell[base + LINEAR + 1] = 0.5 * (1.0 + t)
    cell[base + LINEAR_SLOPE] = 0.5 * scale


@kernel
def share_out(cell: Array) -> None:
    """Write the weights of the nodes; all axes have been entered."""
    two, three = N_AXIS, 2 * N_AXIS
    for a in range(N_NODES):
        for c in range(N_NODES):
            product = cell[WEIGHT + a] * cell[three + WEIGHT + c]
            for b in range(2):
                cell[SHARES + 8 * a + 2 * c + b] = product * cell[two + LINEAR + b]
    for a in range(2):
        for c in range(2):
            product = cell[LINEAR + a] * cell[three + LINEAR + c]
            for b in range(2):
                bent = cell[two + WEIGHT + 3 * b] - cell[two + LINEAR + b]
                cell[SHARES + 24 * a + 6 * c + b] += product * bent
                inner = SHARES + INNER + 4 * b + 2 * a + c
                cell[inner] = product * cell[two + WEIGHT + 1 + b]


@kernel
def share_out_change(cell: Array, along1: float, along2: float, along3: float) -> None:
    """Write how the weights of the nodes change along a direction of the three axes."""
    two, three = N_AXIS, 2 * N_AXIS
    for a in range(N_NODES):
        for c in range(N_NODES):
            one, other = cell[WEIGHT + a], cell[three + WEIGHT + c]
            product = one * other
            change = along1 * cell[SLOPE + a] * other + along3 * one * cell[three + SLOPE + c]
            for b in range(2):
                slope = (2.0 * b - 1.0) * cell[two + LINEAR_SLOPE]
                cell[CHANGES + 8 * a + 2 * c + b] = (
                    change * cell[two + LINEAR + b] + product * along2 * slope
                )
    for a in range(2):
        for c in range(2):
            one, other = cell[LINEAR + a], cell[three + LINEAR + c]
            product = one * other
            change = along1 * (2.0 * a - 1.0) * cell[LINEAR_SLOPE] * other
            change += along3 * one * (2.0 * c - 1.0) * cell[three + LINEAR_SLOPE]
            for b in range(2):
                slope = (2.0 * b - 1.0) * cell[two + LINEAR_SLOPE]
                bent = cell[two + WEIGHT + 3 * b] - cell[two + LINEAR + b]
                bend = cell[two + SLOPE + 3 * b] - slope
                cell[CHANGES + 24 * a + 6 * c + b] += change * bent + product * along2 * bend
                inner = CHANGES + INNER + 4 * b + 2 * a + c
                cell[inner] = (
                    change * cell[two + WEIGHT + 1 + b]
                    + product * along2 * cell[two + SLOPE + 1 + b]
                )


@inlined
def _add_eight(
    data: Array,
    at: int,
    step1: int,
    step2: int,
    step3: int,
    cell: Array,
    share: int,
    width: int,
    out: Array,
    to: int,
) -> None:
    """Add eight lines times their weights; two along each step, the last one fastest."""
    x0, x1, x2, x3 = cell[share], cell[share + 1], cell[share + 2], cell[share + 3]
    x4, x5, x6, x7 = cell[share + 4], cell[share + 5], cell[share + 6], cell[share + 7]
    p0, p1, p2, p3 = at, at + step3, at + step2, at + step2 + step3
    p4, p5, p6, p7 = p0 + step1, p1 + step1, p2 + step1, p3 + step1
    for k in range(width):
        out[np.uintp(to + k)] += (
            x0 * data[np.uintp(p0 + k)]
            + x1 * data[np.uintp(p1 + k)]
            + x2 * data[np.uintp(p2 + k)]
            + x3 * data[np.uintp(p3 + k)]
            + x4 * data[np.uintp(p4 + k)]
            + x5 * data[np.uintp(p5 + k)]
            + x6 * data[np.uintp(p6 + k)]
            + x7 * data[np.uintp(p7 + k)]
        )


@kernel
def contract(
    data: Array,
    at: int,
    line: int,
    patches1: int,
    patches2: int,
    patches3: int,
    cell: Array,
    shares: int,
    width: int,
    out: Array,
    to: int,
) -> None:
    """Interpolate ``width`` numbers of the lines into ``out[to:]``; fast for multiples of 16.

    Parameters
    ----------
    data, at : where the first number of the first line lies
    line : numbers of a line
    shares : ``SHARES`` for values, ``CHANGES`` for their change along the direction
    """
    for k in range(width):
        out[np.uintp(to + k)] = 0.0
    one, two, three = int(cell[FIRST]), int(cell[N_AXIS + FIRST]), int(cell[2 * N_AXIS + FIRST])
    n3, row = 3 * patches3 + 1, (patches2 + 1) * line
    step1 = n3 * row if patches1 > 0 else 0
    step2 = line if patches2 > 0 else 0
    step3 = row if patches3 > 0 else 0
    first = at + 3 * one * step1 + two * step2 + 3 * three * step3
    for a in range(N_NODES if patches1 > 0 else 1):
        _add_eight(
            data, first + a * step1, 2 * step3, step3, step2, cell, shares + 8 * a, width, out, to
        )
    if patches2 > 0:
        inner = at + (3 * patches1 + 1) * n3 * row
        step3 = line if patches3 > 0 else 0
        step1 = (patches3 + 1) * line if patches1 > 0 else 0
        step2 = (patches1 + 1) * (patches3 + 1) * line
        inner += 2 * two * step2 + one * step1 + three * step3
        _add_eight(data, inner, step2, step1, step3, cell, shares + INNER, width, out, to)


@kernel
def polynomial(c: Array, at: int, n: int, u: float) -> float:
    """Return the Chebyshev sum of ``n`` coefficients at ``u`` (Clenshaw)."""
    one, two = 0.0, 0.0
    for k in range(n - 1, 0, -1):
        one, two = c[np.uintp(at + k)] + 2.0 * u * one - two, one
    return float(c[at] + u * one - two)


@kernel
def polynomial_slope(c: Array, at: int, n: int, u: float) -> tuple[float, float]:
    """Return value and slope over ``u`` of a Chebyshev sum of ``n`` coefficients."""
    before, now = 1.0, u  # T of the last two orders
    slope_before, slope_now = 0.0, 1.0
    value, slope = c[at] + u * c[at + 1], c[at + 1]
    for k in range(2, n):
        following = 2.0 * u * now - before
        slope_following = 2.0 * now + 2.0 * u * slope_now - slope_before
        before, now = now, following
        slope_before, slope_now = slope_now, slope_following
        value += c[np.uintp(at + k)] * now
        slope += c[np.uintp(at + k)] * slope_now
    return float(value), float(slope)
