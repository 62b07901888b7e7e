"""A recording as means of neighbouring rows: many where much happens, few where nothing does."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....numerics.jit import Array
from .recording import ON, Recording, row_scatter

FINER = 8  # cells per mean, from which the profile is judged
EVEN = 0.5  # share of the means that are spread evenly over time; the rest follow the changes
SCATTERS = 1e-6  # of the span: a bend from row to row that is no rounding
OFF = 0.05  # of the largest load: an engagement begins above ``ON``, ends below this


@dataclass(frozen=True, eq=False)
class Run:
    """A recording without jumps as means of neighbouring rows, SI units."""

    name: str
    time: Array  # (m,) mean times, rising
    edges: Array  # (m + 1,) where one group of rows ends and the next one begins
    inputs: dict[str, Array]  # (m,) each
    values: dict[str, Array]  # (m,) each; NaN where not measured
    counts: dict[str, Array]  # (m,) rows behind each value
    sizes: Array  # (m,) rows behind each mean
    scatter: dict[str, float]  # standard deviation of one row of a column; 0 where unknown
    n_rows: int
    kept: dict[str, float]  # share of an input's variance that the means keep
    engaged: NDArray[np.int64]  # (m,) engagement that a mean belongs to, from 1; 0: open pack
    gaps: tuple[float, ...] = ()  # [s] lengths of those that are bridged


def binned(piece: Recording, most: int, pressing: str, largest: float) -> Run:
    """Return a piece of a recording as ``most`` means of neighbouring rows, or fewer.

    No mean reaches into a gap, which may make a few more. Rows of the same time are taken together
    in any case. Work and memory are those of a few copies of the rows; what comes out does not
    depend on their number.

    Parameters
    ----------
    piece : rows whose time never falls
    most : means, 2 or more
    pressing : the input that rises when an engagement begins
    largest : its largest value in the whole recording
    """
    distinct = np.flatnonzero(np.append(True, np.diff(piece.time) > 0.0))
    starts = _cells(distinct, FINER * most)
    columns = {**piece.inputs, **piece.outputs}
    own = piece.is_recorded
    scatter = {name: row_scatter(x[own]) for name, x in columns.items()}
    smooth = {name: smoothed(piece.time, x) for name, x in piece.inputs.items()}
    if len(starts) > most:
        starts = _followed(piece, starts, scatter, most)
    ends = [row for gap in piece.gaps for row in (gap.start, gap.stop)]
    starts = np.union1d(starts, np.array(ends, np.int64))
    n = len(piece.time)
    size = np.diff(np.append(starts, n)).astype(float)
    time = np.add.reduceat(piece.time, starts) / size
    middle = 0.5 * (time[:-1] + time[1:])
    inputs = {name: np.add.reduceat(x, starts) / size for name, x in smooth.items()}
    values, counts = {}, {}
    for name, x in piece.outputs.items():
        values[name], counts[name] = _known_means(x, starts)
    kept = {
        name: float(np.sum(size * (inputs[name] - x.mean()) ** 2) / max(n * float(x.var()), 1e-300))
        for name, x in piece.inputs.items()
        if np.ptp(x) > 0.0
    }
    return Run(
        name=piece.name,
        time=time,
        edges=np.concatenate([piece.time[:1], middle, piece.time[-1:]]),
        inputs=inputs,
        values=values,
        counts=counts,
        sizes=size,
        scatter=scatter,
        n_rows=int(np.count_nonzero(own)),
        kept=kept,
        engaged=engagements(inputs[pressing], largest),
        gaps=tuple(float(piece.time[g.stop] - piece.time[g.start - 1]) for g in piece.gaps),
    )


def smoothed(time: Array, values: Array) -> Array:
    """Return recorded inputs half way to the straight line between their neighbours.

    Where rows do not scatter they stay as they are. A delay that is fitted would otherwise follow
    the scatter: between rows it is averaged, so that half a row's delay always fits better.
    """
    if len(values) < 3:
        return values
    bends = np.abs(np.diff(values, 2))
    if not np.median(bends) > SCATTERS * float(np.ptp(values)):
        return values
    width = time[2:] - time[:-2]
    share = np.where(width > 0.0, (time[1:-1] - time[:-2]) / np.where(width > 0.0, width, 1.0), 0.5)
    found = values.copy()
    found[1:-1] = 0.5 * (values[1:-1] + (1.0 - share) * values[:-2] + share * values[2:])
    return found


def engagements(load: Array, largest: float) -> NDArray[np.int64]:
    """Return which engagement each point belongs to, from 1; 0 where the pack is open.

    One begins where the load rises above a tenth of ``largest``, at the last point before with
    less than half of that, and ends where it falls below half of that again.

    Examples
    --------
    >>> engagements(np.array([0.0, 0.0, 2.0, 9.0, 0.0, 0.0, 10.0]), 10.0).tolist()
    [0, 1, 1, 1, 0, 2, 2]
    """
    found = np.zeros(len(load), np.int64)
    count, inside = 0, False
    for i, force in enumerate(load.tolist()):
        if not inside and force > ON * largest:
            count, inside = count + 1, True
            k = i
            while k > 0 and found[k - 1] == 0 and load[k] > OFF * largest:
                k -= 1
            found[k:i] = count
        elif inside and force < OFF * largest:
            inside = False
        if inside:
            found[i] = count
    return found


def _cells(distinct: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    """Return the first rows of at most ``most`` groups of as many times each."""
    n = len(distinct)
    k = min(n, most)
    return distinct[(np.arange(k) * n) // k]


def _followed(
    piece: Recording, starts: NDArray[np.int64], scatter: dict[str, float], most: int
) -> NDArray[np.int64]:
    """Return the first rows of ``most`` groups of cells, narrower where the columns move."""
    size = np.diff(np.append(starts, len(piece.time)))
    moved = np.zeros(len(starts))
    for name, x in {**piece.inputs, **piece.outputs}.items():
        means, counts = _known_means(x, starts)
        means = np.where(counts > 0.0, means, 0.0)
        noise = 3.0 * scatter[name] * np.sqrt(2.0 / size[1:])
        step = np.maximum(np.abs(np.diff(means)) - noise, 0.0)
        if step.sum() > 0.0:
            moved[1:] += step / step.sum()
            moved[:-1] += step / step.sum()
    lasts = np.diff(np.append(piece.time[starts], piece.time[-1]))
    share = EVEN * lasts / max(float(lasts.sum()), 1e-300)
    if moved.sum() > 0.0:
        share += (1.0 - EVEN) * moved / moved.sum()
    passed = np.concatenate([[0.0], np.cumsum(share)])
    places = np.searchsorted(passed, passed[-1] * np.arange(most) / most, "right") - 1
    return np.asarray(starts[np.unique(np.clip(places, 0, len(starts) - 1))])


def _known_means(x: Array, starts: NDArray[np.int64]) -> tuple[Array, Array]:
    """Return means over the groups, NaN where nothing is known, and the rows behind each."""
    known = np.isfinite(x)
    counts = np.add.reduceat(known.astype(float), starts)
    sums = np.add.reduceat(np.where(known, x, 0.0), starts)
    return np.where(counts > 0.0, sums / np.maximum(counts, 1.0), np.nan), counts
