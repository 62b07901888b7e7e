# mypy: disable-error-code="no-any-return"
"""A pack that slips at constant load and speed for ever: the temperature where cooling wins."""

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import (
    BAD_INPUT,
    HOT,
    MAX_ITERATIONS,
    NOT_FINITE,
    OK,
    OUTSIDE_VERIFIED,
    TOO_HOT,
)
from . import layout as L
from .constants import derive
from .pack_friction import (
    coefficient_slopes,
    contact_share,
    cooling_slope,
    load_share,
    oil_at,
    pack_torques,
    regime_of,
    rough_faces,
    settled_slope,
    shear_slopes,
)
from .rates import ring_of

__all__ = ["derive", "steady_pack", "steady_row", "steady_rows", "steady_temperature"]

MAX_STEPS = 200
GUESS = 1.0  # film ratio that a search without memory starts from
NOT_HELD = -1.0  # in place of a temperature that is given
# What a row holds: first the real outputs of a solution.
S_TORQUE, S_COEFFICIENT, S_TEMPERATURE, S_FILM, S_RATIO, S_SHEAR, S_CAPACITY, S_POWER = range(8)
S_CONTACT, S_VISCOUS, S_AREA, S_REGIME, S_STATUS, S_ITERATIONS, S_HOTTEST, S_COOLING = range(8, 16)
N_STEADY = 16


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
    oil = oil_at(par, temperature)
    contact, viscous, _, _ = pack_torques(par, load, slip, drum, rough_faces(u), oil)
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


@kernel
def _steady_part(
    par: Array, load: float, slip: float, drum: float, oil: float, u: float, held: float
) -> tuple[float, float, float, float, float, int, int]:
    """Return what ``steady_pack`` does, for a pack or ring of one temperature."""
    temperature, status, rounds = held, OK, 0
    if held < 0.0:
        temperature, status, rounds = steady_temperature(par, load, slip, drum, oil, u)
    contact, viscous, _ = steady_torques(par, load, slip, drum, u, temperature)
    mu, _, _ = coefficient_slopes(par, slip, temperature)
    shear, _, _ = shear_slopes(par, slip, temperature)
    return contact, viscous, temperature, mu, shear, status, rounds


@kernel
def steady_pack(
    par: Array, load: float, slip: float, drum: float, oil: float, u: float, held: float
) -> tuple[float, float, float, float, float, float, int, int]:
    """Return the steady state of a pack at a settled film of ``u`` roughnesses.

    (contact torque, viscous torque [N m >= 0], mean interface temperature by area, the hottest
    [K], coefficient, shear ratio, status, iterations). ``held``: temperature of the interface [K]
    of a slip that is over before it warms up, or NOT_HELD.
    """
    if par[L.P_FIDELITY] != L.FINE:
        contact, viscous, warm, mu, shear, status, rounds = _steady_part(
            par, load, slip, drum, oil, u, held
        )
        return contact, viscous, warm, warm, mu, shear, status, rounds
    contact, viscous, warm, hottest, mu, shear = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    area, levers, status, rounds = 0.0, 0.0, OK, 0
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        lever = share * ring[L.D_RADIUS]
        own = _steady_part(ring, load * share, slip, drum, oil, u, held)
        contact, viscous = contact + own[0], viscous + own[1]
        area, levers = area + share, levers + lever
        warm, hottest = warm + share * own[2], max(hottest, own[2])
        mu, shear = mu + lever * own[3], shear + lever * own[4]
        status, rounds = max(status, own[5]), rounds + own[6]
    return contact, viscous, warm / area, hottest, mu / levers, shear / levers, status, rounds


@kernel
def steady_row(
    par: Array,
    load: float,
    slip: float,
    oil: float,
    drum: float,
    held: float,
    guess: float,
    out: Array,
) -> None:
    """Fill ``out`` (N_STEADY,) with a pack that slips: torques signed, film settled, SI units.

    ``guess``: film ratio that the search starts from. Status BAD_INPUT, and nothing else filled
    in: no oil cools the faces.
    """
    u, _, film, turns = settled_slope(par, load, guess)
    cooling = steady_cooling(par, load, u)
    if slip != 0.0 and held < 0.0 and cooling == 0.0:
        out[S_STATUS] = BAD_INPUT
        return
    contact, viscous, warm, hottest, mu, shear, status, rounds = steady_pack(
        par, load, slip, drum, oil, u, held
    )
    status = max(status, film)
    if status < MAX_ITERATIONS:
        if hottest > L.EXTRAPOLATED_LIMIT:
            status = TOO_HOT
        elif hottest > L.HOT_LIMIT:
            status = HOT
        elif u < L.LEAST_RATIO:
            status = OUTSIDE_VERIFIED
    sign = sign_of(slip)
    torque = sign * (contact + viscous)
    out[S_TORQUE], out[S_COEFFICIENT], out[S_TEMPERATURE] = torque, mu, warm
    out[S_FILM], out[S_RATIO], out[S_SHEAR] = u * par[L.P_ROUGHNESS], u, shear
    out[S_CAPACITY], out[S_POWER] = contact + viscous, torque * slip
    out[S_CONTACT], out[S_VISCOUS] = sign * contact, sign * viscous
    out[S_AREA], out[S_REGIME] = contact_share(par, u)[0], regime_of(par, u, slip)
    out[S_STATUS], out[S_ITERATIONS] = status, turns + rounds
    out[S_HOTTEST], out[S_COOLING] = hottest, cooling


@kernel
def steady_rows(par: Array, inputs: Array, out: Array) -> None:
    """Fill rows (n, N_STEADY) of inputs (n, 4): load, slip, oil and drum, each from the one before.

    After one that failed the search begins anew.
    """
    guess = GUESS
    for i in range(inputs.shape[0]):
        load, slip, oil, drum = inputs[i, 0], inputs[i, 1], inputs[i, 2], inputs[i, 3]
        steady_row(par, load, slip, oil, drum, NOT_HELD, guess, out[i])
        guess = out[i, S_RATIO] if out[i, S_STATUS] < MAX_ITERATIONS else GUESS
