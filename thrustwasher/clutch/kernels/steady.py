# mypy: disable-error-code="no-any-return"
"""A pack that slips at constant load and speed for ever: the temperature where cooling wins."""

from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, NOT_FINITE, OK
from . import layout as L
from .constants import derive
from .pack_friction import coefficient_slopes, cooling_slope, load_share, pack_torques

__all__ = ["derive", "steady_temperature", "steady_torques"]

MAX_STEPS = 200


@kernel
def steady_torques(
    par: Array, load: float, slip: float, drum: float, u: float, temperature: float
) -> tuple[float, float, float]:
    """Return (contact torque, viscous torque [N m >= 0], slope of their sum [N m/K])."""
    pressed = load >= L.OPEN_PRESSURE * par[L.D_AREA]
    settled = par[L.P_FIDELITY] != L.FIELD or par[L.P_FILM_DYNAMICS] == 0.0
    if settled or (pressed and par[L.P_FRICTION_DATA] != L.BOUNDARY_DATA):
        mu, mu_slope, _ = coefficient_slopes(par, slip, temperature)
        lever = par[L.P_FACES] * par[L.D_RADIUS] * load
        return lever * mu, 0.0, lever * mu_slope
    contact, viscous, _, _ = pack_torques(par, load, slip, drum, u, temperature)
    return contact[0], viscous[0], contact[2] + viscous[2]


@kernel
def steady_cooling(par: Array, load: float, u: float) -> float:
    """Return how well the oil cools all faces of a pack with a settled film [W/K]."""
    pressed = load >= L.OPEN_PRESSURE * par[L.D_AREA]
    cooling, _ = cooling_slope(par, 1.0 if pressed else load_share(par, load, u)[0])
    return cooling * par[L.D_AREA] * par[L.P_FACES]


@kernel
def steady_temperature(
    par: Array, load: float, slip: float, drum: float, oil: float, u: float
) -> tuple[float, int, int]:
    """Return (interface temperature [K], status, iterations): cooling = friction power.

    Newton inside a bracket that is halved whenever Newton leaves it. The power falls with
    temperature (the oil thins), so there is one root; should friction or the shear ratio be told to
    rise with temperature there may be more, and one of them is found.
    """
    if slip == 0.0:
        return oil, OK, 0
    scale = abs(slip) / steady_cooling(par, load, u)
    low, high, bracketed = oil, oil, False
    t = oil
    for n in range(MAX_STEPS):
        contact, viscous, slope = steady_torques(par, load, slip, drum, u, t)
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
