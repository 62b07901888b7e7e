"""Temperatures of three flat bodies in a stack that is heated evenly in one gap."""

from typing import NamedTuple


class StackRise(NamedTuple):
    """Temperature rises [K] above the oil."""

    carrier: float
    washer: float
    gear: float


def stack_rise(
    heat: float, share: float, between_carrier_washer: float, between_washer_gear: float,
    behind_carrier: float, behind_gear: float,
) -> StackRise:  # fmt: skip
    """Return the rises for a heat flow [W/m2] made between carrier and washer.

    ``share`` of it enters the carrier, the rest the washer; resistances in m2 K/W. The heat that
    leaves through the carrier follows from the two parallel ways out.
    """
    by_gear = between_washer_gear + behind_gear
    loop = behind_carrier + between_carrier_washer + by_gear
    out_carrier = heat * (by_gear + share * between_carrier_washer) / loop
    out_gear = heat - out_carrier
    return StackRise(out_carrier * behind_carrier, out_gear * by_gear, out_gear * behind_gear)
