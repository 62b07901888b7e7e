"""Slips that a host prescribes: each returns slip and capacity of every step."""

from __future__ import annotations

import math

import numpy as np

from .sensors import TWELVE_BIT

Array = np.ndarray
Pair = tuple[Array, Array]
SIZE = (0.1, 50.0)  # rad/s


def _size(rng: np.random.Generator) -> float:
    return float(math.exp(rng.uniform(*map(math.log, SIZE))))


def _period(rng: np.random.Generator) -> float:
    """Return steps in a period."""
    return float(math.exp(rng.uniform(math.log(6), math.log(200))))


def sine(rng: np.random.Generator, n: int) -> Array:
    """6 to 200 samples in a period, any phase."""
    return _size(rng) * np.sin(2 * np.pi * (np.arange(n) / _period(rng) + rng.random()))


def round_sine(rng: np.random.Generator, n: int) -> Array:
    """Repeat values: a whole number of samples in a period."""
    period = int(rng.integers(6, 41))
    return _size(rng) * np.sin(2 * np.pi * (np.arange(n) % period + rng.random()) / period)


def chirp(rng: np.random.Generator, n: int) -> Array:
    """From 300 to 6 samples in a period, up or down."""
    k = np.arange(n)
    rate = np.geomspace(1 / 300, 1 / 6, n)
    if rng.random() < 0.5:
        rate = rate[::-1]
    return _size(rng) * np.sin(2 * np.pi * (np.cumsum(rate) + rng.random()) + 0 * k)


def pwm(rng: np.random.Generator, n: int) -> Array:
    """Two levels with any duty."""
    phase = (np.arange(n) / _period(rng) + rng.random()) % 1.0
    high = _size(rng)
    low = high * rng.choice([-1.0, 0.0, rng.uniform(-1, 1)])
    return np.where(phase < rng.uniform(0.1, 0.9), high, low)


def triangle(rng: np.random.Generator, n: int) -> Array:
    """Slopes up and down, as deceleration at a constant torque looks like."""
    phase = (np.arange(n) / _period(rng) + rng.random()) % 1.0
    return _size(rng) * (4 * np.abs(phase - 0.5) - 1)


def white(rng: np.random.Generator, n: int) -> Array:
    return _size(rng) * rng.standard_normal(n)


def walk(rng: np.random.Generator, n: int) -> Array:
    return _size(rng) * (rng.uniform(-1, 1) + np.cumsum(rng.standard_normal(n)) / 30)


def ornstein(rng: np.random.Generator, n: int) -> Array:
    """Return an Ornstein-Uhlenbeck process of 3 to 100 steps."""
    keep = math.exp(-1 / math.exp(rng.uniform(math.log(3), math.log(100))))
    kicks = rng.standard_normal(n) * math.sqrt(1 - keep**2)
    found, value = np.empty(n), rng.standard_normal()
    for k in range(n):
        value = keep * value + kicks[k]
        found[k] = value
    return _size(rng) * found


def stop(rng: np.random.Generator, n: int) -> Array:
    """Fall to zero and rest there with noise."""
    size, steps = _size(rng), rng.integers(30, n // 2)
    falls = size * np.maximum(0.0, 1 - np.arange(n) / steps)
    return falls + size * math.exp(rng.uniform(math.log(1e-4), math.log(3e-2))) * (
        rng.standard_normal(n)
    )


def stop_quantised(rng: np.random.Generator, n: int) -> Array:
    quantum = rng.choice([0.1, TWELVE_BIT])
    return quantum * np.round((stop(rng, n) + 0.3 * quantum * rng.standard_normal(n)) / quantum)


def about_mean(rng: np.random.Generator, n: int) -> Array:
    """Ripple about a mean, so that nothing reverses."""
    wave = sine(rng, n)
    return wave + np.abs(wave).max() * rng.uniform(1.05, 3.0)


def controlled(rng: np.random.Generator, n: int) -> Array:
    """Bring the slip to 5 % of the first and keep it there, with noise."""
    size, lag = _size(rng), rng.uniform(20, 200)
    return size * (0.05 + 0.95 * np.exp(-np.arange(n) / lag) + 1e-3 * rng.standard_normal(n))


TRACES = {
    "sine": sine,
    "sine, whole samples": round_sine,
    "chirp": chirp,
    "PWM": pwm,
    "triangle": triangle,
    "white noise": white,
    "random path": walk,
    "Ornstein-Uhlenbeck": ornstein,
    "stop, rest with noise": stop,
    "stop, rest, quantised": stop_quantised,
    "about a mean": about_mean,
    "controlled": controlled,
}


def rippling(slip: Array, rng: np.random.Generator) -> Array:
    """Return a share of the load that ripples at the frequency of a sine of slip."""
    scale = np.abs(slip).max()
    quarter = np.gradient(slip)
    quarter *= scale / max(np.abs(quarter).max(), 1e-300)
    angle = rng.uniform(0, 2 * math.pi)
    wave = (math.cos(angle) * slip + math.sin(angle) * quarter) / scale
    return 1.0 + rng.uniform(0.1, 0.9) * wave / max(1.0, np.abs(wave).max())
