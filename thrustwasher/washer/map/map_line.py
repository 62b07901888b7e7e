"""One line of a map: the curve of solutions at one speed, tilt and oil temperature."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...errors import SolveError
from ...numerics.jit import Array
from ..kernels import layout as L
from ..kernels.map import map_layout as M
from ..load_curve import Continuation
from ..washer_result import Inputs
from .map_plan import COARSE, ONSET, MapPlan, Place

TINY = 1e-290
ENTRY = 6.0  # film ratio at which a walk begins
LARGEST_STEP = 0.35  # [sigma] near contact
NUDGE = 2e-3  # film ratio: how far a solution is moved to be solved at another point
MARK = 1e-3  # relative, of the contact load where a piece ends


@dataclass(frozen=True)
class LineTask:
    """Where a line lies and how its pieces are cut."""

    plan: MapPlan
    reach: float  # 1/Pa, of thick films
    grid: tuple[int, int]
    terms: tuple[int, ...]  # nodes of each piece
    place: Place

    @property
    def inputs(self) -> Inputs:
        """Return the inputs, of no load."""
        return 1.0, *self.place, 0.0

    @cached_property
    def scale(self) -> float:
        """Viscosity x speed [Pa]."""
        return self.plan.viscosity(self.place[2]) * self.place[0]

    @property
    def thickest(self) -> float:
        """The largest film ratio."""
        return math.sqrt(M.LEAST_REACH**2 + self.reach * self.scale)


class Line:
    """A place on the curve of solutions, read off as the logarithms of the map."""

    def __init__(self, task: LineTask, grid: tuple[int, int]) -> None:
        self.task = task
        self.at = Continuation(task.plan.params, task.inputs, grid)
        m = self.at.m
        self.sigma = m.sigma1
        self.weight2, self.moment1, self.moment2 = (
            np.outer(m.weight_t, w).ravel() for w in (m.weight2, m.weight1 * m.r, m.weight2 * m.r)
        )
        self.at.w.curve[L.ACCURACY] = max(1e-7, 2e-2 * task.plan.tolerance)  # of Newton's method
        self.at.start(ENTRY)
        self.slope = -2.5  # of ln(contact load) over the film ratio, where it was last required

    def take_over(self, task: LineTask, kept: list[Array]) -> None:
        """Go to another line, where a solution of this one was."""
        self.task = task
        self.at.move(task.inputs)
        self.at.come_back(kept)
        self.to(self.ratio + NUDGE)

    @property
    def ratio(self) -> float:
        """Film ratio here."""
        return float(self.at.film / self.sigma)

    @property
    def contact(self) -> float:
        """Contact load [N] here."""
        return float(self.at.f.small[L.CONTACT])

    def to(self, ratio: float) -> None:
        """Continue to a film ratio in steps that Newton's method likes."""
        while self.ratio != ratio:
            here = self.ratio
            down = max(LARGEST_STEP, 0.25 * (here - 2.5))
            up = 0.3 + 0.6 * max(here, 0.0)
            stop = max(ratio, here - down) if ratio < here else min(ratio, here + up)
            close = abs(stop - ratio) < 1e-7
            self.at.to((ratio if close else stop) * self.sigma)
            if close:
                return

    def to_contact(self, load: float, guess: float | None = None) -> float:
        """Continue down to a contact load [N]; return the film ratio there (secant in ln(load))."""
        if guess is None:
            while self.contact < load:
                self.to(self.ratio - LARGEST_STEP)
        else:
            self.to(guess)
        x, y = self.ratio, math.log(self.contact / load)
        if abs(y) < MARK:
            return x
        following = x + 0.05 if guess is None else x - y / self.slope
        for _ in range(20):
            self.to(following)
            before, value = (x, y), math.log(self.contact / load)
            x, y = self.ratio, value
            if y != before[1]:
                self.slope = (y - before[1]) / (x - before[0])
            if abs(y) < MARK or y == before[1]:
                return x
            following = x + min(max(-y / self.slope, -LARGEST_STEP), LARGEST_STEP)
        raise SolveError(f"map: no film ratio with a contact load of {load:g} N was found")

    def values(self) -> list[float]:
        """Return the layout's logarithms and two tilts here."""
        out, f = self.at.outputs(), self.at.f
        dry = float(f.small[L.FRICTION] * f.pc.dot(self.moment1))
        grip = float(f.pc2.dot(self.moment2) / f.pc2.dot(self.weight2))
        viscous, contact = out[L.O_TORQUE] - dry, out[L.O_CONTACT_LOAD]
        power, (speed, tilt, oil) = out[L.O_POWER], self.task.place
        carried = 0.0
        if self.task.plan.params.oil_cooling:
            carried = math.log(max(out[L.O_THROUGHFLOW_HEAT], TINY) / (power * speed))
        return [
            math.log(out[L.O_FLUID_LOAD] / self.task.scale),
            math.log(max(contact, TINY)),
            math.log(max(dry, TINY) / max(contact, TINY)),
            math.log(max(viscous, TINY) / self.task.scale),
            *(
                math.log(max(out[k] - oil, TINY) / power)
                for k in (L.O_MEAN, L.O_PEAK, L.O_FILM_TEMPERATURE)
            ),
            math.log(max(out[L.O_OIL_FLOW], TINY) / speed),
            carried,
            math.log(grip),
            float(self.at.w.q[L.TILT_X]) / tilt,
            float(self.at.w.q[L.TILT_Y]) / tilt,
        ]


@dataclass(frozen=True)
class Curve:
    """A line as solved: film ratios of the edges, values at the nodes of the pieces."""

    task: LineTask
    edges: list[float]  # (N_PIECES + 1) from the thick end
    pieces: list[Array]  # (terms, N_CURVES + 2) each, from the thick ends


def solve_lines(tasks: Sequence[LineTask]) -> list[Curve]:
    """Solve lines one after the other, each from where the one before was.

    SolveError: a node could not be solved, or the load of a thick film does not fall with its
    thickness.
    """
    line: Line | None = None
    curves: list[Curve] = []
    guesses, kept = list[float](), list[list[Array]]()
    for task in tasks:
        curve = None
        if line is not None:
            with suppress(SolveError):
                curve, kept = _solved(line, guesses, kept, task)
        if curve is None:
            try:
                coarse = Line(task, COARSE)  # its arrays are those of all lines on this grid
                guesses = [coarse.to_contact(load) for load in task.plan.marks]
                line = Line(task, task.grid)
                curve, kept = _solved(line, guesses)
            except SolveError:
                raise SolveError(
                    f"map: no curve of solutions {_where(task)} up to {task.plan.marks[-1]:.4g} N "
                    "of contact load; leave that out of the box, by load first"
                ) from None
        curves.append(curve)
        guesses = curve.edges[3:]
    return curves


def _solved(
    line: Line, guesses: list[float], kept: Sequence[list[Array]] = (), task: LineTask | None = None
) -> tuple[Curve, list[list[Array]]]:
    """Return a curve, and the solutions at onset and marks; ``kept`` are those of another task."""
    if task is not None:
        line.take_over(task, kept[0])
    task = line.task
    pieces = [np.empty((n, M.N_CURVES + 2)) for n in task.terms]
    edges = [task.thickest, ONSET]
    line.to(ONSET)
    pieces[M.THICK][-1] = pieces[1][0] = line.values()
    found = [line.at.copy()]
    thick = _ratios(edges, M.THICK, task.terms[M.THICK])
    for k in range(len(thick) - 2, -1, -1):  # thick films from thin to thick
        line.to(thick[k])
        pieces[M.THICK][k] = line.values()
    line.at.come_back(found[0])
    marks: list[float] = []
    for k, (load, guess) in enumerate(zip(task.plan.marks, guesses, strict=True)):
        if kept:
            line.take_over(task, kept[k + 1])
            marks.append(line.to_contact(load, line.ratio))
        else:
            marks.append(line.to_contact(load, guess))
        found.append(line.at.copy())
        pieces[k + 2][-1] = line.values()
        if k < 2:
            pieces[k + 3][0] = pieces[k + 2][-1]
    edges += [marks[0] + M.MIDDLE * (ONSET - marks[0]), *marks]
    for piece in range(M.N_PIECES - 1, M.THICK, -1):  # back up, from where the marks ended
        ratios = _ratios(edges, piece, task.terms[piece])
        for k in range(len(ratios) - 2, -1 if piece == 2 else 0, -1):
            line.to(ratios[k])
            pieces[piece][k] = line.values()
        if piece == 2:
            pieces[1][-1] = pieces[2][0]
    pieces[M.THICK][:, [M.GC, M.DRY]] = 0.0
    curve = Curve(task, edges, pieces)
    _check(curve)
    return curve, found


def nodes_of(n: int) -> Array:
    """Return the nodes of a piece from its thick end."""
    return np.asarray(np.cos(np.pi * np.arange(n) / (n - 1)))


def fit_of(n: int) -> Array:
    """Return the matrix from values at the nodes of a piece to its coefficients."""
    vander = np.polynomial.chebyshev.chebvander(nodes_of(n), n - 1)
    return np.linalg.inv(vander).astype(np.float64)


def slope_of(n: int) -> Array:
    """Return the matrix from values at the nodes of a piece to slopes there, over -1 .. 1."""
    sums = np.polynomial.chebyshev.chebder(fit_of(n))
    vander = np.polynomial.chebyshev.chebvander(nodes_of(n), n - 2)
    return np.asarray(vander @ sums)


def _ratios(edges: list[float], piece: int, n: int) -> list[float]:
    """Return the film ratios of a piece's nodes from its thick end."""
    thick, thin = edges[piece], edges[piece + 1]
    if piece == M.THICK:
        thick, thin = math.log(thick), math.log(thin)
    at = 0.5 * ((1.0 + nodes_of(n)) * thick + (1.0 - nodes_of(n)) * thin)
    return [float(x) for x in (np.exp(at) if piece == M.THICK else at)]


def _check(curve: Curve) -> None:
    """Refuse what a look-up could not search."""
    where = _where(curve.task)
    if not all(np.all(np.isfinite(piece)) for piece in curve.pieces):
        raise SolveError(f"map: a solution is not finite {where}")
    thick = curve.pieces[M.THICK][:, M.GF]
    if np.any(np.diff(thick) <= 0.0):  # it has to rise towards the thin end
        raise SolveError(f"map: the load does not rise as a thick film gets thinner {where}")


def _where(task: LineTask) -> str:
    speed, tilt, oil = task.place
    return f"at speed = {speed:.4g} rad/s, tilt = {tilt:.4g} rad, oil_temperature = {oil:.4g} K"


def packed(curve: Curve, more_terms: Sequence[int]) -> Array:
    """Return head and coefficients of a line; the curves next to load and torque are cut."""
    parts: list[Array] = []
    sums = [fit_of(len(piece)) @ piece for piece in curve.pieces]  # (terms, N_CURVES + 2)
    for part, more in zip(sums, more_terms, strict=True):
        tilts = np.zeros((2, M.N_TILT_TERMS))
        kept = min(len(part), M.N_TILT_TERMS)
        tilts[:, :kept] = part[:kept, M.N_CURVES :].T
        main, others = part[:, : M.N_MAIN].T, part[:more, M.N_MAIN : M.N_CURVES].T
        parts += [main.ravel(), others.ravel(), tilts.ravel()]
    return np.concatenate([curve.edges[3:], [_steepest(curve, sums)], *parts])


def _steepest(curve: Curve, sums: list[Array]) -> float:
    """Return the largest slope of ln(load) over the film ratio where asperities touch."""
    chebyshev = np.polynomial.chebyshev
    u = np.linspace(-1.0, 1.0, 81)
    steepest = -np.inf
    for piece in range(1, M.N_PIECES - 1):
        fits = [sums[piece][:, k] for k in (M.GF, M.GC)]
        loads = [
            factor * np.exp(chebyshev.chebval(u, c))
            for factor, c in zip((curve.task.scale, 1.0), fits, strict=True)
        ]
        slopes = [
            w * chebyshev.chebval(u, chebyshev.chebder(c)) for w, c in zip(loads, fits, strict=True)
        ]
        half = 0.5 * (curve.edges[piece] - curve.edges[piece + 1])
        steepest = max(steepest, float(np.max(sum(slopes) / sum(loads)) / half))
    return steepest
