"""The thrust washer by the method it was published with, to be measured against.

After Jackson & Green (2006): a uniform polar mesh of 9 x 67 nodes for pressure and temperature,
cell areas as weights, Gauss-Seidel over-relaxation for the Reynolds equation with pressures at or
above zero, Newton-Raphson with centred differences for the four balances, Gauss-Seidel for the
temperatures, and temperatures substituted until they stay. The paper's run took 30 minutes for the
first load step, on a processor of 1.8 GHz.

Film, contact and viscosity are the package's own functions, so that the equations are the same.
Set as favourably as can be: over-relaxation 1.65 (best of 1.0 .. 1.9) also for the temperatures
(1.9), steps of Newton limited, a start with the washer on the gear (the paper's own start converges
nowhere), temperatures relaxed where that keeps the branch, and all of it compiled.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lab.charts.chart_series import Configuration
from lab.charts.methods import ChartCase, MethodAnswer, neighbours, path_to
from thrustwasher.errors import Status
from thrustwasher.numerics.dense import dense_solve
from thrustwasher.tribology.asperities import contact_pressure
from thrustwasher.tribology.flow_factors import mean_gap
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels.constants import WasherModel, washer_model
from thrustwasher.washer.kernels.gap import dry_friction, oil_viscosity
from thrustwasher.washer.kernels.layout import D_SIGMA1
from thrustwasher.washer.parameters import WasherParams

from .compiled import rival
from .plain2006_fields import Mesh, Settings, conductances, gap_at, heat, make_mesh, relax_pressure

Array = NDArray[np.float64]
GRID = (9, 67)
KNOWN = 4  # inputs that the paper knows; the far faces are as warm as the oil
RELAXATION, HEAT_RELAXATION = 1.65, 1.9
DIFFERENCE = 0.1  # [sigma]; less is lost in the pressures' stop test
SHARE = 0.3  # 1 lands on the contact branch up to 28 % below the fold
MOST_ROUNDS = 400
OK, MAX_ITERATIONS, NOT_FINITE = 0, 10, 14  # errors.Status
MOST_SWEEPS = 3000  # of pressure, per residual
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)  # of the chart
GRIDS = ((13, 67), (17, 67), (17, 134))
N_Q = 4  # positions in `memory`, before pressures and temperature rises
TORQUE, TEMPERATURE, FILM, SWEEPS, RATIO, N_OUT = 0, 1, 2, 3, 4, 5  # what `solve_point` reports


@rival
def forces(
    m: WasherModel, g: Mesh, q: Array, tilt: float, p: Array, force: Array
) -> tuple[float, float]:
    """Fill force and moment balance (4,), the last one the force on the gear; return contact."""
    n_t, n_r = p.shape
    for k in range(4):
        force[k] = 0.0
    contact = 0.0
    for j in range(n_t):
        for i in range(n_r):
            x, y = g.r[i] * g.cos[j], g.r[i] * g.sin[j]
            h = q[0] + y * q[2] - x * q[3]
            pc, _ = contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)
            f = (p[j, i] + pc) * g.area[i]
            contact += pc * g.area[i]
            force[0] += f
            force[1] += f * y
            force[2] -= f * x
            if i >= g.i_g:
                h = q[1] - q[0] - x * (tilt - q[3]) - y * q[2]
                pc, _ = contact_pressure((h - m.mean_summit2) / m.summit_sigma2, m.table2)
                f = pc * g.gear_area[i]
                force[0] -= f
                force[1] -= f * y
                force[2] += f * x
                force[3] += f
    return contact, force[3]


@rival
def _residual(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    tilt: float,
    load: float,
    mu: Array,
    p: Array,
    s: Settings,
    east: Array,
    north: Array,
    source: Array,
    force: Array,
) -> int:
    """Solve the pressure at ``q`` and fill the scaled residual of the four balances."""
    conductances(m, g, q, speed, mu, east, north, source)
    sweeps = relax_pressure(east, north, source, p, s, MOST_SWEEPS)
    forces(m, g, q, tilt, p, force)
    force[3] -= load
    for k in range(4):
        force[k] /= load if k in (0, 3) else load * m.outer_radius
    return sweeps


@rival
def balance(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    tilt: float,
    load: float,
    mu: Array,
    p: Array,
    s: Settings,
    out: Array,
) -> int:
    """Newton-Raphson on four positions with centred differences; return a status."""
    n_t, n_r = p.shape
    east, north, source = np.zeros((n_t, n_r)), np.zeros((n_t, n_r)), np.zeros((n_t, n_r))
    force, plus, minus = np.zeros(4), np.zeros(4), np.zeros(4)
    jacobian, trial, pressure = np.zeros((4, 4)), np.zeros(4), np.zeros((n_t, n_r))
    scale = np.array((m.sigma1, m.sigma1, m.sigma1 / m.outer_radius, m.sigma1 / m.outer_radius))
    for _ in range(80):
        out[SWEEPS] += _residual(m, g, q, speed, tilt, load, mu, p, s, east, north, source, force)
        worst = 0.0
        for k in range(4):
            worst = max(worst, abs(force[k]))
        if not math.isfinite(worst):
            return NOT_FINITE
        # no better than the pressures behind it
        if worst <= 10.0 * s.tolerance:
            return OK
        for k in range(4):
            for sign in (1.0, -1.0):
                trial[:] = q
                trial[k] += sign * s.difference * scale[k]
                pressure[:] = p
                side = plus if sign > 0.0 else minus
                out[SWEEPS] += _residual(
                    m, g, trial, speed, tilt, load, mu, pressure, s, east, north, source, side
                )
            for row in range(4):
                jacobian[row, k] = (plus[row] - minus[row]) / (2.0 * s.difference)
        if not dense_solve(jacobian.ravel(), force, 4):
            return MAX_ITERATIONS
        # the largest change of either gap stays near a third of the film, or one sigma
        tilted = math.sqrt(force[2] ** 2 + force[3] ** 2)
        least = (q[0] - m.outer_radius * math.sqrt(q[2] ** 2 + q[3] ** 2)) / m.sigma1
        allowed = max(1.0, 0.3 * least)
        change = max(abs(force[0]) + tilted, 0.5 * (abs(force[1] - force[0]) + tilted))
        step = min(1.0, s.limit * allowed / change) if change > 0.0 else 1.0
        for k in range(4):
            q[k] -= step * force[k] * scale[k]
    return MAX_ITERATIONS


@rival
def outputs(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    mu: Array,
    rise: Array,
    contact: float,
    oil: float,
    out: Array,
) -> None:
    """Fill torque, mean temperature and minimum film thickness."""
    n_t, n_r = mu.shape
    friction, _ = dry_friction(m.par, contact)
    torque, warmth, area = 0.0, 0.0, 0.0
    for j in range(n_t):
        for i in range(n_r):
            h = gap_at(g, q, j, i)
            mean, _ = mean_gap(h, m.sigma1)
            pc, _ = contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)
            viscous = mu[j, i] * speed * g.r[i] * g.r[i] / mean
            dry = friction * pc * g.r[i]
            torque += g.area[i] * (viscous + (dry if speed > 0.0 else -dry))
            warmth += g.area[i] * 0.5 * (rise[0, j, i] + rise[1, j, i])
            area += g.area[i]
    out[TORQUE] = torque if speed != 0.0 else 0.0
    out[TEMPERATURE] = oil + warmth / area
    out[FILM] = q[0] - m.outer_radius * math.sqrt(q[2] ** 2 + q[3] ** 2)
    out[RATIO] = out[FILM] / m.sigma1


@rival
def solve_point(
    par: Array,
    n_r: int,
    n_t: int,
    load: float,
    speed: float,
    tilt: float,
    oil: float,
    s: Settings,
    memory: Array,
    out: Array,
) -> int:
    """Solve one operating point from what ``memory`` holds (all zero: the start), into ``out``.

    Temperature, viscosity and balance follow each other until the temperatures stay.
    """
    m = washer_model(par)
    g = make_mesh(m, n_r, n_t)
    n = n_r * n_t
    q, p = memory[:N_Q], memory[N_Q : N_Q + n].reshape(n_t, n_r)
    rise = memory[N_Q + n :].reshape(3, n_t, n_r)
    if q[0] == 0.0:
        q[3] = 0.95 * tilt
        q[0] = q[3] * m.outer_radius + 6.0 * m.sigma1
        q[1] = q[0] + 3.0 * m.sigma1 + 0.05 * tilt * m.outer_radius
    mu, old, force = np.empty((n_t, n_r)), np.empty((3, n_t, n_r)), np.zeros(4)
    for k in range(N_OUT):
        out[k] = 0.0
    status, contact = MAX_ITERATIONS, 0.0
    for _ in range(s.most_rounds):
        for j in range(n_t):
            for i in range(n_r):
                warm = oil + 0.5 * (rise[0, j, i] + rise[1, j, i])
                mu[j, i], _ = oil_viscosity(m.par, warm)
        inner = balance(m, g, q, speed, tilt, load, mu, p, s, out)
        if inner != OK:
            status = inner
            break
        contact, _ = forces(m, g, q, tilt, p, force)
        old[:] = rise
        out[SWEEPS] += heat(m, g, q, speed, tilt, mu, contact, rise, s)
        worst, most = 0.0, 0.0
        for body in range(3):
            for j in range(n_t):
                for i in range(n_r):
                    step = rise[body, j, i] - old[body, j, i]
                    rise[body, j, i] = old[body, j, i] + s.share * step
                    worst, most = max(worst, abs(step)), max(most, abs(rise[body, j, i]))
        if not math.isfinite(worst):
            status = NOT_FINITE
            break
        if worst <= max(s.tolerance, 1e-9) * 10.0 * most + 1e-6:
            status = OK
            break
    outputs(m, g, q, speed, mu, rise, contact, oil, out)
    return status


class Found2006(NamedTuple):
    """What ``solve_point`` reports, in the order of ``out``."""

    friction_torque: float  # N m
    temperature: float  # K, mean of the film
    film_thickness: float  # m, minimum separation
    sweeps: float  # over a field, of pressure and of temperature
    film_ratio: float  # minimum separation over sigma


@dataclass
class Plain2006:
    """A washer with the memory of its last solution, as the original keeps it between loads."""

    params: WasherParams = field(default_factory=WasherParams)
    grid: tuple[int, int] = GRID
    tolerance: float = 1e-6
    relaxation: float = RELAXATION
    share: float = SHARE
    limited: bool = True  # Newton's steps
    level: bool = False  # the paper's start: washer level, 3 sigma off everything

    def __post_init__(self) -> None:
        n_r, n_t = self.grid
        self._par = constants(self.params, (10, 32))  # scalars and contact tables; not its mesh
        self.memory = np.zeros(N_Q + 4 * n_r * n_t)
        self.out = np.zeros(N_OUT)

    def solve(self, load: float, speed: float, tilt: float, oil_temperature: float) -> Status:
        """Solve one point, warm if there was one before; ``found`` is the result."""
        settings = Settings(
            self.relaxation,
            HEAT_RELAXATION,
            self.tolerance,
            DIFFERENCE,
            self.share,
            MOST_ROUNDS,
            1.0 if self.limited else 1e300,
        )
        if self.level and self.memory[0] == 0.0:
            gap = 3.0 * float(self._par[D_SIGMA1])
            self.memory[0] = gap
            self.memory[1] = 2.0 * gap + tilt * self.params.outer_radius
        status = solve_point(
            self._par,
            *self.grid,
            float(load),
            float(speed),
            float(tilt),
            float(oil_temperature),
            settings,
            self.memory,
            self.out,
        )
        return Status(status)

    @property
    def found(self) -> Found2006:
        """The last solution."""
        return Found2006(*self.out.tolist())


class Method2006:
    """The method as one to be charted."""

    def __init__(self, **settings: Any) -> None:
        self._make = partial(Plain2006, **settings)

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Solve a case, warm at the last."""
        washer, status = self._at(case)
        found = washer.found
        return MethodAnswer(found._asdict(), status, found.sweeps * math.prod(washer.grid))

    def _at(self, case: ChartCase) -> tuple[Plain2006, Status]:
        washer, status = self._make(), Status.OK
        for point in path_to(case):
            status = washer.solve(*point[:KNOWN])
        return washer, status

    def warm(self, case: ChartCase) -> Callable[[], object]:
        """Return a call that goes back and forth over one per cent of the load."""
        washer, _ = self._at(case)
        points = itertools.cycle(neighbours(case))
        return lambda: washer.solve(*next(points)[:KNOWN])

    def idle(self, case: ChartCase) -> None:
        """Return nothing: a call from Python is nothing compared with a solve."""


def charted(*, quick: bool = False) -> list[Configuration]:
    """Return the method over its tolerance, and over its mesh at the best tolerance."""
    made = partial(Configuration, count_of="sweeps x nodes", is_rival=True, preset="paper")
    tolerances = [
        made(
            "2006, 9 x 67, tolerance",
            f"2006, 9 x 67, {t:g}",
            "tolerance",
            f"{t:g}",
            partial(Method2006, tolerance=t),
        )
        for t in (TOLERANCES[1:2] if quick else TOLERANCES)
    ]
    meshes = [
        made(
            "2006, 1e-5, mesh",
            f"2006, mesh {r} x {t}",
            "grid",
            f"{r}x{t}",
            partial(Method2006, tolerance=1e-5, grid=(r, t)),
        )
        for r, t in (() if quick else GRIDS)
    ]
    return tolerances + meshes
