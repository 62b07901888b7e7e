"""Carry a washer's solution to another mesh: a fine grid then starts where a coarse one ended."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..kernels.washer_layout import S_FACTOR_VALID, S_FIELDS
from ..kernels.washer_model import WasherModel, washer_model
from ..kernels.washer_workspace import size_of_state
from ..models.washer import WasherResult, _solve
from ..models.washer_constants import constants
from ..models.washer_result import BRANCHES

Array = NDArray[np.float64]


def solve_on(result: WasherResult, grid: tuple[int, int]) -> WasherResult:
    """Return the solution on ``grid``, on the branch of ``result``, started from its fields.

    Where Newton's method does not arrive from there the solver finds the branch by itself, as from
    nothing. A failure is told by the status; ``error_estimate`` is that of the named rung.
    """
    point = (result.load, result.speed, result.tilt, result.oil_temperature)
    wanted = BRANCHES.get(result.branch, 0.0)
    return _solve(result.params, point, "field", grid, wanted, _moved(result, grid))


def _moved(result: WasherResult, grid: tuple[int, int]) -> WasherResult:
    """Return ``result`` as if it had been found on ``grid``: positions kept, fields resampled."""
    old = washer_model(constants(result.params, result.grid))
    new = washer_model(constants(result.params, grid))
    column = 3 * old.n_r - old.i_g
    n_temp = column * old.n_t
    fields = result._state[S_FIELDS : S_FIELDS + n_temp].reshape(old.n_t, column)
    pressure = result._state[S_FIELDS + n_temp :][: old.n_r * old.n_t].reshape(old.n_t, old.n_r)
    gear = 2 * old.n_r
    parts = [
        _resampled(fields[:, : old.n_r], old, new, 0, 0),
        _resampled(fields[:, old.n_r : gear], old, new, 0, 0),
        _resampled(fields[:, gear:], old, new, old.i_g, new.i_g),
    ]
    state = np.zeros(size_of_state(*grid))
    state[:S_FIELDS] = result._state[:S_FIELDS]
    state[S_FACTOR_VALID] = 0.0
    temperatures = np.hstack(parts).ravel()
    state[S_FIELDS : S_FIELDS + temperatures.size] = temperatures
    moved = np.maximum(_resampled(pressure, old, new, 0, 0), 0.0).ravel()
    state[S_FIELDS + temperatures.size :][: moved.size] = moved
    return dataclasses.replace(result, grid=grid, _state=state)


def _resampled(
    values: Array, old: WasherModel, new: WasherModel, first_old: int, first_new: int
) -> Array:
    """Return a field (n_theta, n_r) on the new nodes, from node ``first`` outwards.

    Around the circumference all meshes are one map of a uniform one: the index is the coordinate.
    """
    from scipy.interpolate import CubicSpline

    s = np.arange(old.n_t + 1) / old.n_t
    around = CubicSpline(s, np.vstack([values, values[:1]]), bc_type="periodic")
    turned = around(np.arange(new.n_t) / new.n_t)
    along = CubicSpline(old.r[first_old:], turned, axis=1)
    return np.asarray(along(new.r[first_new:]))
