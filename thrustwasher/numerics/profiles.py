# mypy: disable-error-code="no-any-return"
"""Inputs that run straight within a step: their values at its start, then their rates."""

import numpy as np

from .jit import Array, kernel


@kernel
def rate_of(inp: Array, n: int, i: int) -> float:
    """Return the rate of the i-th of ``n`` inputs [its unit/s]; 0 where none are given."""
    return inp[np.uintp(n + i)] if inp.size >= 2 * n else 0.0


@kernel
def value_at(inp: Array, n: int, i: int, s: float) -> float:
    """Return the i-th of ``n`` inputs ``s`` seconds into the step; without a rate to the bit."""
    rate = rate_of(inp, n, i)
    return inp[np.uintp(i)] if rate == 0.0 else inp[np.uintp(i)] + rate * s
