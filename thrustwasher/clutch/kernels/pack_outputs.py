# mypy: disable-error-code="no-any-return"
"""The outputs of a pack at a point in time, with slopes."""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import layout as L
from .pack_friction import coefficient_slopes, cooling_slope, pack_torques, rough_faces
from .rates import fill_viscosities, moves_film, oil_of, ring_of, settled_cooling, surfaces


@kernel
def fill_outputs(
    par: Array, load: float, slip: float, drum: float, work: Array, out: Array
) -> None:
    """Fill what follows from film and temperatures in W_NOW; temperature and heats come later."""
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_SURFACE_CHANGE + k)] = 0.0
    scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
    point = (load, slip, work[np.uintp(L.W_NOW + L.Y_FILM)], drum)
    ring_outputs(par, point, (0.0, 0.0, 0.0, 0.0), work, out, scratch)


@kernel
def ring_outputs(
    par: Array,
    point: tuple[float, float, float, float],
    change: tuple[float, float, float, float],
    work: Array,
    out: Array,
    dout: Array,
) -> None:
    """Fill ``out`` and its change ``dout`` but for temperature and heats.

    ``point``: load [N], slip [rad/s], film ratio, drum speed [rad/s]; ``change`` theirs.
    Temperatures and their changes are in W_SURFACE and W_SURFACE_CHANGE.
    """
    load, slip, u, drum = point
    turn, faces = sign_of(slip) * change[1], rough_faces(u)
    dry, ddry, wet, dwet, wet_slip = 0.0, 0.0, 0.0, 0.0, 0.0
    eta, deta, mu, dmu, arm = 0.0, 0.0, 0.0, 0.0, 0.0
    fill_viscosities(par, work)
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        t = work[np.uintp(L.W_SURFACE + k)]
        dt = work[np.uintp(L.W_SURFACE_CHANGE + k)]
        f, by_t, by_s = coefficient_slopes(ring, slip, t)
        lever = share * ring[L.D_RADIUS]
        mu, dmu, arm = mu + lever * f, dmu + lever * (by_t * dt + by_s * turn), arm + lever
        oil = oil_of(work, k)
        contact, viscous, carried, area = pack_torques(ring, load * share, slip, drum, faces, oil)
        eta, deta = eta + share * oil[1], deta + share * oil[2] * dt
        out[L.O_CONTACT_SHARE], dout[L.O_CONTACT_SHARE] = area[0], area[1] * change[2]
        if moves_film(par):
            work[L.W_COOLING] = cooling_slope(par, carried[0])[0]
            more = share * change[0]
            dry += contact[0]
            ddry += contact[1] * change[2] + contact[2] * dt + contact[3] * turn + contact[4] * more
            wet += viscous[0]
            dwet += viscous[1] * change[2] + viscous[2] * dt + viscous[4] * change[3]
            dwet += viscous[5] * more
            wet_slip += viscous[3]
        else:
            work[L.W_COOLING] = settled_cooling(par, load)
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
    whole = par[L.P_FACES] * par[L.D_AREA]
    out[L.O_HEAT_FLUX], dout[L.O_HEAT_FLUX] = out[L.O_POWER] / whole, dout[L.O_POWER] / whole
    out[L.O_COEFFICIENT], dout[L.O_COEFFICIENT] = mu / arm, dmu / arm
    out[L.O_FILM], dout[L.O_FILM] = u * par[L.P_ROUGHNESS], change[2] * par[L.P_ROUGHNESS]
    out[L.O_RATIO], dout[L.O_RATIO] = u, change[2]
    out[L.O_VISCOSITY], dout[L.O_VISCOSITY] = eta, deta


@kernel
def stored_heat(par: Array, work: Array, first: float) -> float:
    """Return the heat [J] in the plates of the pack in W_NOW, over that at the start [K]."""
    total, place = 0.0, L.W_NOW + L.Y_HEAT
    for k in range(int(par[L.D_RINGS])):
        total += (work[np.uintp(place)] - first) / ring_of(par, k)[L.D_GAIN]
        place += 1 + int(par[L.D_MODES])
    return par[L.P_FACES] * total


@kernel
def mean_surface(par: Array, work: Array) -> tuple[float, float]:
    """Return the area mean and the highest of the temperatures in W_SURFACE [K]."""
    mean, most = 0.0, 0.0
    for k in range(int(par[L.D_RINGS])):
        t = work[np.uintp(L.W_SURFACE + k)]
        mean += ring_of(par, k)[L.D_AREA] / par[L.D_AREA] * t
        most = max(most, t)
    return mean, most
