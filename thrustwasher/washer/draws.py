"""Many washers at one point each: draws of scattered parameters and inputs.

Solved alone, a draw whose film may be lost takes a descent along its curve of solutions. Here the
draws solved before say about where a solution and the fold lie, and Newton's method with the draw's
own equations finds them. Which branch it is on is read off its own curve (`Bench._explore`), never
taken from a neighbour; where that does not settle it, the draw is solved as a single washer is.

What a batch returns depends on the batch alone: nothing is kept from one to the next.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FIRST_FAILURE, ParameterError, Status
from ..model.parameters import as_numbers
from ..native.load import bound
from ..numerics.jit import Array
from ..numerics.status import NO_BRANCH, NOT_FINITE, OK
from . import solve as single
from .draw_constants import Constants
from .kernels import continuation
from .kernels import layout as L
from .kernels import step as kernel
from .kernels.branch import CLEAR_SHARE, DESCENT, ENTRY_RATIO, FILM_RATIO, NOISE
from .kernels.constants import washer_model
from .kernels.heat import far_rise, set_steady
from .kernels.newton import FILM, LOAD, NO_FLOOR, film_ratio, newton, smooth_film
from .kernels.outputs import outputs_at
from .kernels.regime_and_status import LEAST_LOAD, point_of
from .kernels.workspace import (
    Point,
    fields_of,
    forget_factor,
    size_of_state,
    size_of_work,
    workspace_of,
)
from .neighbours import Family, chain, spread
from .parameters import SPEC, WasherParams
from .solve import GRIDS, check_far_face, solve_washer
from .washer_result import INPUTS

TOLERANCE = 1e-7  # of a solution: torque within 1e-6 of that of a single solve
ROUGHLY, CLOSELY = 1e-3, 1e-5  # of places on the curve around a fold
CHORDS, AFRESH = 12.0, 8.0  # iterations with another draw's heat factor, then with its own
BESIDE, CLOSE = 0.25, 0.05  # [sigma] between places around a fold
SURE = 5.0  # times the accuracy: distance of a load to the fold that settles the branch
STEEP = 0.3  # relative change of the load over one sigma that makes a solution surely stable
DRY = 0.9  # share of the load on the asperities from which no fold will come
GROWING = 1.08  # load from place to place where no fold is near: a longer step follows
MOST = 40  # places to look at
UPPER, LOWER = 1.0, -1.0  # fold that a washer meets which comes from light load, from heavy load
THIN = {UPPER: 2.4, LOWER: 1.2}  # [sigma] where a curve without folds is looked at first
SHOWN = L.O_STICK_MARGIN + 1  # outputs that make sense for a single point
NOTHING = np.zeros(0)
Answer = tuple[Array, int, bool]  # outputs (SHOWN,), status, whether the film is lost


class CurvePlace:
    """A place on a curve of solutions, with a heat factor of its own that serves the next draw."""

    def __init__(self, par: Array, nodes: tuple[int, int]) -> None:
        self.work = np.zeros(L.N_HEAD + size_of_work(*nodes))
        self.w = workspace_of(par, self.work)
        self.f = fields_of(self.w)
        self.newton = bound(newton, w=self.w)
        self.walk_to = bound(continuation.walk_to, w=self.w)
        self.outputs = bound(outputs_at, w=self.w)

    def begin(self, m: Any, pt: Point) -> None:
        """Take another washer and point."""
        f = self.f
        if far_rise(pt) == 0.0:  # a loop over all temperatures, which is not compiled by itself
            f.outward[:] = 0.0
            f = f._replace(outward=NOTHING)
        set_steady(m, pt, f)

    def solve(self, pt: Point, mode: float, target: float, tolerance: float) -> bool:
        """Solve from here; tell if that worked."""
        for iterations in (CHORDS, AFRESH):
            if self.newton(pt, mode, target, NO_FLOOR, tolerance, iterations) == OK:
                return True
            forget_factor(self.w)
        return False

    @property
    def film(self) -> float:
        """Smoothed film thickness over roughness."""
        return smooth_film(self.w) / float(self.w.par[L.D_SIGMA1])

    @property
    def load_slope(self) -> float:
        """Relative change of the load over one sigma of film, about: by the factor in use."""
        w = self.w
        return float(w.info[L.LOAD_SLOPE] * w.par[L.D_SIGMA1] / w.info[L.REACHED_LOAD])

    def take(self, pt: Point) -> Array:
        """Return the solution here as that with the smallest change from washer to washer.

        Minimum gaps of both films and tilts across them, over roughness; temperatures, pressures.
        """
        ro, sigma1, sigma2 = self._lengths()
        z_w, z_g, gx, gy = self.w.q.tolist()
        rel = pt.tilt - gy
        gap = (z_g - z_w - ro * math.hypot(rel, gx)) / sigma2
        head = math.asinh(self.film), gap, gx * ro / sigma1, rel * ro / sigma2
        return np.concatenate((head, self.f.temp, self.f.p))

    def put(self, pt: Point, y: Array) -> None:
        """Go to what `take` returned, of another washer or guessed."""
        (ro, sigma1, sigma2), q, f = self._lengths(), self.w.q, self.f
        film, gap, across, lean = y[:4].tolist()
        gx, rel = across * sigma1 / ro, lean * sigma2 / ro
        q[L.Z_WASHER], q[L.TILT_X], q[L.TILT_Y] = 0.0, gx, pt.tilt - rel
        q[L.Z_WASHER] = math.sinh(film) * sigma1 - smooth_film(self.w)
        q[L.Z_GEAR] = q[L.Z_WASHER] + gap * sigma2 + ro * math.hypot(rel, gx)
        end = 4 + f.temp.size
        f.temp[:] = y[4:end]
        np.maximum(y[end : end + f.p.size], 0.0, out=f.p)

    def _lengths(self) -> tuple[float, float, float]:
        par = self.w.par
        return float(par[L.P_OUTER_RADIUS]), float(par[L.D_SIGMA1]), float(par[L.D_SIGMA2])


class Bench:
    """Where draws are solved one after the other, and what was found so far.

    All have equations of the same shape. ``above``: the draws come from heavy load, along the
    contact branch down to its fold; else from light load, along the film branch up to its own.
    """

    def __init__(self, par: Array, nodes: tuple[int, int], *, above: bool) -> None:
        self.par, self.fold_kind = par.copy(), LOWER if above else UPPER
        self.own, self.other = ("contact", "film") if above else ("film", "contact")
        self.places = {name: CurvePlace(self.par, nodes) for name in ("film", "contact", "fold")}
        self.known = {name: Family() for name in self.places}
        self.plain = CurvePlace(self.par, nodes)
        self.state, self.inp = np.zeros(size_of_state(*nodes)), np.zeros(L.NINP + 1)
        self.inp[L.I_BRANCH] = L.CONTACT_BRANCH if above else L.ANY
        self.step = bound(
            kernel.step,
            par=self.par,
            inp=self.inp,
            state=self.state,
            work=self.plain.work,
            out=np.zeros(L.NOUT),
            iout=np.zeros(L.NIOUT, np.int32),
        )
        self.alone = 0  # draws that were solved as a single washer is

    def solve(self, x: Array, par: Array, point: Sequence[float]) -> Answer:
        """Solve a draw: ``x`` (k,) is its place among the others, ``point`` (5,) its inputs."""
        self.par[:], self.inp[: L.NINP] = par, point
        pt, m = point_of(self.par, self.inp), washer_model(self.par)
        for place in self.places.values():
            place.begin(m, pt)
        fold = self.known["fold"].guess(x)
        if fold is None or pt.tilt == 0.0 or pt.speed == 0.0:
            return self._alone(x, pt)
        arrived = ""
        if self._carries(pt, float(fold[-1])) and self._arrives(self.own, x, pt):
            arrived = self.own
            if self._is_clear(pt, float(fold[-2])):
                return self._answer(self.own, x, pt)
        found = self._explore(x, pt, fold)
        if found is None:
            return self._alone(x, pt)
        carries, top = found
        name = self.own if carries else self.other
        if carries is None:
            name = "contact" if math.log(pt.load) > fold[-1] else "film"
        if name != arrived and not self._arrives(name, x, pt):
            return self._alone(x, pt)
        film = self.places[name].film
        if carries is None:  # one solution at every load
            lost = film_ratio(self.places[name].w) < FILM_RATIO
            return self._answer(name, x, pt, "contact" if lost else "film")
        if film > top if name == "film" else film < top:
            return self._answer(name, x, pt)
        return self._alone(x, pt)

    def _carries(self, pt: Point, log_load: float) -> bool:
        """Tell if the branch that the draws come along carries their load, its fold at a load."""
        return self.fold_kind * (math.log(pt.load) - log_load) <= 0.0

    def _arrives(self, name: str, x: Array, pt: Point) -> bool:
        """Solve from what draws on a branch say; tell if that led to a solution."""
        guess = self.known[name].guess(x)
        if guess is None:
            return False
        self.places[name].put(pt, guess)
        return self.places[name].solve(pt, LOAD, pt.load, TOLERANCE)

    def _is_clear(self, pt: Point, top: float) -> bool:
        """Tell if the solution is surely on the branch that the draws come along.

        A stable, thick film carried by oil is on the film branch; a solution as steep as asperities
        make it, clearly thinner than the fold's film, is on the contact branch.
        """
        place = self.places[self.own]
        ratio = film_ratio(place.w)
        if self.own == "film":
            by_contact = place.f.small[L.CONTACT] / pt.load
            return bool(place.load_slope < 0.0 and ratio >= FILM_RATIO and by_contact < CLEAR_SHARE)
        return place.load_slope < -STEEP and place.film < min(top - BESIDE, FILM_RATIO)

    def _explore(self, x: Array, pt: Point, guess: Array) -> tuple[bool | None, float] | None:
        """Tell if the branch that the draws come along carries the load, and the fold's film.

        Places on the draw's own curve are solved around the supposed fold, until one between two
        others carries most (minimum, at the lower fold): the curve is bent one way there, so that
        the fold's load is no farther from the middle place than that is from the others. If the
        load only grows from a thick film until asperities carry it, there is no fold: None, as a
        load has one solution.
        Nothing is returned if that fails, or the load is too near to the fold's.
        """
        place, sign = self.places["fold"], self.fold_kind
        w, sigma, top = place.w, float(self.par[L.D_SIGMA1]), float(guess[-2])
        place.put(pt, guess)
        if not place.solve(pt, FILM, top * sigma, ROUGHLY):
            return None
        continuation.note(w)
        y = place.take(pt)
        for step, accuracy in ((BESIDE, ROUGHLY), (CLOSE, CLOSELY)):
            w.curve[L.ACCURACY] = accuracy
            loads, k, low, high, dry = dict[int, float](), 0, 0, 0, False
            while (found := _extremum(loads, sign)) is None:
                if len(loads) > MOST or place.walk_to(pt, (top + k * step) * sigma) != OK:
                    return None
                growth = float(w.curve[L.AT_LOAD]) / loads.get(low, math.inf)
                loads[k] = float(w.curve[L.AT_LOAD])
                low, high = min(low, k), max(high, k)
                if k == high:
                    continuation.remember(w, 1.0)
                dry = dry or w.curve[L.AT_SHARE] > DRY
                thick = top + (high + 1) * step > ENTRY_RATIO
                highest = [loads[k] for k in sorted(loads)[-2:]]
                rising = high == 0 or sign * (highest[1] - highest[0]) > 0.0
                if dry and thick:
                    return None, top
                if thick and rising and sign > 0.0:
                    return None
                if thick or not (dry or rising):
                    k = low - (2 if k == low < 0 and growth > GROWING else 1)
                    continue
                if k != high:
                    continuation.recall(w, 1.0)
                    forget_factor(w)  # it and the tangent are those of the other end
                    place.f.small[L.TANGENT : L.TANGENT + 4] = 0.0
                    w.curve[L.AT_FILM] = (top + high * step) * sigma
                k = high + (2 if dry else 1)
            (above, middle, below), (after, here, before) = found, (loads[k] for k in found)
            bend = before - 2.0 * here + after
            even = above - middle == middle - below == 1 and bend != 0.0
            top += step * (middle + (0.5 * (before - after) / bend if even else 0.0))
            y = place.take(pt) if middle else y
            beyond = sign * (pt.load - here)
            wide = max(above - middle, middle - below)
            far = wide * max(abs(here - before), abs(here - after)) + SURE * accuracy * here
            if not 0.0 < beyond <= far:
                self.known["fold"].add(x, np.append(y, (top, math.log(here))))
                return bool(beyond <= 0.0), top
        return None

    def _answer(self, name: str, x: Array, pt: Point, branch: str = "") -> Answer:
        """Return the solution at a place, and keep it for other draws."""
        place, branch = self.places[name], branch or name
        self.known[branch].add(x, place.take(pt))
        status = OK if place.outputs(pt) else NOT_FINITE
        return _shown(place), int(status), branch == "contact"

    def _alone(self, x: Array, pt: Point) -> Answer:
        """Solve as a single washer is solved, from nothing."""
        self.alone += 1
        self.state[:] = 0.0
        status = self.step(0.0, 1.0)
        if status == NO_BRANCH:  # what was requested ends before this load: the other one it is
            status = OK
        lost = bool(self.plain.w.found[L.BRANCH] == L.CONTACT_BRANCH)
        if status < FIRST_FAILURE and pt.tilt != 0.0 and pt.speed != 0.0:
            self.known["contact" if lost else "film"].add(x, self.plain.take(pt))
            if self.known["fold"].n < len(x) + 3:
                self._walk(x, pt)
        return _shown(self.plain), int(status), lost

    def _walk(self, x: Array, pt: Point) -> None:
        """Go along the curve to the draw's fold; without one keep where the film gets thin."""
        place = self.places["fold"]
        w, sigma, sign = place.w, float(self.par[L.D_SIGMA1]), UPPER
        w.curve[L.ACCURACY] = ROUGHLY
        if continuation.enter_curve(w, pt, ENTRY_RATIO) != OK:
            return
        passed = [(float(w.curve[L.AT_FILM]), float(w.curve[L.AT_LOAD]))]
        thin = self._here(place, pt)
        while place.walk_to(pt, continuation.step_down(sigma, passed[-1][0], DESCENT)) == OK:
            passed.append((float(w.curve[L.AT_FILM]), float(w.curve[L.AT_LOAD])))
            if place.film > THIN[self.fold_kind]:
                thin = self._here(place, pt)
            if w.curve[L.AT_SHARE] > DRY:
                self.known["fold"].add(x, thin)
                return
            if sign * (passed[-2][1] - passed[-1][1]) > NOISE * passed[-2][1]:
                if sign == self.fold_kind:
                    break
                sign = LOWER
        if continuation.find_fold(w, pt, passed[max(-3, -len(passed))][0], passed[-1][0]) == OK:
            self.known["fold"].add(x, self._here(place, pt))

    @staticmethod
    def _here(place: CurvePlace, pt: Point) -> Array:
        return np.append(place.take(pt), (place.film, math.log(place.w.curve[L.AT_LOAD])))


def _extremum(loads: dict[int, float], sign: float) -> tuple[int, int, int] | None:
    """Return three neighbouring columns, of which the middle one has the maximum (-1: minimum)."""
    order = sorted(loads, reverse=True)
    for three in zip(order, order[1:], order[2:], strict=False):
        one, middle, two = (sign * loads[k] for k in three)
        if middle >= max(one, two):
            return three
    return None


def _shown(place: CurvePlace) -> Array:
    row: Array = place.w.outputs[:SHOWN].copy()
    row[L.O_OIL_HEAT] = row[L.O_POWER]  # steady: all that is made
    return row


def solve_draws(
    params: Sequence[WasherParams | None], inputs: Array, fidelity: str, *, above: bool
) -> tuple[Array, NDArray[np.int32], NDArray[np.bool_]]:
    """Return outputs (n, SHOWN), statuses (n,) and whether the film is lost (n,).

    Parameters
    ----------
    params : of each draw; None: they break a rule
    inputs : (n, 5) of each draw, as the model has them
    fidelity : of the washer's; "map" for draws of one washer, others take long with it
    above : the washer comes from heavy load, else from light load

    Notes
    -----
    A failed draw has a status from `errors.FIRST_FAILURE` on, and NaN. The film is lost on the
    contact branch; where the curve has no folds, below a film ratio of 3.
    """
    if fidelity == "map":
        return _looked_up(params, inputs, above=above)
    nodes, n = GRIDS[fidelity], len(params)
    rows, lost = np.full((n, SHOWN), np.nan), np.zeros(n, bool)
    status, numbers = np.full(n, Status.BAD_INPUT, np.int32), np.zeros((n, L.N_PARAM))
    for i, own in enumerate(params):
        if own is None:
            continue
        try:
            check_far_face(own, float(inputs[i, L.I_FAR_FACE]))
        except ParameterError:
            continue
        numbers[i, :-1], numbers[i, -1] = as_numbers(own), L.FIELD
        numbers[i, L.P_THERMAL_MODE], status[i] = L.QUASI_STEADY, OK
    sound = np.flatnonzero(status == OK)
    x = spread(np.column_stack((numbers, inputs))[sound])
    constants = Constants(numbers[sound], nodes)
    benches: dict[tuple[float, float], Bench] = {}
    for k in chain(x):
        i = sound[k]
        try:
            par = constants(numbers[i])
        except ParameterError:
            status[i] = Status.BAD_INPUT
            continue
        shape = float(par[L.D_PER_COLUMN]), float(par[L.D_RINGS])
        if shape not in benches:
            benches[shape] = Bench(par, nodes, above=above)
        rows[i], status[i], lost[i] = benches[shape].solve(x[k], par, inputs[i].tolist())
    rows[status >= FIRST_FAILURE] = np.nan
    return rows, status, lost


def _looked_up(
    params: Sequence[WasherParams | None], inputs: Array, *, above: bool
) -> tuple[Array, NDArray[np.int32], NDArray[np.bool_]]:
    """Do the same by the map, or outside its box by the field."""
    n, names = len(params), SPEC.real_outputs[:SHOWN]
    share = names.index("fluid_load_share")
    rows, lost = np.full((n, SHOWN), np.nan), np.zeros(n, bool)
    status = np.full(n, Status.BAD_INPUT, np.int32)
    for i, (own, point) in enumerate(zip(params, inputs.tolist(), strict=True)):
        if own is None:
            continue
        at = dict(zip(INPUTS, (max(point[0], LEAST_LOAD), *point[1:]), strict=True))
        wanted: tuple[str | None, ...] = ("contact", None) if above else (None,)
        try:
            for branch in wanted:
                found = solve_washer(own, **at, fidelity="map", branch=branch, throw=False)
                if found.status is not Status.NO_BRANCH:
                    break
        except ParameterError:
            continue
        status[i], lost[i] = found.status, found.branch == "contact"
        if not found.status.is_failure:
            rows[i] = [getattr(found, name, math.nan) for name in names]
            rows[i, share] = found.fluid_load / (found.fluid_load + found.contact_load)
    return rows, status, lost


SWEEP = replace(single.SWEEP, draws=solve_draws)
