# mypy: disable-error-code="no-any-return"
"""The outputs of a pack at a point in time, with slopes."""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import layout as L
from .pack_friction import coefficient_slopes, contact_slopes, viscous_slopes
from .rates import moves_film, ring_of, surfaces


@kernel
def fill_outputs(par: Array, load: float, slip: float, work: Array, out: Array) -> None:
    """Fill what follows from film and temperatures in W_NOW; temperature and energy come later."""
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    if par[L.P_FIDELITY] != L.FINE:
        lumped_outputs(par, load, slip, work, out)
        return
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_SURFACE_CHANGE + k)] = 0.0
    scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
    point = (load, slip, work[np.uintp(L.W_NOW + L.Y_FILM)])
    ring_outputs(par, point, (0.0, 0.0, 0.0), work, out, scratch)


@kernel
def lumped_outputs(par: Array, load: float, slip: float, work: Array, out: Array) -> None:
    """Fill what a lumped pack gives but temperature and energy, from the film in W_NOW.

    The temperature is that in W_SURFACE. The slopes behind the outputs stay in ``work``, from
    W_CONTACT on.
    """
    u = work[np.uintp(L.W_NOW + L.Y_FILM)]
    temperature = work[L.W_SURFACE]
    mu, mu_heat, mu_slip = coefficient_slopes(par, slip, temperature)
    viscous, by_film, by_heat, by_slip, eta, eta_slope, share, share_slope = viscous_slopes(
        par, slip, u, temperature
    )
    if moves_film(par):
        (
            contact, work[L.W_CONTACT_FILM], work[L.W_CONTACT_HEAT], work[L.W_CONTACT_SLIP],
            work[L.W_CONTACT_LOAD], _, _,
        ) = contact_slopes(par, load, slip, u, temperature)  # fmt: skip
    else:
        lever = par[L.P_FACES] * par[L.D_RADIUS]
        contact, work[L.W_CONTACT_FILM] = lever * mu * load, 0.0
        work[L.W_CONTACT_HEAT] = lever * mu_heat * load
        work[L.W_CONTACT_SLIP], work[L.W_CONTACT_LOAD] = lever * mu_slip * load, lever * mu
        viscous, by_film, by_heat, by_slip = 0.0, 0.0, 0.0, 0.0
    smooth = math.tanh(slip / par[L.P_SPEED_SMOOTHING])
    work[L.W_CONTACT], work[L.W_VISCOUS], work[L.W_SMOOTH] = contact, viscous, smooth
    work[L.W_VISCOUS_FILM], work[L.W_VISCOUS_HEAT] = by_film, by_heat
    work[L.W_VISCOUS_SLIP] = by_slip
    work[L.W_FRICTION_SLIP], work[L.W_FRICTION_HEAT] = mu_slip, mu_heat
    work[L.W_SHARE_FILM], work[L.W_VISCOSITY_HEAT] = share_slope, eta_slope
    dry = contact * smooth
    wet = math.copysign(viscous, slip)
    out[L.O_TORQUE] = dry + wet
    out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry, wet
    out[L.O_CAPACITY] = contact + viscous
    out[L.O_POWER] = out[L.O_TORQUE] * slip
    out[L.O_HEAT_FLUX] = out[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    out[L.O_COEFFICIENT] = mu
    out[L.O_FILM], out[L.O_RATIO] = u * par[L.P_ROUGHNESS], u
    out[L.O_CONTACT_SHARE], out[L.O_VISCOSITY] = share, eta


@kernel
def ring_outputs(
    par: Array, point: tuple[float, float, float], change: tuple[float, float, float],
    work: Array, out: Array, dout: Array,
) -> None:  # fmt: skip
    """Fill ``out`` and its change ``dout`` but for temperature and energy.

    ``point``: load [N], slip [rad/s], film ratio; ``change`` theirs. Temperatures and their changes
    are in W_SURFACE and W_SURFACE_CHANGE.
    """
    load, slip, u = point
    turn = sign_of(slip) * change[1]
    dry, ddry, wet, dwet, wet_slip = 0.0, 0.0, 0.0, 0.0, 0.0
    eta, deta, mu, dmu, arm = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        t = work[np.uintp(L.W_SURFACE + k)]
        dt = work[np.uintp(L.W_SURFACE_CHANGE + k)]
        f, by_t, by_s = coefficient_slopes(ring, slip, t)
        lever = share * ring[L.D_RADIUS]
        mu, dmu, arm = mu + lever * f, dmu + lever * (by_t * dt + by_s * turn), arm + lever
        v, v_u, v_t, v_s, oil, oil_t, open_share, share_u = viscous_slopes(ring, slip, u, t)
        eta, deta = eta + share * oil, deta + share * oil_t * dt
        out[L.O_CONTACT_SHARE], dout[L.O_CONTACT_SHARE] = open_share, share_u * change[2]
        if moves_film(par):
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
