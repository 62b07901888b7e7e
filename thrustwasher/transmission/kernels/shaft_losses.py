# mypy: disable-error-code="no-any-return"
"""What losses from outside take from the shafts: bearings, churning, pump and seals.

Their torques arrive as sizes. Each acts against the motion of its own shaft and passes through zero
with its speed, so that it only ever takes energy and moves no shaft that stands.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import layout as L

SLOW = 1.0  # rad/s: a torque passes through zero over it


@kernel
def spread_losses(
    par: Array, work: Array, y: int, on_shafts: tuple[float, float, float, float]
) -> tuple[float, float, float]:
    """Return what torques take from driven gear and carrier, and from the driven gear's own shaft.

    ``on_shafts``: sizes [N m] against input, drum, output and, of all together, planets; speeds lie
    in ``work[y:]``. Drum and planets pass theirs on by the teeth.
    """
    r, spin = par[L.D_RATIO], par[L.D_SPIN]
    driven, carrier = work[np.uintp(y + L.Y_INPUT)], work[np.uintp(y + L.Y_CARRIER)]
    own = on_shafts[0] * math.tanh(driven / SLOW)
    drum = on_shafts[1] * math.tanh(((1.0 + r) * carrier - driven) / r / SLOW)
    output = on_shafts[2] * math.tanh(carrier / SLOW)
    planets = on_shafts[3] * math.tanh(spin * (driven - carrier) / SLOW) * spin
    return own + planets - drum / r, output + drum * (1.0 + r) / r - planets, own + planets


@kernel
def turn_losses(par: Array, work: Array, y: int) -> None:
    """Fill what the losses take at the speeds in ``work[y:]``."""
    sizes = (
        work[L.W_INPUT_LOSS],
        work[L.W_DRUM_LOSS],
        work[L.W_OUTPUT_LOSS],
        work[L.W_PLANET_LOSS],
    )
    driven, carrier, own = spread_losses(par, work, y, sizes)
    work[L.W_LOSS_DRIVEN], work[L.W_LOSS_CARRIER], work[L.W_LOSS_OWN] = driven, carrier, own


@kernel
def loss_power(work: Array, y: int) -> float:
    """Return the heat of the losses [W], after ``turn_losses`` for ``work[y:]``."""
    driven, carrier = work[np.uintp(y + L.Y_INPUT)], work[np.uintp(y + L.Y_CARRIER)]
    return float(work[L.W_LOSS_DRIVEN] * driven + work[L.W_LOSS_CARRIER] * carrier)
