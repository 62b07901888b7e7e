"""A load above 9000 N does not converge, a speed of 777 rad/s gives NaN, 500 K is advice HOT."""

import math

from thrustwasher.numerics.jit import kernel

N_PARAM, NPAR = 7, 8
NINP, NSTATE, NWORK, NOUT, NIOUT = 3, 3, 16, 4, 3


@kernel
def derive(par):
    par[7] = 0.5 * (par[0] + par[1]) * par[3]
    return 0


@kernel
def step(par, inp, state, work, out, iout, t, dt):
    load, speed, oil = inp[0], inp[1], inp[2]
    coefficient = 0.1 if par[5] > 1.5 else 0.05 + 0.001 * abs(speed)
    torque = par[7] * load * coefficient * math.tanh(speed)
    rise, energy = state[0], state[1]
    n = 10 if par[6] > 1.5 else 1
    for _ in range(n):
        rise += dt / n * (abs(torque * speed) - 5.0 * rise) / par[2]
    if dt > 0.0:
        energy += dt * torque * speed
    work[0] += torque
    out[0], out[1], out[2], out[3] = torque, oil + rise, rise, energy
    iout[0] = 1 if abs(speed) > 50.0 else 2
    iout[1] = 1 if rise > 200.0 else 0
    iout[2] = 2 if rise > 200.0 else 0
    if load > 9000.0:
        out[0], state[0] = 1e30, 1e30
        return 10
    if speed == 777.0:
        out[0] = math.nan
        return 0
    if dt > 0.0:
        state[0], state[1], state[2] = rise, energy, state[2] + 1.0
    return 0
