"""The profile of a shift command: a ramp between two values, a function of time alone."""

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array, kernel
from ...numerics.status import OK

IntArray = NDArray[np.int32]

# places: P_ of parameters
P_START, P_DURATION, P_BEFORE, P_AFTER, P_LEAD, P_FIDELITY, N_PARAM = range(0, 7)
# end of places
RUN_START = N_PARAM  # in `par`: the time [s] that the ramp's counts from, put in by the shell
NPAR = RUN_START + 1
NINP, NSTATE, NWORK, NOUT, NIOUT = 0, 0, 1, 1, 1


@kernel
def derive(par: Array) -> int:
    """There is nothing to prepare."""
    return OK


@kernel
def step(
    par: Array,
    inp: Array,
    state: Array,
    work: Array,
    out: Array,
    iout: IntArray,
    t: float,
    dt: float,
) -> int:
    """Give the command at the end of the step, ``lead`` ahead of time."""
    begin, duration = par[RUN_START] + par[P_START], par[P_DURATION]
    before, after = par[P_BEFORE], par[P_AFTER]
    time = t + dt + par[P_LEAD]
    value = before
    if time >= begin + duration and time > begin:
        value = after
    elif time > begin:
        value = before + (after - before) * ((time - begin) / duration)
    out[0] = value
    iout[0] = OK
    return OK
