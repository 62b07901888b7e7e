"""inertia v' = force - leak v, x' = v; exact while the force is held."""

import math

from thrustwasher.numerics.jit import kernel

N_PARAM, NPAR = 5, 5
NINP, NSTATE, NWORK, NOUT, NIOUT = 1, 3, 1, 2, 1


@kernel
def derive(par):
    return 0


@kernel
def step(par, inp, state, work, out, iout, t, dt):
    inertia, leak = par[0], par[1]
    x, v = (state[1], state[2]) if state[0] != 0.0 else (par[2], par[3])
    if leak == 0.0:
        rate = inp[0] / inertia
        x, v = x + dt * (v + 0.5 * dt * rate), v + dt * rate
    else:
        goal, gone = inp[0] / leak, -math.expm1(-leak * dt / inertia)
        x += goal * dt + (v - goal) * gone * inertia / leak
        v += (goal - v) * gone
    out[0], out[1] = x, v
    iout[0] = 0
    if dt > 0.0:
        state[0], state[1], state[2] = 1.0, x, v
    return 0


@kernel
def sens(par, inp, state, work, seed, dout):
    dout[0], dout[1] = 0.0, 0.0
    return 0
