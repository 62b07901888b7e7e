"""A recorded profile as a few points with straight lines between them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ROWS = 2000  # means of neighbouring rows stand for more of them
CELLS = 250  # places that points are first required at
ENOUGH = 1.05  # times the minimum misfit: fewer points that reach it are taken
SWEEPS = 3  # in which each point is moved as long as it helps
CLOSE = 1e-9  # of the span: a misfit that is rounding


class Polyline(NamedTuple):
    """Points of a profile, and what they leave out."""

    time: Array
    value: Array
    rms: float  # root mean square of row less line; 0 where the points are the rows


def few_points(time: Array, value: Array, most: int) -> Polyline:
    """Return a profile as at most ``most`` points, 2 or more, as few as follow it nearly as well.

    Rows of ``most`` times or fewer are taken as they are. Else times of points are chosen by
    dynamic programming over straight pieces, then moved while that helps; their values are those of
    least squares over all rows.

    Parameters
    ----------
    time : (n,) never falling; rows of one time count by their mean
    value : (n,)

    Examples
    --------
    >>> t = np.linspace(0.0, 1.0, 101)
    >>> found = few_points(t, np.interp(t, [0.0, 0.3, 1.0], [0.0, 2.0, 2.0]), 10)
    >>> found.time.round(6).tolist(), (found.value.round(6) + 0.0).tolist()
    ([0.0, 0.3, 1.0], [0.0, 2.0, 2.0])
    """
    starts = np.flatnonzero(np.append(True, np.diff(time) > 0.0))
    is_short = len(starts) <= most
    starts = starts[np.unique(np.linspace(0, len(starts) - 1, min(len(starts), ROWS)).astype(int))]
    size = np.diff(np.append(starts, len(time))).astype(float)
    times, values = np.add.reduceat(time, starts) / size, np.add.reduceat(value, starts) / size
    if is_short:
        return Polyline(time[starts], values, 0.0)
    cells = np.unique(np.linspace(0, len(times) - 1, min(len(times), CELLS)).astype(np.int64))
    misfit = _misfits(times, values, size, cells)
    span = float(np.ptp(values))
    found = [_moved(cells[_split(misfit, n - 1)], times, values, size) for n in range(2, most + 1)]
    least = min(rms for _, _, rms in found)
    knots, heights, _ = next(x for x in found if x[2] <= max(ENOUGH * least, CLOSE * span))
    off = value - np.interp(time, times[knots], heights)
    return Polyline(times[knots], heights, float(np.sqrt(np.mean(off * off))))


def _misfits(time: Array, value: Array, weight: Array, cells: NDArray[np.int64]) -> Array:
    """Return the minimum sum of squares of a line from place to place, infinite backwards."""
    t, y = time - time.mean(), value - value.mean()
    sums = [
        np.append(0.0, np.cumsum(weight * x)) for x in (np.ones_like(t), t, y, t * t, t * y, y * y)
    ]
    n, st, sy, stt, sty, syy = (s[cells[None, :] + 1] - s[cells[:, None]] for s in sums)
    with np.errstate(divide="ignore", invalid="ignore"):
        rise = sty - st * sy / n
        found = syy - sy * sy / n - rise * rise / (stt - st * st / n)
    ahead = cells[None, :] > cells[:, None]
    return np.where(ahead, np.maximum(found, 0.0), np.inf)


def _split(misfit: Array, pieces: int) -> NDArray[np.int64]:
    """Return the places of the ends of so many pieces with the minimum sum of misfits."""
    best, ways = misfit[0], []
    for _ in range(pieces - 1):
        total = best[:, None] + misfit
        ways.append(np.argmin(total, axis=0))
        best = total[ways[-1], np.arange(len(best))]
    ends = [len(best) - 1]
    for way in reversed(ways):
        ends.append(int(way[ends[-1]]))
    return np.array([0, *reversed(ends)])


def _moved(
    knots: NDArray[np.int64], time: Array, value: Array, size: Array
) -> tuple[NDArray[np.int64], Array, float]:
    """Return places moved while that helps, the values there, and the root mean square."""
    knots = np.unique(knots)
    heights, rms = _heights(time[knots], time, value, size)
    step = max(1, len(time) // CELLS)
    while step:
        for _ in range(SWEEPS):
            before = rms
            for i in range(1, len(knots) - 1):
                for way in (-step, step):
                    other = knots + way * (np.arange(len(knots)) == i)
                    if other[i - 1] < other[i] < other[i + 1]:
                        there, new = _heights(time[other], time, value, size)
                        if new < rms:
                            knots, heights, rms = other, there, new
            if not rms < before:
                break
        step //= 2
    return knots, heights, rms


def _heights(knots: Array, time: Array, value: Array, size: Array) -> tuple[Array, float]:
    """Return the values at knots that fit a profile best, and the root mean square left over."""
    right = np.clip(np.searchsorted(knots, time, "right"), 1, len(knots) - 1)
    share = (time - knots[right - 1]) / (knots[right] - knots[right - 1])
    shares = np.zeros((len(time), len(knots)))
    rows = np.arange(len(time))
    shares[rows, right - 1], shares[rows, right] = 1.0 - share, share
    normal = shares.T @ (shares * size[:, None])
    heights = np.linalg.lstsq(normal, shares.T @ (value * size), rcond=None)[0]
    off = value - shares @ heights
    return np.asarray(heights, float), float(np.sqrt(np.sum(size * off * off) / size.sum()))
