"""Sensors between a driveline and a unit: quantised, noisy, filtered, held speeds."""

from __future__ import annotations

import math

import numpy as np

RPM = math.pi / 30.0
TWELVE_BIT = 0.488  # rad/s


def quantised(quantum: float):
    """Round both speeds."""
    return lambda t, w1, w2: quantum * (round(w1 / quantum) - round(w2 / quantum))


def noisy(sigma: float, seed: int):
    """Add noise to the slip."""
    rng = np.random.default_rng(seed)
    return lambda t, w1, w2: w1 - w2 + sigma * rng.standard_normal()


def lagging(delay: float):
    """Filter both speeds by a first-order lag [s]."""
    last: list[float] = []

    def seen(t: float, w1: float, w2: float) -> float:
        if not last:
            last[:] = [t, w1, w2]
        keep = math.exp(-(t - last[0]) / delay)
        last[:] = [t, w1 + keep * (last[1] - w1), w2 + keep * (last[2] - w2)]
        return last[1] - last[2]

    return seen


def refreshed(period: float, both: bool):
    """Hold the second speed, or both, over a period [s]."""
    kept = [-1.0, 0.0, 0.0]

    def seen(t: float, w1: float, w2: float) -> float:
        if math.floor(t / period + 1e-6) > kept[0]:
            kept[:] = [math.floor(t / period + 1e-6), w1, w2]
        return (kept[1] if both else w1) - kept[2]

    return seen
