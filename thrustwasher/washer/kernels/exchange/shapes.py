# mypy: disable-error-code="no-any-return"
"""Events of bodies that warm up in time, in model exchange: shapes are integrated and kept."""

import math

import numpy as np

from ....numerics.arrays import clear, copy
from ....numerics.jit import Array, kernel
from ....numerics.status import NO_BRANCH, OK
from .. import layout as L
from ..branch import descend, is_cool, solve_cold
from ..continuation import BUDGET
from ..heat import let_out, set_steady
from ..ladder import (
    BODIES,
    body_of,
    fill_means,
    hold_bodies,
    mean_of,
    outside_of,
    shift_terms,
    start_terms,
    state_of,
    terms_of,
)
from ..step import BUDGET_IN_TIME
from ..transient import advance_heat, start_cold
from ..workspace import (
    Point,
    Workspace,
    fields_of,
    forget_factor,
    model_of,
    workspace_of,
)
from .in_time import (
    fill_rates,
    flux_moved,
    foresee,
    gain_of,
    mean_term,
    room_of_film,
    shapes_of,
    solve_held,
    solved_in_time,
    tolerance_of,
)
from .kept import (
    D_BRANCH,
    D_IN_TIME,
    D_KEPT,
    D_LASTS,
    D_NEXT,
    D_NOW,
    D_OIL,
    D_SEVERAL,
    D_SINCE,
    D_SPEED,
    D_STORED,
    D_TILT,
    D_WAS,
    K_POSITIONS,
    SLOWEST,
    arrive,
    keep,
    moving_point,
    point_from,
    take_kept,
    way_of,
    write_point,
)

FIRST, LEAST = 0.01, 1e-5  # s, of shapes: how long those at the start shall do, and the least time
AIM = 2.0  # tolerances that shapes shall be off by at the end


@kernel
def write_shapes(w: Workspace, pt: Point, discrete: Array, t: float) -> None:
    """Keep ladders, the washer's temperatures and fluxes: the fields from now on."""
    m, f = model_of(w), fields_of(w)
    shapes = shapes_of(discrete, f.temp.size)
    for k in range(L.N_TERMS):
        copy(f.ladder[k], shapes[k])
    b = body_of(m, L.OF_WASHER)
    for j in range(b.columns):
        for i in range(m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            shapes[0, node] = f.temp[node]
    copy(f.flux, shapes[L.N_TERMS])
    discrete[D_SINCE] = t
    write_point(pt, discrete[D_WAS:D_KEPT])


@kernel
def read_shapes(w: Workspace, pt: Point, discrete: Array) -> None:
    """Take the kept fields into ladders and temperatures."""
    m, f = model_of(w), fields_of(w)
    shapes = shapes_of(discrete, f.temp.size)
    for k in range(L.N_TERMS):
        copy(shapes[k], f.ladder[k])
    for body in BODIES:
        b, outside = body_of(m, body), outside_of(pt, body)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                rise = shapes[0, node]
                if body == L.OF_WASHER:
                    f.ladder[0, node] = 0.0
                else:
                    rise += outside + shapes[1, node] + shapes[2, node] + shapes[3, node]
                f.temp[node] = rise


@kernel
def meet_states(w: Workspace, pt: Point, cont: Array) -> None:
    """Shift ladders and temperatures so that their means are the states."""
    m, f = model_of(w), fields_of(w)
    for body in BODIES:
        b = body_of(m, body)
        if body != L.OF_WASHER:
            for k in range(terms_of(body)):
                mean, _ = mean_of(m, b, f.ladder[k])
                shift = mean_term(b, pt, body, k, cont) - mean
                for j in range(b.columns):
                    for i in range(b.first, m.n_r):
                        f.ladder[k, np.uintp(b.at + j * b.step + i)] += shift
        mean, _ = mean_of(m, b, f.temp)
        shift = cont[state_of(body)] - pt.oil_temperature - mean
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                f.temp[np.uintp(b.at + j * b.step + i)] += shift


@kernel
def between(one: Point, two: Point) -> Point:
    """Return the middle of two points, not at rest."""
    speed = 0.5 * (one.speed + two.speed)
    if abs(speed) < SLOWEST:
        speed = SLOWEST * way_of(two.speed)
    return Point(
        0.5 * (one.load + two.load),
        speed,
        0.5 * (one.tilt + two.tilt),
        0.5 * (one.oil_temperature + two.oil_temperature),
        0.5 * (one.far_face + two.far_face),
    )


@kernel
def off_by(w: Workspace) -> float:
    """Return how far ``f.outward`` is from the bodies' temperatures, in tolerances."""
    m, f, most = model_of(w), fields_of(w), 0.0
    for body in BODIES:
        b = body_of(m, body)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                most = max(most, abs(f.outward[node] - f.temp[node]))
    return most / tolerance_of(m, f)


@kernel
def lasts(w: Workspace, before: float, since: float, off: float, discrete: Array) -> float:
    """Return for how long shapes shall do that are made now [s].

    The last ones have done for ``since`` and were ``off`` tolerances at the end; ``before``: for
    how long they should.
    """
    m, f = model_of(w), fields_of(w)
    shapes, h = shapes_of(discrete, f.temp.size), before
    if since > 0.0:
        h = since * max(0.2, 0.9 * math.sqrt(AIM / max(off, 1e-6)))
        h = min(h, 3.0 * max(since, before))
    most = AIM * tolerance_of(m, f)
    for body in BODIES:
        b = body_of(m, body)
        moved = flux_moved(w, body, shapes)
        for _ in range(60):
            if h <= LEAST or not 0.5 * gain_of(b, body, h) * moved > most:
                break
            h *= 0.7
    return max(h, LEAST)


@kernel
def advance(w: Workspace, pt: Point, cont: Array, discrete: Array, since: float) -> int:
    """Bring the fields to now, at the inputs in the middle, about the states; return a status."""
    was, end = point_from(discrete[D_WAS:D_KEPT]), point_from(discrete[D_KEPT:K_POSITIONS])
    middle = between(was, end)
    read_shapes(w, was, discrete)
    warmer = middle.oil_temperature - was.oil_temperature
    shift_terms(w, warmer, middle.far_face - was.far_face)
    forget_factor(w)
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET_IN_TIME
    status, _, _ = advance_heat(w, middle, since, since)
    w.info[L.BUDGET] = 0.0
    if status != OK:
        return status
    warmer = pt.oil_temperature - middle.oil_temperature
    shift_terms(w, warmer, pt.far_face - middle.far_face)
    meet_states(w, pt, cont)
    return OK


@kernel
def name_film(w: Workspace, pt: Point, discrete: Array) -> int:
    """Tell which branch the film stands for, and if there are several; return a status.

    The steady curve has folds or not; it is walked along only where the film is lost.
    """
    lost = room_of_film(w) <= 0.0
    discrete[D_BRANCH] = L.CONTACT_BRANCH if lost else L.FILM_BRANCH
    if not lost:
        return OK
    speed, tilt, oil = discrete[D_SPEED], discrete[D_TILT], discrete[D_OIL]
    near = abs(pt.speed - speed) <= 0.05 * abs(speed) and abs(pt.tilt - tilt) <= 0.05 * tilt
    if discrete[D_SEVERAL] != 0.0 and near and abs(pt.oil_temperature - oil) <= 3.0:
        return OK
    discrete[D_SPEED], discrete[D_TILT], discrete[D_OIL] = pt.speed, pt.tilt, pt.oil_temperature
    discrete[D_SEVERAL] = L.SINGLE
    if is_cool(w, pt):
        return OK
    m, f = model_of(w), fields_of(w)
    let_out(m, pt, f)
    forget_factor(w)
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET
    status = descend(w, pt, L.CONTACT_BRANCH)
    w.info[L.BUDGET] = 0.0
    if (status == OK or status == NO_BRANCH) and w.found[L.MULTIPLICITY] == L.MULTIPLE:
        discrete[D_SEVERAL] = L.MULTIPLE
    return take_kept(w, discrete)


@kernel
def start_in_time(
    par: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill states and fields of a washer that has been as warm for long; return a status."""
    pt, w = moving_point(par, inp), workspace_of(par, work)
    m, f = model_of(w), fields_of(w)
    discrete[D_IN_TIME], discrete[D_NOW] = 1.0, t
    clear(w.info)
    clear(w.curve)
    clear(f.small[L.WARMED : L.N_SMALL])
    set_steady(m, pt, f)
    if par[L.P_THERMAL_START] == L.FROM_OIL:
        start_cold(w)
    w.info[L.BUDGET] = BUDGET
    status = solve_cold(w, pt, L.ANY)
    if status == OK or status == NO_BRANCH:
        forget_factor(w)
        status = arrive(w, pt)
    w.info[L.BUDGET] = 0.0
    if status != OK:
        return status
    start_terms(w, pt)
    fill_means(w, pt, cont)
    hold_bodies(w)
    forget_factor(w)
    status = solve_held(w, pt)
    if status != OK:
        return status
    discrete[D_STORED] = 0.0
    _, stored = fill_rates(w, pt, cont, 0.0, 0.0, f.dtemp)
    discrete[D_STORED] = stored
    clear(shapes_of(discrete, f.temp.size)[L.N_TERMS])
    if par[L.P_THERMAL_START] != L.FROM_OIL:
        copy(f.flux, shapes_of(discrete, f.temp.size)[L.N_TERMS])
    discrete[D_LASTS] = lasts(w, FIRST, 0.0, 0.0, discrete)
    write_shapes(w, pt, discrete, t)
    keep(w, pt, discrete)
    discrete[D_NEXT] = t + discrete[D_LASTS]
    status = name_film(w, pt, discrete)
    if status != OK:
        return status
    return solved_in_time(par, inp, cont, discrete, work)


@kernel
def update_in_time(
    par: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Bring shapes and what else is discrete to an event at ``t``; return a status."""
    pt, w = moving_point(par, inp), workspace_of(par, work)
    discrete[D_NOW] = t
    since, off, before = max(t - discrete[D_SINCE], 0.0), 0.0, discrete[D_LASTS]
    clear(w.info)
    clear(w.found)
    clear(w.curve)
    status = take_kept(w, discrete)
    if status != OK:
        return status
    if since > 0.0:
        status = advance(w, pt, cont, discrete, since)
        if status != OK:
            return status
        foresee(w, pt, cont, discrete)
        off = off_by(w)
    else:
        read_shapes(w, point_from(discrete[D_WAS:D_KEPT]), discrete)
        meet_states(w, pt, cont)
    hold_bodies(w)
    forget_factor(w)
    status = solve_held(w, pt)
    if status != OK:
        return status
    discrete[D_LASTS] = lasts(w, before, since, off, discrete)
    write_shapes(w, pt, discrete, t)
    discrete[D_NEXT] = t + discrete[D_LASTS]
    keep(w, pt, discrete)
    status = name_film(w, pt, discrete)
    if status != OK:
        return status
    return solved_in_time(par, inp, cont, discrete, work)
