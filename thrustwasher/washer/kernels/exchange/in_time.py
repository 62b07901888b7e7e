# mypy: disable-error-code="no-any-return"
"""Bodies that warm up in time, in model exchange: their mean temperatures are the host's states.

Co-simulation integrates a temperature per node and term of the ladder, some 1000 with `field`. A
linear ladder has the same equation for its mean over a face, with the mean flux. These means are
the states: of carrier and gear the face's temperature and what each slower term has of it, of the
washer its temperature. What the nodes deviate from them, the shape, is discrete: from the last
event it goes on with the flux of then, which the ladder answers exactly; at the next event it is
integrated as in co-simulation. That is due by time, or when the flux has changed (an indicator).

A term with the far face at T_a is M; the state is M + c (T_a - REFERENCE), which goes on evenly
when T_a jumps. The first one's place has the temperature of the face instead.
"""

import numpy as np

from ....numerics.arrays import clear
from ....numerics.jit import Array, kernel, matrix
from ....numerics.status import NOT_FINITE, OK
from .. import layout as L
from ..branch import FILM_RATIO
from ..constants import WasherModel
from ..continuation import BUDGET, recall, remember
from ..heat import heat_change, heat_residual, let_film_follow
from ..ladder import (
    BODIES,
    HELD,
    REFERENCE,
    Body,
    angle_of,
    body_of,
    far_of,
    mean_of,
    state_of,
    term,
    terms_of,
    weigh,
)
from ..outputs import outputs_at
from ..transient import ATOL, LOST_SHARE, RTOL, along_the_film
from ..workspace import (
    Fields,
    Point,
    Workspace,
    fields_of,
    forget_factor,
    model_of,
    vector,
    workspace_of,
)
from .kept import (
    D_BRANCH,
    D_NOW,
    D_SEVERAL,
    D_SINCE,
    K_SHAPES,
    arrive,
    moving_point,
    take_kept,
)

OFF = 4.0  # tolerances that shapes may be off by at most


@kernel
def mean_term(b: Body, pt: Point, body: int, k: int, states: Array) -> float:
    """Return the mean M of a term [K]; ``states`` are all continuous ones."""
    place, far, first = state_of(body), far_of(pt, body), 0.0
    for other in range(1, terms_of(body)):
        part = states[np.uintp(place + other)] - term(b, other).falls * (far - REFERENCE)
        if other == k:
            return part
        first += part
    return states[place] - far - first


@kernel
def shapes_of(discrete: Array, n_temp: int) -> Array:
    """Return the kept fields (N_TERMS + 1, n_temp): terms, that of the washer first, then flux."""
    size = (L.N_TERMS + 1) * n_temp
    return matrix(discrete[K_SHAPES : K_SHAPES + size], L.N_TERMS + 1, n_temp)


@kernel
def gain_of(b: Body, body: int, dt: float) -> float:
    """Return by what a face gets warmer in ``dt`` per flux that is held [m^2 K/W]."""
    if body == L.OF_WASHER:
        return dt / b.storage
    gain = 0.0
    for k in range(L.N_TERMS):
        _, late, early = weigh(b, k, dt)
        gain += late + early
    return gain


@kernel
def foresee(w: Workspace, pt: Point, cont: Array, discrete: Array) -> None:
    """Fill ``f.outward`` with the bodies' rises now: kept shapes, gone on, about the states."""
    m, f = model_of(w), fields_of(w)
    shapes = shapes_of(discrete, f.temp.size)
    since = max(discrete[D_NOW] - discrete[D_SINCE], 0.0)
    for body in BODIES:
        b = body_of(m, body)
        gain = gain_of(b, body, since)
        k0, k1, k2, k3 = 1.0, 0.0, 0.0, 0.0
        if body != L.OF_WASHER:
            k0, _, _ = weigh(b, 0, since)
            k1, _, _ = weigh(b, 1, since)
            k2, _, _ = weigh(b, 2, since)
            k3, _, _ = weigh(b, 3, since)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                f.outward[node] = (
                    k0 * shapes[0, node]
                    + k1 * shapes[1, node]
                    + k2 * shapes[2, node]
                    + k3 * shapes[3, node]
                    + gain * shapes[L.N_TERMS, node]
                )
        mean, _ = mean_of(m, b, f.outward)
        shift = cont[state_of(body)] - pt.oil_temperature - mean
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                f.outward[np.uintp(b.at + j * b.step + i)] += shift


@kernel
def wear(w: Workspace) -> None:
    """Let the bodies be as warm as ``f.outward`` says, and held there."""
    m, f = model_of(w), fields_of(w)
    for body in BODIES:
        b = body_of(m, body)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                f.temp[node] = f.outward[node]
    f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER], f.small[L.OUT_GEAR] = HELD, HELD, HELD


@kernel
def fill_flux(w: Workspace, pt: Point) -> None:
    """Fill ``f.flux`` with the heat that enters the bodies at a solution [W/m^2]."""
    m, f = model_of(w), fields_of(w)
    out = f.small[L.OUT_CARRIER : L.OUT_SIZE]
    clear(out)
    heat_residual(m, pt, f.temp, f)
    out[0], out[1], out[2] = HELD, HELD, HELD
    for body in BODIES:
        b = body_of(m, body)
        for j in range(b.columns):
            angle = angle_of(m, b, j)
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                f.flux[node] = -f.heat[node] / (b.weight[i] * angle)


@kernel
def solve_held(w: Workspace, pt: Point) -> int:
    """Solve film and contacts between held bodies, fill outputs and fluxes; return a status."""
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET
    remember(w, 1.0)
    status = arrive(w, pt)
    if status != OK:
        recall(w, 1.0)
        status = along_the_film(w, pt)
        if status == OK:
            forget_factor(w)
            status = arrive(w, pt)
    w.info[L.BUDGET] = 0.0
    if status != OK:
        return status
    if not outputs_at(w, pt):
        return NOT_FINITE
    fill_flux(w, pt)
    return OK


@kernel
def solved_in_time(par: Array, inp: Array, cont: Array, discrete: Array, work: Array) -> int:
    """Fill ``work`` with the sliding washer between bodies as warm as they are; return a status."""
    pt, w = moving_point(par, inp), workspace_of(par, work)
    clear(w.info)
    clear(w.found)
    clear(w.curve)
    status = take_kept(w, discrete)
    if status != OK:
        return status
    foresee(w, pt, cont, discrete)
    wear(w)
    status = solve_held(w, pt)
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = discrete[D_BRANCH], discrete[D_SEVERAL]
    return status


@kernel
def room_of_film(w: Workspace) -> float:
    """Return how far the film is from being lost; negative: lost."""
    out = w.outputs
    return max(out[L.O_FLUID_SHARE] - LOST_SHARE, out[L.O_RATIO] / FILM_RATIO - 1.0)


@kernel
def tolerance_of(m: WasherModel, f: Fields) -> float:
    """Return what a temperature may be off [K]."""
    largest = 0.0
    for body in BODIES:
        b = body_of(m, body)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                largest = max(largest, abs(f.temp[np.uintp(b.at + j * b.step + i)]))
    return ATOL + RTOL * largest


@kernel
def flux_moved(w: Workspace, body: int, shapes: Array) -> float:
    """Return by what the flux into a body has changed beside its mean, at most [W/m^2]."""
    m, f, most = model_of(w), fields_of(w), 0.0
    b = body_of(m, body)
    now, _ = mean_of(m, b, f.flux)
    before, _ = mean_of(m, b, shapes[L.N_TERMS])
    for j in range(b.columns):
        for i in range(b.first, m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            most = max(most, abs(f.flux[node] - shapes[L.N_TERMS, node] - (now - before)))
    return most


@kernel
def shapes_sign(w: Workspace, discrete: Array) -> float:
    """Return the indicator of shapes that are no longer right; 1 where the flux is as it was."""
    m, f = model_of(w), fields_of(w)
    shapes, off = shapes_of(discrete, f.temp.size), 0.0
    since = max(discrete[D_NOW] - discrete[D_SINCE], 0.0)
    for body in BODIES:
        gain = gain_of(body_of(m, body), body, since)
        off = max(off, 0.5 * gain * flux_moved(w, body, shapes))
    return 1.0 - off / (OFF * tolerance_of(m, f))


@kernel
def flow_into(w: Workspace, body: int, heat: float, kept: float) -> tuple[float, float, float]:
    """Return the mean flux into a body [W/m^2], its face [m^2], its part of heat made in sliding.

    ``heat``: what sliding makes less what flowing oil carries away [W]; ``kept``: what of it is not
    made near rest, from 0 on.
    """
    m, f = model_of(w), fields_of(w)
    mean, area = mean_of(m, body_of(m, body), f.flux)
    part = 0.0
    if body == L.OF_CARRIER:
        part = m.heat_split
    elif body == L.OF_WASHER:
        part = 1.0 - m.heat_split
    return mean - kept * part * heat / area, area, part


@kernel
def fill_rates(
    w: Workspace, pt: Point, cont: Array, heat: float, kept: float, der: Array
) -> tuple[float, float]:
    """Fill rates of the mean temperatures; return what is stored per time [W], and stored [J]."""
    m, grows, stored = model_of(w), 0.0, 0.0
    for body in BODIES:
        b, place = body_of(m, body), state_of(body)
        flux, area, _ = flow_into(w, body, heat, kept)
        if body == L.OF_WASHER:
            der[place] = flux / b.storage
            grows += area * flux
            stored += area * b.storage * cont[place]
        else:
            total = 0.0
            for k in range(terms_of(body)):
                t, mean = term(b, k), mean_term(b, pt, body, k, cont)
                rate = (t.resistance * flux - mean) / t.time if t.time > 0.0 else flux / t.holds
                total += rate
                grows += area * t.holds * rate
                if k > 0:
                    der[np.uintp(place + k)] = rate
            der[place] = total
            stored += area * stored_over(b, place, body, cont)
    return grows, stored


@kernel
def stored_over(b: Body, place: int, body: int, states: Array) -> float:
    """Return the heat [J/m^2] over states, or changes of them, of a body with a ladder."""
    first, stored = states[place], 0.0
    for k in range(1, terms_of(body)):
        first -= states[np.uintp(place + k)]
        stored += term(b, k).holds * states[np.uintp(place + k)]
    return stored + term(b, 0).holds * first


@kernel
def fill_rate_changes(
    w: Workspace, change: Point, along: Array, fluxes: Array, found: Array
) -> tuple[float, float]:
    """Fill changes of the rates as states move ``along`` and mean fluxes change by ``fluxes`` (3,).

    Returns the changes of what is stored per time [W], and of what is stored [J].
    """
    m, grows, stored = model_of(w), 0.0, 0.0
    for body in BODIES:
        b, place = body_of(m, body), state_of(body)
        flux, f = fluxes[body - L.OF_CARRIER], fields_of(w)
        _, area = mean_of(m, b, f.flux)
        if body == L.OF_WASHER:
            found[place] = flux / b.storage
            grows += area * flux
            stored += area * b.storage * along[place]
        else:
            total, far, first = 0.0, far_of(change, body), along[place]
            first -= far
            for k in range(terms_of(body) - 1, -1, -1):
                t, mean = term(b, k), first
                if k > 0:
                    mean = along[np.uintp(place + k)] - t.falls * far
                    first -= mean
                rate = (t.resistance * flux - mean) / t.time if t.time > 0.0 else flux / t.holds
                total += rate
                grows += area * t.holds * rate
                if k > 0:
                    found[np.uintp(place + k)] = rate
            found[place] = total
            stored += area * stored_over(b, place, body, along)
    return grows, stored


@kernel
def hold_for_slopes(w: Workspace, along: Array) -> None:
    """Have derivatives be those of held bodies; ``along``: the change of the states."""
    f = fields_of(w)
    for body in BODIES:
        f.small[L.OUT_OIL + body - L.OF_CARRIER] = 1.0
        f.small[L.WARMED + body - L.OF_CARRIER] = along[state_of(body)]


@kernel
def flux_changes(w: Workspace, pt: Point, change: Point, fluxes: Array) -> None:
    """Fill changes of the mean fluxes (3,) after `differentiate`."""
    m, f = model_of(w), fields_of(w)
    dq, dtemp = vector(f.small, L.CHANGE), f.keep[: f.temp.size]
    out = f.small[L.OUT_CARRIER : L.OUT_SIZE]
    clear(out)
    clear(f.small[L.WARMED : L.N_SMALL])
    let_film_follow(m, pt, change, w.q, dq, dtemp, f)
    heat_change(m, pt, change, w.q, dq, dtemp, f, f.heat)
    out[0], out[1], out[2] = HELD, HELD, HELD
    for body in BODIES:
        b, total = body_of(m, body), 0.0
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                total -= f.heat[np.uintp(b.at + j * b.step + i)]
        _, area = mean_of(m, b, f.flux)
        fluxes[body - L.OF_CARRIER] = total / area


@kernel
def fill_flux_changes(
    w: Workspace, kept: tuple[float, float], changes: tuple[float, float], fluxes: Array
) -> None:
    """Add to the changes of the fluxes of sliding those of what is not made near rest.

    ``kept``: heat and share as of `flow_into`, ``changes``: their changes.
    """
    moved = kept[1] * changes[0] + changes[1] * kept[0]
    for body in BODIES:
        _, area, part = flow_into(w, body, 0.0, 0.0)
        fluxes[body - L.OF_CARRIER] -= part * moved / area
