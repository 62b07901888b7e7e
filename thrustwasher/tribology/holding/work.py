# mypy: disable-error-code="no-any-return"
"""The work that the shafts do to a unit between them."""

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M
from .memory import Coupling
from .plant import N_AGES
from .torque import age_of, inertia_of


@kernel
def work_done(coupling: Coupling, mem: Array, slip: float) -> float:
    """Return what the shafts did to the pack since the start [J], now that the slip is known.

    It is kept for all ages side by side, for the one that turns out to be true.
    """
    turned = 0.0
    if mem[M.COUNT] > 0.0:
        turned = 0.5 * (mem[M.SLIP] + slip) * mem[M.STEP]
    for d in range(N_AGES):
        mem[np.uintp(M.WORK + d)] += mem[np.uintp(M.TORQUE + d)] * turned
    return mem[np.uintp(M.WORK + max(age_of(coupling, mem), 0))]


@kernel
def work_foreseen(coupling: Coupling, mem: Array, slip: float, h: float, torque: float) -> float:
    """Return what they will do over a step of ``h`` [s] in which ``torque`` is given [J]."""
    age, inertia = age_of(coupling, mem), inertia_of(coupling, mem)
    acting = torque if age <= 0 else mem[np.uintp(M.TORQUE + age - 1)]
    change = 0.0
    if mem[M.COUNT] > 0.0:
        change = (slip - mem[M.SLIP]) / mem[M.STEP] * h
        if inertia > 0.0:
            change -= (acting - mem[np.uintp(M.TORQUE + max(age, 0))]) / inertia * h
    change = min(abs(slip), max(-abs(slip), change))  # a short step says little of a long one
    return acting * (slip + 0.5 * change) * h
