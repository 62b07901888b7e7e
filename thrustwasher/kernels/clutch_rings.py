# mypy: disable-error-code="no-any-return"
"""A pack resolved over its radius: rings with their own slip speed, heat and temperature.

The plates are stiff: one film thickness and one pressure. Each ring is a pack by its own block of
``par`` (clutch_constants); the film is squeezed out against the rings' mean viscosity.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_friction import coefficient_slopes, contact_slopes, viscous_slopes
from .clutch_rates import pack_slopes
from .corners import sign_of
from .roelands import viscosity

Array = NDArray[np.float64]
# places in a ring's part of W_AT: power of a face [W] and its slopes over film ratio, temperature,
# load of the pack, |slip|; slope of the film's rate over the ring's temperature
POWER, POWER_U, POWER_T, POWER_F, POWER_S, RATE_T = range(6)


@kernel
def ring_of(par: Array, k: int) -> Array:
    """Return the k-th ring's block of ``par``."""
    return par[L.D_BLOCKS + k * L.N_PACK : L.D_BLOCKS + (k + 1) * L.N_PACK]


@kernel
def film_moves(par: Array) -> bool:
    """Tell if the film is a state; else it is settled and its shear left out."""
    return par[L.P_FILM_DYNAMICS] != 0.0


@kernel
def surfaces(par: Array, work: Array, base: int, to: int) -> None:
    """Fill ``work[to:]`` with the rings' interface temperatures, or their changes, at ``base``."""
    n = 1 + int(par[L.D_MODES])
    for k in range(int(par[L.D_RINGS])):
        total = 0.0
        for i in range(n):
            total += work[np.uintp(base + L.Z_RINGS + k * L.N_BODY + i)]
        work[np.uintp(to + k)] = total


@kernel
def ring_rates(
    par: Array, load: float, slip: float, u: float, work: Array
) -> tuple[float, float, float]:
    """Return du/dt [1/s], its slopes over the film ratio and the load; fill W_AT ring by ring.

    The rings' temperatures are those in W_SURFACE.
    """
    moves = film_moves(par)
    rate, rate_u, rate_f, mean, first = 0.0, 0.0, 0.0, 0.0, 1.0
    width = par[L.P_SPEED_SMOOTHING]
    smooth = math.tanh(abs(slip) / width)
    steep = (1.0 - smooth) * (1.0 + smooth) / width
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        temperature = work[np.uintp(L.W_SURFACE + k)]
        at = work[L.W_AT + k * L.N_AT : L.W_AT + (k + 1) * L.N_AT]
        if not moves:
            mu, mu_t, mu_s = coefficient_slopes(ring, slip, temperature)
            lever = ring[L.D_RADIUS] * share
            speed = abs(slip) * smooth * lever
            at[POWER], at[POWER_U], at[POWER_T] = speed * mu * load, 0.0, speed * mu_t * load
            at[POWER_F], at[RATE_T] = speed * mu, 0.0
            at[POWER_S] = lever * load * (smooth * mu + abs(slip) * (steep * mu + smooth * mu_s))
            continue
        found, by = pack_slopes(ring, load * share, slip, u, temperature)
        at[POWER], at[POWER_U], at[POWER_T] = found[3], found[4], found[5]
        at[POWER_F], at[POWER_S] = by[1] * share, by[2]
        eta, eta_t = viscosity(
            temperature, par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_CONSTANT],
            par[L.P_VISCOSITY_EXPONENT],
        )  # fmt: skip
        weight = par[np.uintp(L.D_SQUEEZE + k)]
        at[RATE_T] = weight * eta_t
        mean += weight * eta
        if k == 0:
            first, rate, rate_u, rate_f = eta, found[0], found[1], by[0] * share
    if moves and load >= L.OPEN_PRESSURE * par[L.D_AREA]:
        thick = first / mean
        rate, rate_u, rate_f = rate * thick, rate_u * thick, rate_f * thick
        for k in range(int(par[L.D_RINGS])):
            work[np.uintp(L.W_AT + k * L.N_AT + RATE_T)] *= -rate / mean
    else:
        for k in range(int(par[L.D_RINGS])):
            work[np.uintp(L.W_AT + k * L.N_AT + RATE_T)] = 0.0
    return rate, rate_u, rate_f


@kernel
def ring_outputs(
    par: Array, point: tuple[float, float, float], change: tuple[float, float, float],
    work: Array, out: Array, dout: Array,
) -> None:  # fmt: skip
    """Fill ``out`` and its change ``dout`` but for temperature and energy.

    ``point``: load [N], slip [rad/s], film ratio; ``change`` theirs. Temperatures and their changes
    are in W_SURFACE and MAX_RINGS further on.
    """
    load, slip, u = point
    turn = sign_of(slip) * change[1]
    dry, ddry, wet, dwet, wet_slip = 0.0, 0.0, 0.0, 0.0, 0.0
    eta, deta, mu, dmu, arm = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        t = work[np.uintp(L.W_SURFACE + k)]
        dt = work[np.uintp(L.W_SURFACE + L.MAX_RINGS + k)]
        f, by_t, by_s = coefficient_slopes(ring, slip, t)
        lever = share * ring[L.D_RADIUS]
        mu, dmu, arm = mu + lever * f, dmu + lever * (by_t * dt + by_s * turn), arm + lever
        v, v_u, v_t, v_s, oil, oil_t, open_share, share_u = viscous_slopes(ring, slip, u, t)
        eta, deta = eta + share * oil, deta + share * oil_t * dt
        out[L.O_CONTACT_SHARE], dout[L.O_CONTACT_SHARE] = open_share, share_u * change[2]
        if film_moves(par):
            c, c_u, c_t, c_s, c_f, _, _ = contact_slopes(ring, load * share, slip, u, t)
            dry += c
            ddry += c_u * change[2] + c_t * dt + c_s * turn + c_f * share * change[0]
            wet += v
            dwet += v_u * change[2] + v_t * dt
            wet_slip += v_s
        else:
            lever *= par[L.P_FACES]
            dry += lever * f * load
            ddry += lever * ((by_t * dt + by_s * turn) * load + f * change[0])
    width = par[L.P_SPEED_SMOOTHING]
    smooth = math.tanh(slip / width)
    side, steep = sign_of(slip), (1.0 - smooth) * (1.0 + smooth) / width
    out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry * smooth, side * wet
    dout[L.O_CONTACT_TORQUE] = ddry * smooth + dry * steep * change[1]
    dout[L.O_VISCOUS_TORQUE] = side * dwet + wet_slip * change[1]
    out[L.O_TORQUE] = out[L.O_CONTACT_TORQUE] + out[L.O_VISCOUS_TORQUE]
    dout[L.O_TORQUE] = dout[L.O_CONTACT_TORQUE] + dout[L.O_VISCOUS_TORQUE]
    out[L.O_CAPACITY], dout[L.O_CAPACITY] = dry + wet, ddry + dwet + wet_slip * turn
    out[L.O_POWER] = out[L.O_TORQUE] * slip
    dout[L.O_POWER] = dout[L.O_TORQUE] * slip + out[L.O_TORQUE] * change[1]
    area = par[L.P_FACES] * par[L.D_AREA]
    out[L.O_HEAT_FLUX], dout[L.O_HEAT_FLUX] = out[L.O_POWER] / area, dout[L.O_POWER] / area
    out[L.O_COEFFICIENT], dout[L.O_COEFFICIENT] = mu / arm, dmu / arm
    out[L.O_FILM], dout[L.O_FILM] = u * par[L.P_ROUGHNESS], change[2] * par[L.P_ROUGHNESS]
    out[L.O_RATIO], dout[L.O_RATIO] = u, change[2]
    out[L.O_VISCOSITY], dout[L.O_VISCOSITY] = eta, deta


@kernel
def mean_surface(par: Array, work: Array) -> tuple[float, float]:
    """Return the area mean and the highest of the temperatures in W_SURFACE [K]."""
    mean, most = 0.0, 0.0
    for k in range(int(par[L.D_RINGS])):
        t = work[np.uintp(L.W_SURFACE + k)]
        mean += ring_of(par, k)[L.D_AREA] / par[L.D_AREA] * t
        most = max(most, t)
    return mean, most
