# mypy: disable-error-code="no-any-return"
"""The film as the integrator sees it: the unknown in which a film that is squeezed runs straight.

Far apart faces close as du/dt ~ -F u^3, so that 1/u^2 grows as the load does; pressed into each
other they follow the load with u < 0. The unknown v > 0 of u = 1/sqrt(v) - v joins both. An open
pack returns to its clearance at a rate that is linear in u: there the film ratio is the unknown.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import layout as L
from .rates import moves_film, pack_rates

N_TRIES = 20


@kernel
def film_of(v: float) -> tuple[float, float, float]:
    """Return the film ratio of the unknown, its slope and curvature; NaN for v <= 0."""
    if not v > 0.0:
        return math.nan, math.nan, math.nan
    far = 1.0 / math.sqrt(v)
    return far - v, -0.5 * far / v - 1.0, 0.75 * far / (v * v)


@kernel
def unknown_of(u: float) -> float:
    """Return the unknown of a film ratio, by Newton's method, at most N_TRIES times.

    Its root s solves s^3 + u s = 1. From the right of the solution no iterate leaves that side.
    """
    s = min(1.0, 1.0 / u) if u > 0.0 else 1.0 + math.sqrt(-u)
    for _ in range(N_TRIES):
        step = (s * (s * s + u) - 1.0) / (3.0 * s * s + u)
        s -= step
        if not abs(step) > 1e-15 * s:
            break
    return s * s


@kernel
def is_pressed(par: Array, load: float) -> bool:
    """Tell if a load [N] closes the pack."""
    return load >= L.OPEN_PRESSURE * par[L.D_AREA]


@kernel
def begin_film(par: Array, pressed: bool, work: Array) -> None:
    """Turn the film ratio in W_NOW into the unknown of a stretch, pressed or open."""
    work[L.W_PRESSED] = 1.0 if pressed and moves_film(par) else 0.0
    if work[L.W_PRESSED] != 0.0:
        place = np.uintp(L.W_NOW + L.Y_FILM)
        work[place] = unknown_of(work[place])


@kernel
def end_film(work: Array, follows: bool) -> None:
    """Turn the unknown in W_NOW into the film ratio, with ``follows`` also its change."""
    if work[L.W_PRESSED] != 0.0:
        u, slope, _ = film_of(work[np.uintp(L.W_NOW + L.Y_FILM)])
        work[np.uintp(L.W_NOW + L.Y_FILM)] = u
        if follows:
            work[np.uintp(L.W_VARIED + L.Y_FILM)] *= slope


@kernel
def rates_of_unknowns(
    par: Array, load: float, slip: float, drum: float, v: float, work: Array, to: int
) -> None:
    """Fill ``work[to:]`` as ``pack_rates`` does, the film's rate and slopes those of its unknown.

    Where a load at the end of a stretch lies on the other side of the limit by rounding, or by an
    extrapolation, it counts as the limit.
    """
    limit = L.OPEN_PRESSURE * par[L.D_AREA]
    if work[L.W_PRESSED] == 0.0:
        if moves_film(par):
            load = min(load, limit * (1.0 - 1e-15))
        pack_rates(par, max(load, 0.0), slip, drum, v, work, to)
        return
    u, slope, curvature = film_of(v)
    pack_rates(par, max(load, limit), slip, drum, u, work, to)
    rate = work[np.uintp(to + L.R_RATE)] / slope
    work[np.uintp(to + L.R_RATE)] = rate
    work[np.uintp(to + L.R_RATE_U)] -= rate * curvature / slope
    work[np.uintp(to + L.R_RATE_F)] /= slope
    for k in range(int(par[L.D_RINGS])):
        at = to + L.R_RINGS + k * L.N_OF_RING
        work[np.uintp(at + L.R_RATE_T)] /= slope
        work[np.uintp(at + L.R_POWER_U)] *= slope
        work[np.uintp(at + L.R_COOL_U)] *= slope
