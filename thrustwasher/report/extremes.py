"""The worst values of a shift and when they were reached."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .shift_record import Array, Record

TURNING = 1.0  # [rad/s] a washer slower than this needs no film
FILM_SPEED = 10.0  # [rad/s] below, film vanishes with speed and its least value says nothing


class Extreme(NamedTuple):
    """A value in SI units and the time [s] it was reached."""

    value: float
    time: float


def highest(record: Record, name: str) -> Extreme | None:
    """Return the largest value of a signal; None if the run has no such signal."""
    values = record.series(name)
    return None if values is None else _extreme(record, values, int(np.nanargmax(values)))


def lowest(record: Record, name: str) -> Extreme | None:
    """Return the least value of a signal; None if the run has no such signal."""
    values = record.series(name)
    return None if values is None else _extreme(record, values, int(np.nanargmin(values)))


def worst_film(record: Record) -> Extreme | None:
    """Return the washer's least film ratio recorded above FILM_SPEED; None without such a time."""
    values, speed = record.series("washer.film_ratio"), record.series("washer.speed")
    if values is None or speed is None:
        return None
    turning = np.abs(speed) >= FILM_SPEED
    if not np.any(turning):
        return None
    return _extreme(record, values, int(np.argmin(np.where(turning, values, np.inf))))


def distressed(record: Record) -> Array:
    """Return where the washer turns and has lost its film."""
    lost, speed = record.series("washer.distress"), record.series("transmission.washer_speed")
    if lost is None or speed is None:
        return np.zeros(len(record.time), dtype=bool)
    return np.asarray((lost > 0.5) & (np.abs(speed) > TURNING))


def _extreme(record: Record, values: Array, index: int) -> Extreme:
    """Return one value with its time."""
    return Extreme(float(values[index]), float(record.time[index]))
