"""One line of a map: the curve of solutions at one speed, tilt and oil temperature."""

import math
from dataclasses import dataclass

import numpy as np

from ...errors import SolveError
from ...numerics.chebyshev import N_TERMS
from ...numerics.jit import Array
from ..kernels import layout as L
from ..kernels.map import map_layout as M
from ..kernels.workspace import Point
from ..load_curve import Continuation
from ..parameters import WasherParams
from .map_plan import COARSE, ONSET

TINY = 1e-290
ENTRY = 6.0  # film ratio at which a walk begins
LARGEST_STEP = 0.35  # [sigma] near contact
MARK = 1e-5  # relative, of the contact load where a piece ends
NODES = np.cos(np.pi * np.arange(N_TERMS) / (N_TERMS - 1))  # from the thick end
_FIT = np.linalg.inv(np.polynomial.chebyshev.chebvander(NODES, N_TERMS - 1))


@dataclass(frozen=True, kw_only=True)
class LineTask:
    """Where a line lies and how its pieces are cut."""

    params: WasherParams
    speed: float  # rad/s
    tilt: float  # rad
    oil_temperature: float  # K
    scale: float  # viscosity x speed [Pa]
    thickest: float  # film ratio
    marks: tuple[float, float, float]  # N
    grid: tuple[int, int]


class Line:
    """A place on the curve of solutions, read off as the six logarithms of the map."""

    def __init__(self, task: LineTask, grid: tuple[int, int]) -> None:
        point = Point(1.0, task.speed, task.tilt, task.oil_temperature)
        self.at, self.task = Continuation(task.params, point, grid), task
        self.sigma = self.at.m.sigma1
        self.at.w.curve[L.ACCURACY] = 1e-7
        self.at.start(ENTRY)

    @property
    def ratio(self) -> float:
        """Film ratio here."""
        return float(self.at.film / self.sigma)

    @property
    def contact(self) -> float:
        """Contact load [N] here."""
        return float(self.at.f.small[L.CONTACT])

    def to(self, ratio: float) -> None:
        """Walk to a film ratio in steps that Newton's method likes."""
        while self.ratio != ratio:
            here = self.ratio
            down = max(LARGEST_STEP, 0.25 * (here - 2.5))
            stop = max(ratio, here - down) if ratio < here else min(ratio, 1.4 * here + 0.3)
            close = abs(stop - ratio) < 1e-7
            self.at.to((ratio if close else stop) * self.sigma)
            if close:
                return

    def to_contact(self, load: float, guess: float | None = None) -> float:
        """Walk down to a contact load [N]; return the film ratio there (secant in ln(load))."""
        if guess is None:
            while self.contact < load:
                self.to(self.ratio - LARGEST_STEP)
        else:
            self.to(guess)
        x, y = self.ratio, math.log(self.contact / load)
        following = x + (0.05 if guess is None else 0.4 * y)
        for _ in range(20):
            self.to(following)
            before, value = (x, y), math.log(self.contact / load)
            x, y = self.ratio, value
            if abs(y) < MARK or y == before[1]:
                return x
            following = x - y * (x - before[0]) / (y - before[1])
        raise SolveError(f"map: no film ratio with a contact load of {load:g} N was found")

    def values(self) -> list[float]:
        """Return the layout's six logarithms and two tilts here."""
        out, m, f = self.at.outputs(), self.at.m, self.at.f
        pressure = f.pc[: m.n_r * m.n_t].reshape(m.n_t, m.n_r)
        dry = float(f.small[L.FRICTION] * (np.outer(m.weight_t, m.weight1 * m.r) * pressure).sum())
        viscous, contact = out[L.O_TORQUE] - dry, out[L.O_CONTACT_LOAD]
        power = out[L.O_TORQUE] * self.task.speed
        oil = self.task.oil_temperature
        return [
            math.log(out[L.O_FLUID_LOAD] / self.task.scale), math.log(max(contact, TINY)),
            math.log(max(viscous, TINY) / self.task.scale),
            math.log(max(dry, TINY) / max(contact, TINY)),
            math.log((out[L.O_MEAN] - oil) / power),
            math.log((out[L.O_PEAK] - oil) / power),
            float(self.at.w.q[L.TILT_X]) / self.task.tilt,
            float(self.at.w.q[L.TILT_Y]) / self.task.tilt,
        ]  # fmt: skip


def solve_line(task: LineTask) -> Array:
    """Return one line of the map, (LINE,).

    SolveError: a node could not be solved, or the load of a thick film does not fall with its
    thickness.
    """
    line = Line(task, COARSE)
    guesses = [line.to_contact(load) for load in task.marks]
    line = Line(task, task.grid)
    kept = line.at.copy()
    pieces = np.empty((M.N_PIECES, N_TERMS, M.N_CURVES + 2))
    edges = [task.thickest, ONSET]
    for k in range(N_TERMS - 1, -1, -1):  # thick films from thin to thick
        line.to(_ratios(edges, M.THICK)[k])
        pieces[M.THICK, k] = line.values()
    line.at.come_back(kept)
    marks = [line.to_contact(w, g) for w, g in zip(task.marks, guesses, strict=True)]
    edges += [marks[0] + M.MIDDLE * (ONSET - marks[0]), *marks]
    for piece in range(M.N_PIECES - 1, M.THICK, -1):  # back up, from where the marks ended
        for k in range(N_TERMS - 1, -1, -1):
            line.to(_ratios(edges, piece)[k])
            pieces[piece, k] = line.values()
    pieces[M.THICK][:, [M.GC, M.DRY]] = 0.0
    return _packed(task, edges, pieces)


def _ratios(edges: list[float], piece: int) -> list[float]:
    """Return the film ratios of a piece's nodes from its thick end."""
    thick, thin = edges[piece], edges[piece + 1]
    if piece == M.THICK:
        thick, thin = math.log(thick), math.log(thin)
    at = 0.5 * ((1.0 + NODES) * thick + (1.0 - NODES) * thin)
    return [float(x) for x in (np.exp(at) if piece == M.THICK else at)]


def _packed(task: LineTask, edges: list[float], pieces: Array) -> Array:
    """Return head and coefficients; refuse what a look-up could not search."""
    where = (
        f"speed = {task.speed:g} rad/s, tilt = {task.tilt:g} rad, "
        f"oil_temperature = {task.oil_temperature:g} K"
    )
    if not np.all(np.isfinite(pieces)):
        raise SolveError(f"map: a solution is not finite at {where}")
    thick = pieces[0, :, M.GF]
    if np.any(np.diff(thick) <= 0.0):  # the load has to rise towards the thin end
        raise SolveError(f"map: the load does not rise as a thick film gets thinner at {where}")
    line = np.empty(M.LINE)
    line[: M.N_EDGES] = edges[3:]
    line[M.STEEPEST] = _steepest(task, edges, pieces)
    sums = np.einsum("ij,pjc->pci", _FIT, pieces)
    tilts = sums[:, M.N_CURVES :, : M.N_TILT_TERMS]
    line[M.N_LINE_HEAD :] = np.concatenate(
        [sums[:, : M.N_CURVES].reshape(M.N_PIECES, -1), tilts.reshape(M.N_PIECES, -1)], axis=1
    ).ravel()
    return line


def _steepest(task: LineTask, edges: list[float], pieces: Array) -> float:
    """Return the largest slope of ln(load) over the film ratio where asperities touch."""
    chebyshev = np.polynomial.chebyshev
    u = np.linspace(-1.0, 1.0, 81)
    steepest = -np.inf
    for piece in range(1, M.N_PIECES - 1):
        fits = [_FIT @ pieces[piece, :, curve] for curve in (M.GF, M.GC)]
        loads = [factor * np.exp(chebyshev.chebval(u, c))
                 for factor, c in zip((task.scale, 1.0), fits, strict=True)]  # fmt: skip
        slopes = [w * chebyshev.chebval(u, chebyshev.chebder(c))
                  for w, c in zip(loads, fits, strict=True)]  # fmt: skip
        half = 0.5 * (edges[piece] - edges[piece + 1])
        steepest = max(steepest, float(np.max(sum(slopes) / sum(loads)) / half))
    return steepest
