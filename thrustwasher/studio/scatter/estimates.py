"""Quantiles, probabilities and Sobol' indices from the runs of a study, each with its confidence.

Arrays are (N, ...), base points first; those of one scramble follow each other. A value that is
absent (a failed run, a figure that does not exist in this run) is NaN.

Sources: quantiles: Hyndman & Fan 1996, type 5. Their confidence: Woodruff 1952 (bounds of the
probability, read back as quantiles), with the variance between independent scrambles; bounds of a
probability: Wilson 1927 with the number of independent runs that would have that variance (Korn &
Graubard 1998). Order statistics: David & Nagaraja 2003, chapter 7. Indices: Saltelli et al. 2010
(``scipy.stats.sobol_indices``), their
confidence by leaving out one scramble at a time (jackknife).
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .design import SCRAMBLES

Array = NDArray[np.float64]
LEVELS = (0.05, 0.5, 0.95)
CONFIDENCE = 0.95
T = 2.3646242515927844  # Student's t of 7 degrees of freedom at 0.975
FEW = 256  # base points; below, 5 and 95 % have bounds by order statistics
LEAST_BOUNDED = 59  # independent runs of which one is beyond the 5 % quantile, by 95 %
SAME = 1e-9  # standard deviation over largest value below which a figure does not vary


class Bounds(NamedTuple):
    """A confidence interval; an end is infinite where nothing bounds it."""

    low: float
    high: float


def quantiles(values: Array) -> Array:
    """Return the quantiles at ``LEVELS`` of what is not NaN: (3, ...) of (N, ...).

    A run stands for 1/N of the probability, with its value in the middle of that.
    """
    found: Array = np.full((len(LEVELS), *values.shape[1:]), np.nan)
    some = np.isfinite(values).any(0)
    if some.any():
        found[:, some] = np.nanquantile(values[:, some], LEVELS, axis=0, method="hazen")
    return found


def quantile_bounds(values: Array, level: float) -> Bounds:
    """Return the confidence interval of a quantile of (N,) values.

    Those that are NaN may lie at either end: below all others for the lower bound, above for the
    upper.
    """
    low = _bounds(np.where(np.isnan(values), -np.inf, values), level).low
    high = _bounds(np.where(np.isnan(values), np.inf, values), level).high
    return Bounds(low, high)


def probability_bounds(values: Array) -> Bounds:
    """Return the confidence interval of the mean of 0 or 1 (N,); NaN may be either."""
    n = len(values)
    low, high = (_shares(np.where(np.isnan(values), end, values)) for end in (0.0, 1.0))
    return Bounds(
        _wilson(float(low.mean()), _independent(low, n)).low,
        _wilson(float(high.mean()), _independent(high, n)).high,
    )


def _shares(values: Array) -> Array:
    """Return the mean of each scramble (8,)."""
    found: Array = values.reshape(SCRAMBLES, -1).mean(1)
    return found


def _independent(shares: Array, n: int) -> float:
    """Return how many independent runs give a share with the variance of the mean of ``shares``.

    Where the scrambles agree by chance, a share is not known better than to a run.
    """
    share = float(shares.mean())
    if not 0.0 < share < 1.0:
        return float(n)
    error = max(float(shares.std(ddof=1)) / math.sqrt(SCRAMBLES), 1.0 / n)
    return share * (1.0 - share) / error**2


def _wilson(share: float, n: float) -> Bounds:
    """Return the score interval of a share of ``n`` independent runs, within 0 .. 1."""
    middle = share + T**2 / (2.0 * n)
    width = T * math.sqrt(share * (1.0 - share) / n + T**2 / (4.0 * n**2))
    scale = 1.0 + T**2 / n
    return Bounds(max((middle - width) / scale, 0.0), min((middle + width) / scale, 1.0))


def _bounds(values: Array, level: float) -> Bounds:
    """Return the interval of a quantile: two of the values, -inf and inf among them."""
    n, ordered = len(values), np.sort(values)
    there = ordered[min(int(level * n), n - 1)]
    low, high = _wilson(level, _independent(_shares((values <= there) * 1.0), n))
    first, last = int(low * n), int(np.ceil(high * n)) + 1  # from 1 on
    if n < FEW and level != 0.5:
        first, last = order_statistics(n, level)
    return Bounds(float(ordered[max(first, 1) - 1]), float(ordered[min(last, n) - 1]))


def order_statistics(n: int, level: float) -> tuple[int, int]:
    """Return which of ``n`` ordered independent values (from 1 on) bound a quantile.

    With 59 values and more they hold it with a probability of 95 %; with fewer the end beyond 5 or
    95 % is the last value there is.
    """
    from scipy.stats import binom  # late: it takes half a second

    rare, tail = min(level, 1.0 - level), 0.5 * (1.0 - CONFIDENCE)
    first = max(1, int(binom.ppf(tail, n, rare)))
    left = 2.0 * tail - binom.cdf(first - 1, n, rare)
    last = min(n, int(binom.isf(left if left > 0.0 else tail, n, rare)) + 1)
    return (first, last) if level < 0.5 else (n + 1 - last, n + 1 - first)


class Indices(NamedTuple):
    """First and total indices (G, m), NaN without variance; ``left_out`` (m,) base points."""

    first: Array
    total: Array
    left_out: NDArray[np.int64]


def sobol_indices(a: Array, b: Array, ab: Array, keep: NDArray[np.bool_] | None = None) -> Indices:
    """Return the Sobol' indices of ``a`` and ``b`` (N, m), ``ab`` (G, N, m); N a power of two.

    A base point of which a run lacks the figure, or that is not to ``keep``, is left out: all its
    values become the mean of the others, which counts for nothing in any variance.
    """
    from scipy.stats import sobol_indices as saltelli

    sound = np.isfinite(a) & np.isfinite(b) & np.isfinite(ab).all(0)
    there = sound if keep is None else sound & keep[:, None]
    n = np.maximum(there.sum(0), 1)
    middle = (np.where(there, a, 0.0).sum(0) + np.where(there, b, 0.0).sum(0)) / (2 * n)
    a, b, ab = (np.where(there, f, middle) for f in (a, b, ab))
    largest = np.maximum(np.abs(a).max(0), np.abs(b).max(0))
    varies = np.sqrt(0.5 * (a.var(0) + b.var(0))) > SAME * largest
    pad = [0, *range(a.shape[1])]  # scipy drops axes of length one, and fails without any
    values = {"f_A": a.T[pad], "f_B": b.T[pad], "f_AB": ab.transpose(0, 2, 1)[:, pad]}
    found = saltelli(func=values, n=len(a), method=_indices)
    first, total = (
        np.where(varies, order.reshape(len(pad), -1)[1:].T, np.nan)
        for order in (found.first_order, found.total_order)
    )
    return Indices(first, total, (~sound).sum(0))


def _indices(f_A: Array, f_B: Array, f_AB: Array) -> tuple[Array, Array]:
    """Return first and total indices (m, G) of f_A, f_B (m, N), f_AB (G, m, N), all less the mean.

    Saltelli's estimators with control variates: what has a mean of zero by the design, as f_A f_B,
    tells how far the points are from even, and what part of that an index has. Where a rare outcome
    makes the variance, as a lost film, that takes nine tenths of the error.
    """
    square = 0.5 * (f_A**2 + f_B**2)
    variance = square.mean(-1)
    controls = np.stack(
        [
            np.broadcast_to(f_A * f_B, f_AB.shape),
            f_AB**2 - f_A**2,
            np.broadcast_to(f_A - f_B, f_AB.shape),
            f_AB - f_A,
        ],
        axis=-2,
    )  # (G, m, 4, N)
    scale = np.sqrt((controls**2).mean(-1, keepdims=True))
    controls = controls / np.where(scale > 0.0, scale, 1.0)
    inverse = np.linalg.pinv(controls @ controls.swapaxes(-1, -2), rcond=1e-9, hermitian=True)

    def steadied(terms: Array) -> Array:
        index: Array = terms.mean(-1) / variance
        for _ in range(2):
            rest = terms - index[..., None] * square
            share = inverse @ (controls @ rest[..., None])
            at = rest.mean(-1) - (share[..., 0] * controls.mean(-1)).sum(-1)
            index += at / variance
        found: Array = index.T
        return found

    return steadied(f_B * (f_AB - f_A)), steadied(0.5 * (f_A - f_AB) ** 2)


def index_confidence(a: Array, b: Array, ab: Array) -> tuple[Array, Array]:
    """Return half the confidence intervals of first and total indices (G, m).

    Each scramble is left out once: the jackknife's variance is free of the bias that a ratio of
    variances has in one scramble alone.
    """
    of_scramble = np.repeat(np.arange(SCRAMBLES), len(a) // SCRAMBLES)
    parts = [sobol_indices(a, b, ab, of_scramble != k)[:2] for k in range(SCRAMBLES)]
    first, total = T * np.sqrt((SCRAMBLES - 1) * np.var(parts, axis=0))
    return first, total
