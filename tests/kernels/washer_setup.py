"""The washer's kernels by hand: arrays for a grid, and film and heat settled at given positions."""

from typing import NamedTuple

import numpy as np

from thrustwasher.kernels import washer_fields as fields
from thrustwasher.kernels.banded import N_SIDES
from thrustwasher.kernels.washer_fields import Fields, Point, size_of_work, washer_fields
from thrustwasher.kernels.washer_film import film_residual, film_solve
from thrustwasher.kernels.washer_heat import solve_heat
from thrustwasher.kernels.washer_model import MESH, N_PARAM, N_RADIAL, WasherModel, washer_model
from thrustwasher.kernels.washer_newton import evaluate, make_factor
from thrustwasher.models.washer import constants
from thrustwasher.models.washer_params import WasherParams


class Bench(NamedTuple):
    m: WasherModel
    f: Fields
    whole: fields.Bench | None = None  # par and work, as the solver takes them

    def node(self, name):
        """Return a nodal array of ``f`` as (n_r, n_theta) view."""
        return getattr(self.f, name).reshape(self.m.n_t, self.m.n_r).T

    @property
    def radius(self):
        return np.asarray(self.m.r)[:, None]


def bench(grid=(10, 32), **changes):
    """Return model and work arrays; everything starts at zero."""
    par = constants(WasherParams(**changes), grid).copy()
    work = np.zeros(size_of_work(*grid))
    m = washer_model(par)
    return Bench(m, washer_fields(m, work), fields.Bench(par, work))


def full_gear(grid, **changes):
    """Return a bench whose gear is as large as the washer."""
    par = constants(WasherParams(**changes), grid).copy()
    n_r, radial = grid[0], par[MESH : MESH + N_RADIAL * grid[0]].reshape(N_RADIAL, grid[0])
    par[N_PARAM + 2] = 0.0  # the radial node where the gear begins
    radial[4], radial[6] = radial[3], radial[2]  # weights and widths
    assert n_r == int(par[N_PARAM])
    work = np.zeros(2 * size_of_work(*grid))
    m = washer_model(par)
    return Bench(m, washer_fields(m, work), fields.Bench(par, work))


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
        f.p[:] = f.film_rhs[::N_SIDES]
    # rounding is as far as it gets
    evaluate(m, pt, q, f)
    film_residual(m, f.p, f)


BASE = Point(300.0, 545.0, 0.002, 297.15)


def order(errors):
    """Return the observed orders of convergence for halved mesh widths."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
