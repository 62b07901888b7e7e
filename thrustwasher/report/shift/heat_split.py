"""Where the heat of a part went: made, stored in its bodies, given to its oil."""

from typing import NamedTuple

import numpy as np

from .shift_record import Array, Record

OWNERS = {
    "clutch": "clutch", "brake": "brake", "washer": "one thrust washer",
    "mesh": "one sun mesh", "ring_mesh": "one ring mesh",
}  # fmt: skip


LEAST_HEAT = 0.1  # J


class HeatSplit(NamedTuple):
    """Heat [J] since the start at every time; what is stored is None where the part does not say.

    What is made is neither stored nor given where the part warms up without saying it, and to the
    error of integrating over steps.
    """

    words: str
    made: Array
    stored: Array | None
    to_oil: Array

    @property
    def rest(self) -> Array:
        """What was made less what is known of it."""
        return np.asarray(self.made - self.to_oil - (0.0 if self.stored is None else self.stored))


def heat_split(record: Record, part: str) -> HeatSplit | None:
    """Return the heat of a part; None if the run does not know it.

    A part that stores heat gives its oil's heat as the mean of each step, others as that of the
    moment.
    """
    given, power = record.series(f"{part}.oil_heat"), record.series(f"{part}.friction_power")
    stored = record.series(f"{part}.stored_heat")
    if given is None or power is None:
        return None
    step = np.diff(record.time)
    oil = given[1:] * step if stored is not None else _trapezia(given, step)
    made = record.series(f"{part}.energy")
    return HeatSplit(
        OWNERS[part], _sum(_trapezia(power, step)) if made is None else made - made[0], stored,
        _sum(oil),
    )  # fmt: skip


def heat_splits(record: Record) -> list[HeatSplit]:
    """Return the heat of every part that makes more than LEAST_HEAT."""
    found = (heat_split(record, part) for part in OWNERS)
    return [split for split in found if split is not None and split.made[-1] > LEAST_HEAT]


def _trapezia(values: Array, step: Array) -> Array:
    return np.asarray(0.5 * (values[1:] + values[:-1]) * step)


def _sum(pieces: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(pieces)))
