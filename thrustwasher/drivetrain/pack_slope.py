"""How a pack's capacity changes with its slip, at the states a run has recorded."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..kernels.clutch_friction import coefficient_slopes, viscous_slopes
from ..models.clutch import prepare

Array = NDArray[np.float64]
Signals = dict[str, Array]


def capacity_slopes(
    params: Any, fidelity: str, pack: str, signals: Signals, where: NDArray[np.intp]
) -> Array:
    """Return the slope of the capacity over the size of the slip [N m s/rad] at recorded points.

    Film and temperature are those of the record and do not follow within a swing: they are slower.
    With the rung ``fine``, whose rings have speeds and temperatures of their own, it is the slope
    at the mean radius and the mean temperature.
    """
    par = prepare(params, fidelity)
    names = ("speed", "temperature", "film_ratio", "torque_capacity", "viscous_torque")
    columns = (signals[f"{pack}.{name}"][where].tolist() for name in names)
    slopes = []
    for slip, temperature, film, capacity, viscous in zip(*columns, strict=True):
        mu, _, steepness = coefficient_slopes(par, slip, temperature)
        slope = (capacity - abs(viscous)) * steepness / mu if mu > 0.0 else 0.0
        if viscous:
            slope += viscous_slopes(par, slip, film, temperature)[3]
        slopes.append(slope)
    return np.array(slopes)
