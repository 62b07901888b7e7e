"""What a washer's torque owes to its mesh, from the solution itself.

A mesh errs by a share of what the oil film carries; near a fold a little load moves the torque
far. So the error is the film's share of the load, times how steeply the torque follows the load,
times a number that was measured: docs/theory/washer/mesh.md.
"""

import numpy as np

from ..errors import SolveError
from .kernels import layout as L
from .sensitivities import Linearised, Solved

# what at least 95 of 100 solutions of the verified box stay below
OF_FILM = {"field": 0.031, "fine": 0.0098}
LEAST_SHARE = 0.02  # of the load on the film: dry contact errs too


def slope_over_load(solved: Solved) -> float | None:
    """Return by how many percent the torque follows one percent of load; None at a fold."""
    here = Linearised(*solved)
    try:
        here.settle()
        return here.torque_over_load() * here.pt.load / float(here.w.outputs[L.O_TORQUE])
    except SolveError:
        return None


def mesh_error(solved: Solved, fidelity: str, fluid_share: float, film_ratio: float) -> float:
    """Return the relative error of the torque to expect, at most 1; at a fold it is 1."""
    slope = slope_over_load(solved)
    if slope is None or not np.isfinite(slope):
        return 1.0
    carried = (fluid_share + LEAST_SHARE) ** 1.25 / np.sqrt(1.0 + max(film_ratio, 0.0))
    return float(min(OF_FILM[fidelity] * abs(slope) * carried, 1.0))
