"""Rung `stribeck` of the washer: wedge in closed form, oil as warm as the film itself makes it."""

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_simple import simple_sens, simple_step

Array = NDArray[np.float64]


@kernel
def stribeck_step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: NDArray[np.int32],
    t: float, dt: float,
) -> int:  # fmt: skip
    """Solve at the present inputs; see washer_step. ``state`` stays as it is: no memory."""
    return simple_step(True, par, inp, work, out, iout)


@kernel
def stribeck_sens(
    par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array
) -> int:
    """Fill ``dout`` with the derivative of the outputs along ``seed``; see washer_step."""
    return simple_sens(True, par, inp, work, seed, dout)
