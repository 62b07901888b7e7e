"""The washer's kernels by hand: arrays for a grid, and film and heat settled at given positions."""

from typing import NamedTuple

import numpy as np

from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.constants import WasherModel, mesh_arrays, washer_model
from thrustwasher.washer.kernels.film import film_residual, film_solve
from thrustwasher.washer.kernels.heat import solve_heat
from thrustwasher.washer.kernels.newton import evaluate, make_factor
from thrustwasher.washer.kernels.workspace import (
    Fields,
    Point,
    Workspace,
    fields_of,
    size_of_work,
    workspace_of,
)
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import constants


class Bench(NamedTuple):
    m: WasherModel
    f: Fields
    w: Workspace | None = None  # the same whole, as the solver takes it

    def node(self, name):
        """Return a nodal array of ``f`` as (n_r, n_theta) view."""
        return getattr(self.f, name).reshape(self.m.n_t, self.m.n_r).T

    @property
    def radius(self):
        return np.asarray(self.m.r)[:, None]


def bench(grid=(10, 32), **changes):
    """Return model and work arrays; everything starts at zero."""
    return bench_of(constants(WasherParams(**changes), grid).copy(), grid)


def bench_of(par, grid):
    """Return model and work arrays for derived parameters."""
    w = workspace_of(par, np.zeros(L.N_HEAD + 2 * size_of_work(*grid)))  # room for a full gear
    return Bench(washer_model(par), fields_of(w), w)


def full_gear(grid, **changes):
    """Return a bench whose gear is as large as the washer."""
    par = constants(WasherParams(**changes), grid).copy()
    radial, _ = mesh_arrays(par, *grid)
    par[L.D_GEAR_NODE] = 0.0
    radial[L.WEIGHT2], radial[L.GEAR_WIDTH] = radial[L.WEIGHT1], radial[L.LOG_WIDTH]
    return bench_of(par, grid)


def tilted(m, ratio, gy=0.00197, gx=-1.9e-5, second=3.0, tilt=0.002):
    """Return positions with a film of ``ratio`` sigma and a second gap of ``second`` sigma."""
    z_w = ratio * m.sigma1 + m.outer_radius * np.hypot(gx, gy)
    return np.array([z_w, z_w + second * m.sigma2 + m.outer_radius * (tilt - gy), gx, gy])


def settle(m, pt, q, f, passes=40):
    """Solve film and heat at fixed positions; leave everything evaluated there."""
    for _ in range(passes):
        made = evaluate(m, pt, q, f)
        error, p_max, _ = film_residual(m, f.p, f)
        lost = np.abs(f.heat).sum()
        if lost < 1e-13 * max(made, 1e-2) and error < 1e-13 * max(p_max, 1.0):
            return
        assert make_factor(m, pt, q, f.temp, f)
        f.heat[:] *= -1.0
        solve_heat(m, f.heat, f.dtemp, f)
        assert film_solve(m, f.p, f)
        f.temp[:] += f.dtemp
        f.p[:] = f.film_rhs[:, L.AT_FIXED]
    # rounding is as far as it gets
    evaluate(m, pt, q, f)
    film_residual(m, f.p, f)


BASE = Point(300.0, 545.0, 0.002, 297.15)


def order(errors):
    """Return the observed orders of convergence for halved mesh widths."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
