# mypy: disable-error-code="no-any-return"
"""A pack that slips at constant load and speed for ever: the temperature where cooling wins."""

from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, NOT_FINITE, OK
from . import layout as L
from .constants import derive
from .pack_friction import coefficient_slopes, contact_slopes, viscous_slopes

__all__ = ["derive", "steady_temperature", "steady_torques"]

MAX_STEPS = 200


@kernel
def steady_torques(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[float, float, float]:
    """Return (contact torque, viscous torque [N m >= 0], slope of their sum [N m/K])."""
    mu, mu_slope, _ = coefficient_slopes(par, slip, temperature)
    lever = par[L.P_FACES] * par[L.D_RADIUS] * load
    if par[L.P_FIDELITY] != L.FIELD or par[L.P_FILM_DYNAMICS] == 0.0:
        return lever * mu, 0.0, lever * mu_slope
    viscous, _, slope, _, _, _, _, _ = viscous_slopes(par, slip, u, temperature)
    if load < L.OPEN_PRESSURE * par[L.D_AREA]:  # open: the asperities hardly touch
        touching, _, rise, _, _, _, _ = contact_slopes(par, load, slip, u, temperature)
        return touching, viscous, rise + slope
    return lever * mu, viscous, lever * mu_slope + slope


@kernel
def steady_temperature(
    par: Array, load: float, slip: float, oil: float, u: float
) -> tuple[float, int, int]:
    """Return (interface temperature [K], status, iterations): cooling = friction power.

    Newton inside a bracket that is halved whenever Newton leaves it. The power falls with
    temperature (the oil thins), so there is one root; should the shear ratio be told to rise with
    temperature there may be more, and one of them is found.
    """
    if par[L.P_FIDELITY] == L.BOUNDARY_ONLY or slip == 0.0:
        return oil, OK, 0
    scale = abs(slip) / (par[L.P_FACES] * par[L.D_COOLING])
    low, high, bracketed = oil, oil, False
    t = oil
    for n in range(MAX_STEPS):
        contact, viscous, slope = steady_torques(par, load, slip, u, t)
        balanced = oil + scale * (contact + viscous)
        if not balanced < 1e300:
            return t, NOT_FINITE, n
        if abs(balanced - t) <= 1e-13 * t or (bracketed and high - low <= 4e-16 * high):
            return t, OK, n + 1
        if balanced > t:
            low = t
            if not bracketed:
                t = balanced  # power falls with temperature: the root lies below
                continue
        else:
            high, bracketed = t, True
        newton = t - (balanced - t) / (scale * slope - 1.0)
        t = newton if low < newton < high else 0.5 * (low + high)
    return t, MAX_ITERATIONS, MAX_STEPS
