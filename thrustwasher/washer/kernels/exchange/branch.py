# mypy: disable-error-code="no-any-return"
"""Solutions on the branch that a washer is on, or at the fold that ends it."""

from ....numerics.jit import kernel
from ....numerics.status import MAX_ITERATIONS, OK
from .. import layout as L
from ..branch import DESCENT, is_clear_film, settle
from ..continuation import exact_slope, find_fold, note, walk_to
from ..newton import FILM, NO_FLOOR, film_ratio, newton, smooth_film
from ..solve import CONTINUOUS, FLAT
from ..workspace import Point, Workspace, forget_factor
from .kept import arrive

EXACTLY = 1e-9  # of a point on the way to a fold
MOST_STEPS = 200  # along the curve of solutions
NOISE = 1e-7  # of a load, which has an extremum where it changes back by more


@kernel
def room_here(w: Workspace, load: float) -> float:
    """Return how steeply the load falls with the film, in loads per roughness, 1 at most."""
    return min(-w.info[L.LOAD_SLOPE] * w.par[L.D_SIGMA1] / load, 1.0)


@kernel
def stays(w: Workspace, pt: Point, on_film: bool, before: float) -> tuple[bool, float]:
    """Tell if a solution is on the branch of the film ratio ``before``; return its room too."""
    if on_film and is_clear_film(w):
        return True, room_here(w, pt.load)
    ratio = film_ratio(w)
    if not abs(ratio - before) < CONTINUOUS:
        return False, 0.0
    if room_here(w, pt.load) < FLAT:  # the slope is needed with a heat factor made here
        forget_factor(w)
        if arrive(w, pt) != OK or not abs(film_ratio(w) - ratio) < 0.5 * CONTINUOUS:
            return False, 0.0
    room = room_here(w, pt.load)
    return room > 0.0, room


@kernel
def follow(w: Workspace, pt: Point, on_film: bool) -> tuple[int, float]:
    """Walk along the curve of solutions from here to the load, or to the fold that ends the branch.

    Returns a status and the room: below 0 the relative load that is missing at the fold.
    """
    sigma = w.par[L.D_SIGMA1]
    w.curve[L.ACCURACY] = EXACTLY
    forget_factor(w)
    status = newton(w, pt, FILM, smooth_film(w), NO_FLOOR, EXACTLY, 40.0)
    if status == OK:
        note(w)
        status = exact_slope(w, pt)
    if status != OK:
        return status, 0.0
    if not w.curve[L.AT_SLOPE] < 0.0:  # the fold has come past
        thicker, back = on_film, True
    else:
        thicker, back = w.curve[L.AT_LOAD] >= pt.load, False
    s0, w0 = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
    s1, w1 = s0, w0
    for _ in range(MOST_STEPS):
        step = max(0.5 * DESCENT * sigma, 0.12 * (s1 - 2.5 * sigma))
        status = walk_to(w, pt, s1 + step if thicker else s1 - step)
        if status != OK:
            return status, 0.0
        s2, w2 = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
        grows = w2 > w1
        if back and grows != thicker:  # the slope is that of the branch again
            back = False
            if exact_slope(w, pt) != OK:
                return MAX_ITERATIONS, 0.0
            status = find_fold(w, pt, s2, s0)
            if status != OK:
                return status, 0.0
            fold, most = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
            over = pt.load > most if on_film else pt.load < most
            if over:
                return OK, -abs(pt.load - most) / pt.load
            if (w2 < pt.load) == on_film:
                upper, lower = (s2, fold) if on_film else (fold, s2)
                return settle(w, pt, upper, lower), 1.0
            if walk_to(w, pt, s2) != OK:
                return MAX_ITERATIONS, 0.0
        elif not back and thicker and w2 < pt.load <= w1:
            return settle(w, pt, s2, s1), 1.0
        elif not back and not thicker and w2 >= pt.load > w1:
            return settle(w, pt, s1, s2), 1.0
        elif not back and (w2 - w1 if thicker else w1 - w2) > NOISE * w1:  # past a fold
            status = find_fold(w, pt, s0, s2)
            if status != OK:
                return status, 0.0
            fold, most = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
            if most < pt.load if thicker else most >= pt.load:
                return settle(w, pt, fold if thicker else s0, s0 if thicker else fold), 1.0
            return OK, -abs(pt.load - most) / pt.load
        s0, w0, s1, w1 = s1, w1, s2, w2
    return MAX_ITERATIONS, 0.0
