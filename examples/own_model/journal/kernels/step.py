"""One step of a plain journal bearing."""

import math

import numpy as np
from numpy.typing import NDArray

from thrustwasher.numerics.jit import Array, kernel
from thrustwasher.numerics.status import BAD_INPUT, OK, OUTSIDE_VERIFIED

P_RADIUS, P_WIDTH, P_CLEARANCE, P_VISCOSITY, P_FIDELITY, D_DRAG, D_LIFT = range(7)
N_PARAM, NPAR = 5, 7
NINP, NSTATE, NWORK, NOUT, NIOUT = 3, 0, 1, 3, 1
CONCENTRIC = 0.5  # eccentricity up to which Petroff's torque is valid
HALVINGS = 50


@kernel
def derive(par: Array) -> int:
    """Fill in what is the same for all steps."""
    radius, width, clearance = par[P_RADIUS], par[P_WIDTH], par[P_CLEARANCE]
    par[D_DRAG] = 2.0 * math.pi * par[P_VISCOSITY] * radius**3 * width / clearance
    par[D_LIFT] = par[P_VISCOSITY] * radius * width**3 / (4.0 * clearance**2)
    return OK


@kernel
def eccentricity(load: float) -> float:
    """Return the eccentricity of a short bearing under a dimensionless load.

    DuBois and Ocvirk 1953: load = e sqrt(16 e^2 + pi^2 (1 - e^2))/(1 - e^2)^2.
    """
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        e = 0.5 * (low + high)
        rest = 1.0 - e * e
        if e * math.sqrt(16.0 * e * e + math.pi**2 * rest) < load * rest * rest:
            low = e
        else:
            high = e
    return low


@kernel
def step(
    par: Array,
    inp: Array,
    state: Array,
    work: Array,
    out: Array,
    iout: NDArray[np.int32],
    t: float,
    dt: float,
) -> int:
    """Fill the outputs; return 0 or the status of a failure."""
    load, speed, oil = inp[0], inp[1], inp[2]
    if not (math.isfinite(load) and math.isfinite(speed) and oil > 0.0):
        iout[0] = BAD_INPUT
        return BAD_INPUT
    e = eccentricity(abs(load) / max(par[D_LIFT] * abs(speed), 1e-300))
    out[0] = par[D_DRAG] * speed
    out[1] = oil
    out[2] = par[P_CLEARANCE] * (1.0 - e)
    iout[0] = OUTSIDE_VERIFIED if e > CONCENTRIC else OK
    return OK
