"""force = -(stiffness x + slope v), at once."""

from thrustwasher.numerics.jit import kernel

N_PARAM, NPAR = 3, 3
NINP, NSTATE, NWORK, NOUT, NIOUT = 2, 1, 1, 1, 1


@kernel
def derive(par):
    return 0


@kernel
def step(par, inp, state, work, out, iout, t, dt):
    out[0] = -(par[0] * inp[0] + par[1] * inp[1])
    iout[0] = 0
    return 0


@kernel
def sens(par, inp, state, work, seed, dout):
    dout[0] = -(par[0] * seed[0] + par[1] * seed[1])
    return 0
