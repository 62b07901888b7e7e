"""An involute spur pair: where contact starts, what slides there, what the whole mesh loses.

Positions on the line of action are counted from the pinion's base tangent point (0) to the gear's
(1); the pitch point lies at 1/(1 + ratio). The pinion drives.
"""

import math

from ._jit import kernel


@kernel
def start_of_contact(ratio: float, teeth: float, angle: float, addendum: float) -> float:
    """Return the position x_s [-] where contact starts: the gear's addendum circle cuts the line.

    ``ratio`` gear over pinion teeth, ``teeth`` of the pinion, pressure ``angle`` [rad],
    ``addendum`` over module. Not above 0: the tip of the gear meets no involute (interference).
    """
    base = ratio * math.cos(angle)
    tip = ratio + 2.0 * addendum / teeth
    return 1.0 - math.sqrt(tip * tip - base * base) / ((1.0 + ratio) * math.sin(angle))


@kernel
def least_teeth(ratio: float, angle: float, addendum: float) -> float:
    """Return the (real) number of pinion teeth at which x_s = 0."""
    s = math.sin(angle) * math.sin(angle) * (1.0 + 2.0 * ratio)
    return 2.0 * addendum * (ratio + math.sqrt(ratio * ratio + s)) / s


@kernel
def slide_roll(ratio: float, start: float) -> float:
    """Return sliding speed over mean rolling speed [-], 2 |V2 - V1|/(V1 + V2), at ``start``."""
    slide = abs(1.0 - (1.0 + ratio) * start)
    return 2.0 * slide / (1.0 + (ratio - 1.0) * start)


@kernel
def path_lengths(
    ratio: float, teeth: float, angle: float, addendum: float, start: float
) -> tuple[float, float]:
    """Return (approach, recess): the path before and after the pitch point, in base pitches."""
    line = 0.5 * teeth * (1.0 + ratio) * math.sin(angle)  # C sin(angle) over module
    pitch = math.pi * math.cos(angle)
    approach = (1.0 / (1.0 + ratio) - start) * line / pitch
    tip, base = 0.5 * teeth + addendum, 0.5 * teeth * math.cos(angle)
    recess = (math.sqrt(tip * tip - base * base) - 0.5 * teeth * math.sin(angle)) / pitch
    return approach, recess


@kernel
def _moment(low: float, high: float) -> float:
    """Return the integral of |s| from ``low`` to ``high``."""
    return 0.5 * (high * abs(high) - low * abs(low))


@kernel
def loss_factor(ratio: float, teeth: float, approach: float, recess: float) -> float:
    """Return H_v [-]: the power lost over the power transmitted, for a friction coefficient of 1.

    Mean over the path of contact when the pairs in contact share the load equally, at any time as
    many as there are: for a contact ratio e from 1 to 2, with the pitch point where one pair is
    alone, it is Ohlendorf's pi (M + 1)/(N M) (1 - e + e1^2 + e2^2).
    """
    whole = math.floor(approach + recess)
    more = approach + recess - whole  # stretch of a pitch with one pair more than `whole`
    total = 0.0
    for k in range(int(min(whole, 100.0)) + 1):
        low = -approach + k
        total += _moment(low, low + more) / (whole + 1.0)
        if k < whole:
            total += _moment(low + more, low + 1.0) / max(whole, 1.0)
    return 2.0 * math.pi * (ratio + 1.0) / (teeth * ratio) * total
