"""The kernel's constants for many washers: made anew only where they must be.

Most of them is the contact table, which takes 1 ms. It depends on surfaces and materials alone;
over the roughness it is smooth, so that draws of roughness take theirs from tables on a grid.
"""

import math
from collections import Counter

import numpy as np

from ..errors import ParameterError
from ..numerics.jit import Array
from ..numerics.status import OK
from .kernels import layout as L
from .kernels.constants import combined_roughness, derive_grid, size_of_par, summits

GRID = 0.1  # of ln scatter
POINTS = 8  # of the grid that a table is taken from: ln P within 1e-11
MANY = 24  # washers that differ in roughness alone: a grid of tables pays
KEPT = 256
SURFACE = slice(L.P_ROUGHNESS, L.P_ROUGHNESS + 4)
TABLE1, TABLE2 = slice(L.D_TABLE1, L.D_TABLE2), slice(L.D_TABLE2, L.D_MESH)
Key = tuple[float, ...]


class Constants:
    """Returns ``par`` for the parameters of one of many washers."""

    def __init__(self, numbers: Array, nodes: tuple[int, int]) -> None:
        """``numbers`` (n, N_PARAM) are the parameters of all."""
        self.nodes, self.made = nodes, dict[Key, Array]()
        self.others = Counter(_without_roughness(own) for own in numbers)

    def __call__(self, own: Array) -> Array:
        """Return ``par`` for parameters (N_PARAM,); ParameterError: no contact table."""
        if self.others[_without_roughness(own)] < MANY:
            par = self._derived(own)
        else:
            par = self._between(own)
        par[: L.N_PARAM] = own
        return par

    def _derived(self, own: Array) -> Array:
        """Return what the kernel derives, of the last few surfaces and geometries."""
        return self._kept((*_without_roughness(own), *own[SURFACE]), own)

    def _kept(self, key: Key, own: Array) -> Array:
        par = self.made.get(key)
        if par is None:
            par = np.zeros(size_of_par(*self.nodes))
            par[: L.N_PARAM] = own
            if derive_grid(par, *self.nodes) != OK:
                raise ParameterError("the asperity contact cannot be tabulated")
            if len(self.made) >= KEPT:
                del self.made[next(iter(self.made))]
            self.made[key] = par
        return par

    def _between(self, own: Array) -> Array:
        """Return constants with contact tables interpolated over the scatter of the summits."""
        sigma1, sigma2, shear = combined_roughness(own)
        par = np.zeros(0)
        for sigma, table in ((sigma1, TABLE1), (sigma2, TABLE2)):
            _, scatter, _ = summits(own, sigma)
            at = math.log(scatter) / GRID
            first = math.floor(at) - POINTS // 2 + 1
            lost = sigma * sigma - scatter * scatter
            around = [self._at_grid(own, k, lost) for k in range(first, first + POINTS)]
            par = par if len(par) else around[0].copy()
            par[table] = _lagrange(at - first) @ np.array([one[table] for one in around])
        par[L.D_SIGMA1], par[L.D_SIGMA2], par[L.D_SHEAR] = sigma1, sigma2, shear
        par[L.D_MEAN_SUMMIT1], par[L.D_SUMMIT_SIGMA1], _ = summits(own, sigma1)
        par[L.D_MEAN_SUMMIT2], par[L.D_SUMMIT_SIGMA2], _ = summits(own, sigma2)
        return par

    def _at_grid(self, own: Array, k: int, lost: float) -> Array:
        """Return the constants of a washer with three equal surfaces whose summits are on the grid.

        ``lost`` is the variance by which the summits scatter less than the surfaces.
        """
        equal = own.copy()
        equal[SURFACE] = math.sqrt(0.5 * (math.exp(2.0 * k * GRID) + lost)), 0.0, 0.0, 0.0
        return self._kept((*_without_roughness(own), k), equal)


def _without_roughness(own: Array) -> Key:
    """Return geometry, materials and what the layout depends on."""
    return (
        *own[: L.P_ROUGHNESS],
        *own[L.P_ROUGHNESS + 4 : L.P_CONDUCTIVITY],
        own[L.P_CONDUCTION],
        own[L.P_OIL_COOLING],
    )


def _lagrange(x: float) -> Array:
    """Return the weights (POINTS,) of values at 0, 1, 2 .. for the value at ``x``."""
    weights = [math.prod((x - j) / (i - j) for j in range(POINTS) if j != i) for i in range(POINTS)]
    return np.array(weights)
