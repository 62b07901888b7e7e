"""Fit of a growing or decaying oscillation to an interval of a signal."""

from typing import NamedTuple

import numpy as np

from ...numerics.jit import Array

TURNS = 30
ENOUGH = 1e-10  # of the frequency: smaller changes end the iteration
LEAST_SHARE = 0.5  # of what the trend leaves that an oscillation has to explain


class Oscillation(NamedTuple):
    """exp(growth t) (cosine cos(w t) + sine sin(w t)) about a trend, t from the middle."""

    growth: float  # [1/s]
    frequency: float  # [rad/s]
    cosine: float
    sine: float
    middle: float  # [s]
    share: float  # [-] of what the trend leaves: 1 is a perfect oscillation

    @property
    def amplitude(self) -> float:
        """Of the oscillation in the middle of the interval."""
        return float(np.hypot(self.cosine, self.sine))

    def values(self, time: Array) -> Array:
        """Return the oscillation itself, without the trend, at times [s]."""
        t = time - self.middle
        waves = _waves(t, complex(self.growth, self.frequency))
        return np.asarray(waves @ [self.cosine, self.sine])


def fit_oscillation(
    time: Array, values: Array, growth: float, frequency: float
) -> Oscillation | None:
    """Return the oscillation about a parabola that fits best; None if there is none near the guess.

    Growth and frequency by Gauss and Newton, the amplitudes and the trend by least squares in
    every turn (variable projection).
    """
    middle = 0.5 * float(time[0] + time[-1])
    t = time - middle
    half = 0.5 * float(time[-1] - time[0])
    trend = np.vander(t / half, 3)
    rest = values - trend @ np.linalg.lstsq(trend, values, rcond=None)[0]
    size = float(rest @ rest)
    at = complex(growth, frequency)
    if size == 0.0:
        return None
    for _ in range(TURNS):
        waves = _waves(t, at)
        basis = np.hstack([waves, trend])
        found = np.linalg.lstsq(basis, values, rcond=None)[0]
        left = values - basis @ found
        p, q = found[:2]
        by_growth, by_frequency = t * (waves @ [p, q]), t * (waves @ [q, -p])
        slopes = np.column_stack([by_growth, by_frequency])
        slopes -= basis @ np.linalg.lstsq(basis, slopes, rcond=None)[0]
        change = np.linalg.lstsq(slopes, left, rcond=None)[0]
        at += complex(*change)
        if not 0.3 * frequency < at.imag < 3.0 * frequency or abs(at.real) > frequency:
            return None
        if np.hypot(*change) < ENOUGH * frequency:
            break
    share = 1.0 - float(left @ left) / size
    if share < LEAST_SHARE:
        return None
    return Oscillation(at.real, at.imag, float(p), float(q), middle, share)


def _waves(t: Array, at: complex) -> Array:
    """Return the two columns of the oscillation."""
    fade = np.exp(at.real * t)
    return np.column_stack([fade * np.cos(at.imag * t), fade * np.sin(at.imag * t)])
