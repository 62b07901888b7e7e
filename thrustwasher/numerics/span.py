"""The ends of a range, which belong to it."""

import math

ULPS = 8  # units in the last place, of the end that is larger
SHARE = 1e-9  # of the range, at most


def within(low: float, high: float, value: float) -> float:
    """Return a number; the end of the range in place of one that only rounding put outside.

    -40 degC typed in a unit of one's own may come as 233.14999999999998 K. Other numbers, and
    those that are not finite, come back as they are. C code of FMUs does the same.

    Examples
    --------
    >>> within(233.15, 473.15, 233.14999999999998), within(233.15, 473.15, 233.149)
    (233.15, 233.149)
    """
    if low <= value <= high or not math.isfinite(value):
        return value
    end = low if value < low else high
    known = math.isfinite(high - low)
    scale = max(abs(low), abs(high)) if known else abs(end)
    room = ULPS * math.ulp(1.0) * scale
    return end if abs(value - end) <= min(room, SHARE * (high - low)) else value
