"""The washer's kernels by hand: arrays for a grid, and film and heat settled at given positions."""

from typing import NamedTuple

import numpy as np

from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.constants import WasherModel, mesh_arrays, washer_model
from thrustwasher.washer.kernels.heat import set_steady
from thrustwasher.washer.kernels.heat_factor import factor_heat, solve_heat
from thrustwasher.washer.kernels.newton import evaluate
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
    b = Bench(washer_model(par), fields_of(w), w)
    set_steady(b.m, BASE, b.f)
    return b


def full_gear(grid, **changes):
    """Return a bench whose gear is as large as the washer."""
    par = constants(WasherParams(**changes), grid).copy()
    radial, _ = mesh_arrays(par, *grid)
    more, par[L.D_GEAR_NODE] = par[L.D_GEAR_NODE], 0.0
    par[L.D_RINGS if par[L.P_CONDUCTION] == L.ONLY_CARRIER else L.D_PER_COLUMN] += more
    radial[L.WEIGHT2], radial[L.GEAR_WIDTH] = radial[L.WEIGHT1], radial[L.LOG_WIDTH]
    return bench_of(par, grid)


def bodies(b, temp=None):
    """Return the rises of carrier, washer and gear, each (n, n_theta), from ``temp`` or ``f``."""
    m, temp = b.m, b.f.temp if temp is None else temp
    columns = np.arange(m.n_t)
    found = []
    for at, step, n in (
        (m.carrier_at, m.carrier_step, m.n_r),
        (m.washer_at, m.washer_step, m.n_r),
        (m.gear_at, m.gear_step, m.n_r - m.i_g),
    ):
        found.append(temp[at + step * columns + np.arange(n)[:, None]])
    return found


def tilted(m, ratio, gy=0.00197, gx=-1.9e-5, second=3.0, tilt=0.002):
    """Return positions with a film of ``ratio`` sigma and a second gap of ``second`` sigma."""
    z_w = ratio * m.sigma1 + m.outer_radius * np.hypot(gx, gy)
    return np.array([z_w, z_w + second * m.sigma2 + m.outer_radius * (tilt - gy), gx, gy])


def settle(m, pt, q, f, passes=60):
    """Solve film and heat at fixed positions; leave everything evaluated there."""
    for _ in range(passes):
        made = evaluate(m, pt, q, f, False)
        if np.abs(f.heat).sum() < 1e-13 * max(made, 1e-2) and f.small[L.FILM_ERROR] < 1e-13:
            return
        assert factor_heat(m, pt, f)
        f.heat[:] *= -1.0
        solve_heat(m, f.heat, f.dtemp, f)
        f.temp[:] += f.dtemp
    # rounding is as far as it gets
    evaluate(m, pt, q, f, False)


BASE = Point(300.0, 545.0, 0.002, 297.15, 297.15)


def order(errors):
    """Return the observed orders of convergence for halved mesh widths."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
