"""How it fails: a load above 9000 N is not converged, 777 rad/s gives OK with NaN and a state that
moved, 779 rad/s a defect; the derivative at 5000 N is at a fold; 13 discs cannot be derived."""

import math

from thrustwasher.numerics.jit import kernel

N_PARAM, NPAR = 6, 8
NINP, NSTATE, NWORK, NOUT, NIOUT = 3, 3, 8, 5, 4
SUBSTEPS = 0  # place in work


@kernel
def broken_rule(par):
    if not par[0] < par[1]:
        return 1
    if par[4] > 0.5 and par[5] < 1.5:
        return 2
    return 0


@kernel
def derive(par):
    par[7] = 0.5 * (par[0] + par[1]) * par[3]
    return 14 if par[3] == 13.0 else 0


@kernel
def step(par, inp, state, work, out, iout, t, dt):
    load, speed, oil = inp[0], inp[1], inp[2]
    coefficient = 0.1 if par[5] > 1.5 else 0.05 + 0.001 * abs(speed)
    slope = 0.0 if par[5] > 1.5 else math.copysign(0.001, speed)
    direction = math.tanh(speed)
    torque = par[7] * load * coefficient * direction
    rise, energy = state[0], state[1]
    n = 10 if par[6] > 1.5 else 1
    for _ in range(n):
        rise += dt / n * (abs(torque * speed) - 5.0 * rise) / par[2]
    if dt > 0.0:
        energy += dt * torque * speed
    work[0] = n
    work[1] = par[7] * coefficient * direction
    work[2] = par[7] * load * (slope * direction + coefficient * (1.0 - direction * direction))
    out[0], out[1], out[2], out[3] = torque, oil + rise, rise, energy
    out[4] = 3.0 / (1.0 + load / 1000.0)
    iout[0] = 1 if abs(speed) > 50.0 else 2
    iout[1] = 1 if rise > 200.0 else 0
    iout[2] = int(state[2]) + (1 if dt > 0.0 else 0)
    iout[3] = 2 if rise > 200.0 else 0
    if load > 9000.0:
        out[0], iout[2], work[1] = 1e30, 99, 1e30
        return 10
    if speed == 779.0:
        return 14
    if dt > 0.0:
        state[0], state[1], state[2] = rise, energy, state[2] + 1.0
    if speed == 777.0:
        out[0] = math.nan
    return 0


@kernel
def sens(par, inp, state, work, seed, dout):
    load = inp[0]
    if load == 5000.0:
        return 11
    dout[0] = work[1] * seed[0] + work[2] * seed[1]
    dout[1] = seed[2]
    dout[2], dout[3] = 0.0, 0.0
    dout[4] = -0.003 / (1.0 + load / 1000.0) ** 2 * seed[0]
    return 0
