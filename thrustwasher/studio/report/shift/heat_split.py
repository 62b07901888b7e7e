"""Where the heat of a part went: made, stored in its bodies, given to its oil."""

from typing import NamedTuple

import numpy as np

from ....shift.account.shift_record import Array, Record

OWNERS = {
    "clutch": "clutch",
    "brake": "brake",
    "washer": "one thrust washer",
    "mesh": "one sun mesh",
    "ring_mesh": "one ring mesh",
}


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

    A part that stores heat gives its powers as the means of each step, others as those of the
    moment.
    """
    given, power = record.series(f"{part}.oil_heat"), record.series(f"{part}.friction_power")
    stored = record.series(f"{part}.stored_heat")
    if given is None or power is None:
        return None
    step, made = np.diff(record.time), record.series(f"{part}.energy")

    def total(power: Array) -> Array:
        mean = power[1:] if stored is not None else 0.5 * (power[1:] + power[:-1])
        return np.concatenate(([0.0], np.cumsum(mean * step)))

    return HeatSplit(
        OWNERS[part], total(power) if made is None else made - made[0], stored, total(given)
    )


def heat_splits(record: Record) -> list[HeatSplit]:
    """Return the heat of every part that makes more than LEAST_HEAT."""
    found = [heat_split(record, part) for part in OWNERS]
    bearings = record.series("transmission.bearing_heat")
    if bearings is not None:  # whose heat is the oil's at once
        found.append(HeatSplit("thrust bearings of sun and ring", bearings, None, bearings))
    losses = record.series("transmission.loss_heat")
    if losses is not None and "losses.oil_heat" in record.signals:
        words = "oil pump, churning, bearings, seals"
        found.append(HeatSplit(words, losses, None, losses))
    return [split for split in found if split is not None and split.made[-1] > LEAST_HEAT]
