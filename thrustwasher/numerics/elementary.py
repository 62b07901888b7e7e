"""Exponential and logarithm without a branch or a table, for several numbers side by side.

A loop over them becomes arithmetic on groups of numbers, the same on every machine. Both are good
to 1 unit in the last place (tests/core/numerics/test_elementary.py).
"""

import numpy as np

from .jit import inlined, number_of, word_of

LOG2E = 1.4426950408889634
LN2_HIGH, LN2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
ROUND = 6755399441055744.0  # 1.5 2^52: adding it rounds to a whole number, which its low bits hold
TWO52 = 4503599627370496.0
LARGEST = 708.0  # size of an exponent, beyond which it counts as that
_BIAS, _PLACES = np.uint64(1023), np.uint64(52)
_FRACTION = np.uint64((1 << 52) - 1)
_ROOT = np.uint64(0x3FE6A09E00000000)  # about sqrt(1/2): fractions go from it to twice it
_UP = np.uint64(0x3FF0000000000000 - 0x3FE6A09E00000000)
_WHOLE = np.uint64(0x4330000000000000)  # 2^52


@inlined
def straight_exp(x: float) -> float:
    """Return e^x, for x from -LARGEST to LARGEST; beyond, that of the nearest."""
    x = x if x < LARGEST else LARGEST
    x = x if x > -LARGEST else -LARGEST
    shifted = x * LOG2E + ROUND
    n = shifted - ROUND
    r = (x - n * LN2_HIGH) - n * LN2_LOW
    s = r * r
    even = 1.0 / 3628800.0 + s * (1.0 / 479001600.0)
    even = 1.0 / 24.0 + s * (1.0 / 720.0 + s * (1.0 / 40320.0 + s * even))
    odd = 1.0 / 39916800.0 + s * (1.0 / 6227020800.0)
    odd = 1.0 / 120.0 + s * (1.0 / 5040.0 + s * (1.0 / 362880.0 + s * odd))
    tail = (0.5 + s * even) + r * (1.0 / 6.0 + s * odd)
    power = number_of((word_of(shifted) + _BIAS) << _PLACES)
    return power * (1.0 + (r + s * tail))


@inlined
def straight_log(x: float) -> float:
    """Return ln x, for normal x > 0. After Sun's fdlibm, as musl's log1p has it."""
    word = word_of(x) + _UP
    n = number_of((word >> _PLACES) | _WHOLE) - (TWO52 + 1023.0)
    f = number_of((word & _FRACTION) + _ROOT) - 1.0
    half = 0.5 * f * f
    s = f / (2.0 + f)
    z = s * s
    w = z * z
    one = 3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01)
    two = 2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)
    rest = w * one + z * (6.666666666666735130e-01 + w * two)
    return n * LN2_HIGH - ((half - (s * (half + rest) + n * LN2_LOW)) - f)
