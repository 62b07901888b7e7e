"""Corners rounded to one continuous derivative; exact outside the rounded stretch."""

import math

from .jit import kernel


@kernel
def sign_of(x: float) -> float:
    """Return the slope of |x|: -1 or 1, and 0, the middle of both, at x = 0."""
    return 0.0 if x == 0.0 else math.copysign(1.0, x)


@kernel
def floored(x: float, floor: float) -> float:
    """Return |x|, and no less than ``floor`` > 0 near x = 0: floor + x^2/(4 floor) below 2 floor.

    Even and smooth through x = 0; from 2 floor on it is |x| itself.
    """
    size = abs(x)
    return size if size >= 2.0 * floor else floor + size * size / (4.0 * floor)


@kernel
def floored_slope(x: float, floor: float) -> float:
    """Return the slope of ``floored`` over x."""
    return sign_of(x) if abs(x) >= 2.0 * floor else 0.5 * x / floor


@kernel
def soft_size(x: float, width: float) -> float:
    """Return |x| with its corner rounded over |x| < ``width``; 0 with slope 0 at x = 0."""
    s = abs(x) / width
    return abs(x) if s >= 1.0 else width * s * s * (2.0 - s)


@kernel
def soft_size_slope(x: float, width: float) -> float:
    """Return the slope of ``soft_size`` over x."""
    s = abs(x) / width
    return sign_of(x) if s >= 1.0 else x / width * (4.0 - 3.0 * s)


@kernel
def soft_least(a: float, b: float, width: float) -> tuple[float, float]:
    """Return min(a, b) and its slope over a; rounded where they differ by less than ``width`` > 0.

    The rounded value is lower than the sharp one, at most by width/4.
    """
    if a <= b - width:
        return a, 1.0
    if a >= b + width:
        return b, 0.0
    rest = b + width - a
    return b - rest * rest / (4.0 * width), 0.5 * rest / width


@kernel
def soft_most(a: float, b: float, width: float) -> tuple[float, float]:
    """Return max(a, b) and its slope over a; rounded as ``soft_least``, up by width/4 at most."""
    least, slope = soft_least(-a, -b, width)
    return -least, slope


@kernel
def smoothstep(z: float) -> float:
    """Return 0 below z = 0, 1 above z = 1 and z^2 (3 - 2 z) between."""
    s = min(max(z, 0.0), 1.0)
    return s * s * (3.0 - 2.0 * s)


@kernel
def smoothstep_slope(z: float) -> float:
    """Return the slope of ``smoothstep`` over z."""
    s = min(max(z, 0.0), 1.0)
    return 6.0 * s * (1.0 - s)
