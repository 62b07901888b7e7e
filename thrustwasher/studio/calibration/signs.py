"""Friction measured on a test rig that turns both ways: its sign against the speed's."""

from collections.abc import Sequence

import numpy as np

from ...errors import ParameterError
from ...numerics.jit import Array

SIGMAS = 3.0  # a value on the wrong side of zero by more than these is no scatter,
SHARE = 0.02  # nor by more than this share of the largest value: zero offset, noise near zero
FASTEST = 100.0  # m/s, a sliding speed that no clutch or thrust washer runs at
PRESSURES = (100.0, 2e8)  # Pa on a face: outside of these no such part is measured
RPM = 9.549296585513721  # of a rad/s


def folded(
    name: str, value: Array, speed: Array, error: Array | None, row: Sequence[int], *, odd: bool
) -> tuple[Array, str]:
    """Return measured friction with the sign that the model gives it, and what was done.

    A test rig that turns both ways records friction with the sign of speed, or its
    size alone; which, the points that turn backwards say by their majority.

    Parameters
    ----------
    name : of the output, for messages
    value : (n,) measured friction, of any unit
    speed : (n,) speed of each value, of any unit
    error : (n,) standard deviations, if known
    row : (n,) places of the points, from 0, for messages
    odd : True if the model's friction has the sign of speed (a torque), False if it is a size (a
        coefficient)

    Raises
    ------
    ParameterError : signs contradict each other by more than 3 standard deviations, and by more
        than 2 % of the largest value where none are known
    """
    back = speed < 0.0
    signed = bool(np.sum(value[back] < 0.0) > 0.5 * np.sum(back))
    size = np.where(back, -value, value) if signed else value
    span = float(np.abs(value).max(initial=0.0))
    allowance = np.full(len(value), SHARE * span)
    if error is not None:
        allowance = np.maximum(allowance, SIGMAS * error)
    if size.mean() > 0.0 and (bad := size < -allowance).any():
        i = int(np.argmax(bad))
        cure = "turn its sign, or leave it out"
        raise ParameterError(
            f"{name}: point {row[i] + 1} is {value[i]:.6g} at a speed of {speed[i]:.6g} rad/s, "
            f"against the sign of the others; {cure}"
        )
    found = np.where(back, -size, size) if odd else size
    changed = int(np.sum(back)) if signed != odd else 0
    if not changed:
        return value, ""
    how = "has the sign of speed, its size was taken" if signed else "was given the sign of speed"
    points = "1 point turns" if changed == 1 else f"{changed} points turn"
    return found, f"{points} backwards: {name} {how}"


def too_fast(speed: Array, radius: float) -> str:
    """Return a warning of sliding speeds [m/s] that no part runs at; "" if there is none.

    ``speed`` [rad/s] of all points, ``radius`` [m] at which they slide.
    """
    most = float(np.abs(speed).max(initial=0.0))
    if most * radius <= FASTEST:
        return ""
    hint = ""
    if most / RPM * radius <= FASTEST:
        hint = f"; if {most:.6g} is in rpm, name the column speed [rpm]"
    return (
        f"speed reaches {most:.6g} rad/s, {most * radius:.3g} m/s of sliding, and no such part "
        f"runs above {FASTEST:g} m/s{hint}"
    )


def odd_pressure(load: Array, area: float) -> str:
    """Return a warning of loads [N] that no face [m2] is measured under; "" if there is none."""
    most = float(np.abs(load).max(initial=0.0))
    low, high = PRESSURES
    if low <= most / area <= high or not most:
        return ""
    side = "is only" if most / area < low else "reaches"
    return (
        f"load {side} {most:.6g} N, {most / area:.3g} Pa on a face, and no such part is measured "
        f"there; if the column is in another unit, name it so: load [kN], pressure [bar]"
    )
