# mypy: disable-error-code="no-any-return"
"""The wet clutch for model exchange: film, plates' temperatures, heat, and a bristle for rest.

The bristle's capacity is the torque of the asperities; shear of oil acts beside it. The heat of
both goes into the rings in proportion to their own powers.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear
from ...numerics.jit import Array, Ints, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import BAD_INPUT, EXTRAPOLATED, HOT, NOT_FINITE, OK, OUTSIDE_VERIFIED
from ...tribology.bristle import (
    DWELL,
    FREE,
    HELD,
    Bristle,
    bristle,
    bristle_changes,
    bristle_heat,
    bristle_of,
    first_bend,
    margin,
)
from . import layout as L
from .layout import X_BEND, X_ENERGY, X_FILM, X_HEAT
from .pack_friction import regime_of, settled_slope
from .pack_outputs import fill_outputs, mean_surface, ring_outputs, stored_heat
from .rates import kept_of, moves_film, pack_rates, ring_of, surfaces

NPAR, NINP, NWORK, NOUT, NIOUT = L.NPAR, L.NINP, L.NWORK, L.NOUT, L.NIOUT
NCONT = L.N_STATES
A_ANGLE, A_DAMPING, A_SPEED, A_LARGEST, NOWN = range(5)
# What is discrete: time of the next event [s], largest capacity [N m], oil at the start [K], 1 if
# the pack is locked, since when it might be [s].
D_NEXT, D_LARGEST, D_FIRST, D_LOCKED, D_SINCE, NMODE = range(6)
Z_LOCKED, Z_OPEN, Z_MIXED, Z_BOUNDARY, Z_ADHESIVE, Z_HOT, NSIGN = range(7)
MIXED_FROM, BOUNDARY_FROM = 3.0, 1.0  # film ratios of the regimes
NEVER = 1.7976931348623157e308
USUAL_PRESSURE, USUAL_FRICTION = 1e6, 0.12  # Pa, -: of the largest capacity
BASIS_GIVEN = 2  # of a lock: the plant is the host's
OUT = L.W_STAGES  # outputs that are nobody's


@kernel
def bristle_of_pack(own: Array, discrete: Array) -> Bristle:
    """Return the bristle."""
    return bristle_of(discrete[D_LARGEST], own[A_ANGLE], own[A_SPEED], own[A_DAMPING])


@kernel
def dry_of(out: Array) -> float:
    """Return the capacity of the asperities [N m] of outputs."""
    return max(out[L.O_CAPACITY] - abs(out[L.O_VISCOUS_TORQUE]), 0.0)


@kernel
def take_over(par: Array, inp: Array, cont: Array, work: Array, out: Array) -> int:
    """Put the states to W_NOW and fill what follows from them; return a status."""
    film, status = cont[X_FILM], OK
    good = are_finite(inp) and are_finite(cont) and inp[L.I_LOAD] >= 0.0 and inp[L.I_OIL] > 0.0
    work[L.W_SETTLED_LOAD] = work[L.W_GIVEN] = 0.0
    if not good or int(par[L.D_MODES]) != 0:
        return BAD_INPUT
    if not moves_film(par):
        film, work[L.W_SETTLED_LOAD], status, _ = settled_slope(par, inp[L.I_LOAD], 1.0)
    work[np.uintp(L.W_NOW + L.Y_FILM)] = film
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] = cont[X_ENERGY] / par[L.P_FACES]
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_NOW + L.Y_HEAT + k)] = cont[np.uintp(X_HEAT + k)]
    fill_outputs(par, inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_DRUM], work, out)
    return status


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start, film open or settled, steel as warm as oil; return a status."""
    clear(cont)
    largest = own[A_LARGEST]
    if largest == 0.0:
        largest = USUAL_FRICTION * USUAL_PRESSURE * par[L.D_AREA] * par[L.D_RADIUS] * par[L.P_FACES]
    discrete[D_NEXT] = discrete[D_SINCE] = NEVER
    discrete[D_LARGEST], discrete[D_FIRST], discrete[D_LOCKED] = largest, inp[L.I_OIL], 0.0
    cont[X_FILM] = par[L.D_OPEN_RATIO]
    if par[L.P_STARTS_PRESSED] != 0.0 and inp[L.I_LOAD] >= 0.0:
        cont[X_FILM], _, status, _ = settled_slope(par, inp[L.I_LOAD], 1.0)
        if status != OK:
            return status
    for k in range(L.N_RINGS):
        cont[np.uintp(X_HEAT + k)] = inp[L.I_OIL]
    out = work[OUT : OUT + NOUT]
    status = take_over(par, inp, cont, work, out)
    if status == OK:
        b = bristle_of_pack(own, discrete)
        cont[X_BEND] = first_bend(b, dry_of(out), inp[L.I_SPEED])
    return status


@kernel
def shared(par: Array, inp: Array, work: Array) -> float:
    """Fill the rings' rates at NEIGHBOUR; return the sum of their own powers of a face [W]."""
    film, total = work[np.uintp(L.W_NOW + L.Y_FILM)], 0.0
    pack_rates(par, inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_DRUM], film, work, L.W_NEIGHBOUR)
    for k in range(int(par[L.D_RINGS])):
        total += kept_of(work, L.NEIGHBOUR, k)[L.R_POWER]
    return total


@kernel
def share_of(par: Array, work: Array, k: int, total: float) -> float:
    """Return the share of a ring in the heat."""
    if total > 0.0:
        return kept_of(work, L.NEIGHBOUR, k)[L.R_POWER] / total
    return ring_of(par, k)[L.D_AREA] / par[L.D_AREA]


@kernel
def rates(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    der: Array,
    sign: Array,
) -> int:
    """Fill outputs, rates of the states, event indicators; return 0 or the status of a failure."""
    clear(der)
    status = take_over(par, inp, cont, work, out)
    if status != OK:
        return status
    slip, oil, faces, bend = inp[L.I_SPEED], inp[L.I_OIL], par[L.P_FACES], cont[X_BEND]
    b, dry, wet = bristle_of_pack(own, discrete), dry_of(out), out[L.O_VISCOUS_TORQUE]
    torque, der[X_BEND] = bristle(b, dry, slip, bend)
    heat = bristle_heat(b, torque, slip, bend, der[X_BEND]) + wet * slip
    der[X_ENERGY] = heat
    total, cooled = shared(par, inp, work), 0.0
    if moves_film(par):
        der[X_FILM] = work[np.uintp(L.W_NEIGHBOUR + L.R_RATE)]
    for k in range(int(par[L.D_RINGS])):
        gain, t = ring_of(par, k)[L.D_GAIN], cont[np.uintp(X_HEAT + k)]
        loss = kept_of(work, L.NEIGHBOUR, k)[L.R_COOL] * (t - oil)
        der[np.uintp(X_HEAT + k)] = gain * (share_of(par, work, k, total) * heat / faces - loss)
        cooled += faces * loss
    out[L.O_TORQUE], out[L.O_CONTACT_TORQUE] = torque + wet, torque
    out[L.O_POWER], out[L.O_HEAT_FLUX] = heat, heat / (faces * par[L.D_AREA])
    out[L.O_TEMPERATURE], _ = mean_surface(par, work)
    out[L.O_ENERGY], out[L.O_OIL_HEAT] = cont[X_ENERGY], cooled
    out[L.O_STORED_HEAT] = stored_heat(par, work, discrete[D_FIRST])
    out[L.O_OIL_ENERGY] = cont[X_ENERGY] - out[L.O_STORED_HEAT]
    out[L.O_ADVISED] = out[L.O_PLANT_INERTIA] = out[L.O_SLIP_BOUND] = 0.0
    might = discrete[D_LOCKED] != 0.0 or discrete[D_SINCE] != NEVER
    sign[Z_LOCKED] = margin(b, dry, bend, FREE if might else HELD)
    sign[Z_OPEN] = inp[L.I_LOAD] / (L.OPEN_PRESSURE * par[L.D_AREA]) - 1.0
    _, hottest = mean_surface(par, work)
    sign[Z_MIXED], sign[Z_BOUNDARY] = out[L.O_RATIO] - MIXED_FROM, out[L.O_RATIO] - BOUNDARY_FROM
    sign[Z_ADHESIVE] = abs(slip) * par[L.D_RADIUS] - par[L.P_STICK_SPEED]
    sign[Z_HOT] = (hottest - L.HOT_LIMIT) / L.HOT_LIMIT
    return OK if are_finite(out) and are_finite(der) else NOT_FINITE


@kernel
def update(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    iout: Ints,
    t: float,
) -> int:
    """Fill what is discrete: whether the pack is locked, regime, status; return a status.

    It is locked once it has been held for DWELL without coming near to break away.
    """
    shown = work[OUT : OUT + NOUT]
    status = take_over(par, inp, cont, work, shown)
    if status != OK:
        return status
    b, dry = bristle_of_pack(own, discrete), dry_of(shown)
    discrete[D_NEXT] = NEVER
    if not margin(b, dry, cont[X_BEND], FREE) > 0.0:
        discrete[D_LOCKED], discrete[D_SINCE] = 0.0, NEVER
    elif discrete[D_LOCKED] == 0.0:
        if discrete[D_SINCE] == NEVER and margin(b, dry, cont[X_BEND], HELD) > 0.0:
            discrete[D_SINCE] = t
        if discrete[D_SINCE] != NEVER:
            end = discrete[D_SINCE] + DWELL
            if t >= end - 1e-9 * DWELL:
                discrete[D_LOCKED], discrete[D_SINCE] = 1.0, NEVER
            else:
                discrete[D_NEXT] = end
    locked = discrete[D_LOCKED] != 0.0
    iout[L.IO_LOCKED], iout[L.IO_LOCK_BASIS] = int(locked), BASIS_GIVEN if locked else 0
    iout[L.IO_PLANT_AGE] = -1
    iout[L.IO_REGIME] = regime_of(par, shown[L.O_RATIO], inp[L.I_SPEED])
    _, hottest = mean_surface(par, work)
    advice = OUTSIDE_VERIFIED if shown[L.O_RATIO] < L.LEAST_RATIO else OK
    if hottest > L.HOT_LIMIT:
        advice = EXTRAPOLATED if hottest > L.EXTRAPOLATED_LIMIT else HOT
    iout[L.IO_STATUS] = advice
    return OK if math.isfinite(t) else BAD_INPUT


@kernel
def slopes(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    along: Array,
    found: Array,
) -> int:
    """Fill ``found``, changes of outputs and rates, with changes of inputs and states ``along``."""
    clear(found)
    out, rings = work[OUT : OUT + NOUT], int(par[L.D_RINGS])
    status = take_over(par, inp, cont, work, out)
    if status != OK:
        return status
    slip, oil, faces, bend = inp[L.I_SPEED], inp[L.I_OIL], par[L.P_FACES], cont[X_BEND]
    faster, more, turns = along[L.I_SPEED], along[L.I_LOAD], along[L.I_DRUM]
    film = work[L.W_SETTLED_LOAD] * more
    if moves_film(par):
        film = along[NINP + X_FILM]
    b, dry, wet = bristle_of_pack(own, discrete), dry_of(out), out[L.O_VISCOUS_TORQUE]
    total = shared(par, inp, work)
    for k in range(rings):
        work[np.uintp(L.W_SURFACE_CHANGE + k)] = along[np.uintp(NINP + X_HEAT + k)]
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    point = (inp[L.I_LOAD], slip, work[np.uintp(L.W_NOW + L.Y_FILM)], inp[L.I_DRUM])
    ring_outputs(par, point, (more, faster, film, turns), work, out, found[:NOUT])
    grows = found[L.O_CAPACITY] - sign_of(slip) * found[L.O_VISCOUS_TORQUE]
    wets, change = found[L.O_VISCOUS_TORQUE], (grows, faster, along[NINP + X_BEND])
    heat, torques, bending, heats = bristle_changes(b, dry, slip, bend, change, (wet, wets))
    found[NOUT + X_BEND], found[NOUT + X_ENERGY] = bending, heats
    base = L.W_NEIGHBOUR
    if moves_film(par):
        grown = work[np.uintp(base + L.R_RATE_U)] * film + work[np.uintp(base + L.R_RATE_F)] * more
        found[NOUT + X_FILM] = grown + work[np.uintp(base + L.R_RATE_S)] * faster
    powers = 0.0
    for k in range(rings):
        powers += _power_change(work, along, k, film)
    cooled, stored = 0.0, 0.0
    for k in range(rings):
        ring, kept = ring_of(par, k), kept_of(work, L.NEIGHBOUR, k)
        warmer = along[np.uintp(NINP + X_HEAT + k)]
        share, shares = share_of(par, work, k, total), 0.0
        if total > 0.0 and rings > 1:
            shares = (_power_change(work, along, k, film) - share * powers) / total
        excess = cont[np.uintp(X_HEAT + k)] - oil
        loss = kept[L.R_COOL] * (warmer - along[L.I_OIL])
        loss += (kept[L.R_COOL_U] * film + kept[L.R_COOL_F] * more) * excess
        given = (shares * heat + share * heats) / faces
        found[np.uintp(NOUT + X_HEAT + k)] = ring[L.D_GAIN] * (given - loss)
        if moves_film(par):
            found[NOUT + X_FILM] += kept[L.R_RATE_T] * warmer
        cooled, stored = cooled + faces * loss, stored + faces * warmer / ring[L.D_GAIN]
        found[L.O_TEMPERATURE] += ring[L.D_AREA] / par[L.D_AREA] * warmer
    found[L.O_TORQUE], found[L.O_CONTACT_TORQUE] = torques + wets, torques
    found[L.O_POWER], found[L.O_HEAT_FLUX] = heats, heats / (faces * par[L.D_AREA])
    found[L.O_ENERGY], found[L.O_OIL_HEAT] = along[NINP + X_ENERGY], cooled
    found[L.O_STORED_HEAT], found[L.O_OIL_ENERGY] = stored, along[NINP + X_ENERGY] - stored
    found[L.O_ADVISED] = found[L.O_PLANT_INERTIA] = found[L.O_SLIP_BOUND] = 0.0
    return OK if are_finite(found) else NOT_FINITE


@kernel
def _power_change(work: Array, along: Array, k: int, film: float) -> float:
    """Return how a ring's own power of a face changes."""
    kept = kept_of(work, L.NEIGHBOUR, k)
    change = kept[L.R_POWER_U] * film + kept[L.R_POWER_T] * along[np.uintp(NINP + X_HEAT + k)]
    change += kept[L.R_POWER_F] * along[L.I_LOAD] + kept[L.R_POWER_S] * along[L.I_SPEED]
    return change + kept[L.R_POWER_D] * along[L.I_DRUM]
