"""Whether residuals scatter from row to row, or hang together in time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....numerics.jit import Array

CHANCE = 1e-4  # probability below which runs of one sign are no chance
LEAST = 10  # residuals of a recording that tell a correlation
MATERIAL = 0.01  # of an output's span: less of a pattern is not worth a warning


@dataclass(frozen=True, slots=True)
class Pattern:
    """Residuals of one output in the order of time."""

    output: str
    runs: int  # stretches of one sign
    expected: float  # such stretches if the residuals were independent
    p_value: float  # probability of so few of them by chance
    size: float  # [SI] root mean square of what neighbouring residuals have in common
    span: float  # [SI] of the measured values
    chi_square: float | None
    """Mean square of the residuals over their standard deviation; None: that is not known."""

    @property
    def is_found(self) -> bool:
        """True if the model has another time history than the recording."""
        return self.p_value < CHANCE and self.size > MATERIAL * self.span


def lag_one(parts: Sequence[Array]) -> float:
    """Return the correlation of each residual with the next one, over all parts; 0 of too few.

    Examples
    --------
    >>> round(lag_one([np.sin(np.linspace(0.0, 6.0, 60))]), 2), lag_one([np.ones(3)])
    (1.0, 0.0)
    """
    known = [part for part in parts if len(part) > LEAST]
    square = sum(float(part @ part) for part in known)
    both = sum(float(part[1:] @ part[:-1]) * len(part) / (len(part) - 1.0) for part in known)
    return min(both / square, 1.0) if square > 0.0 else 0.0


def pattern_of(
    output: str, residuals: Sequence[Array], measured: Sequence[Array], deviation: Array | None
) -> Pattern:
    """Return how an output's residuals follow each other.

    Parameters
    ----------
    output : its name
    residuals : of each recording, in the order of time [SI]
    measured : values of each recording [SI]
    deviation : (n,) standard deviations of all values, if known

    Notes
    -----
    Source: the runs test of Wald & Wolfowitz (1940), normal approximation, one-sided: few runs.
    The size is that of the covariance of neighbours, which independent scatter does not have.

    Examples
    --------
    >>> t = np.linspace(0.0, 1.0, 60)
    >>> pattern_of("torque", [np.sin(6.0 * t)], [10.0 * t], None).is_found
    True
    >>> pattern_of("torque", [(-1.0) ** np.arange(60)], [10.0 * t], None).is_found
    False
    """
    from scipy.stats import norm

    found, expected, variance, together, pairs = 0, 0.0, 0.0, 0.0, 0
    for part in residuals:
        above = part > 0.0
        n, plus = len(part), int(np.count_nonzero(above))
        if n < 2:
            continue
        found += 1 + int(np.count_nonzero(above[1:] != above[:-1]))
        mean = 1.0 + 2.0 * plus * (n - plus) / n
        # all of one sign: nothing to expect of this part but what halves would give
        mean = mean if 0 < plus < n else 1.0 + 0.5 * n
        expected += mean
        variance += max((mean - 1.0) * (mean - 2.0) / (n - 1.0), 0.0)
        together += float(part[1:] @ part[:-1])
        pairs += n - 1
    score = (found - expected + 0.5) / max(variance, 1e-300) ** 0.5 if pairs else 0.0
    off = np.concatenate(list(residuals))
    known = deviation is not None and len(off) > 0
    return Pattern(
        output=output,
        runs=found,
        expected=expected,
        p_value=float(norm.cdf(score)) if variance else 1.0,
        size=float(np.sqrt(max(together / max(pairs, 1), 0.0))),
        span=float(np.ptp(np.concatenate(list(measured)))),
        chi_square=float(np.mean((off / deviation) ** 2)) if known else None,
    )
