# mypy: disable-error-code="no-any-return"
"""Linear systems of film and heat: one film ratio, one power, any number of conduction modes."""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel

Array = NDArray[np.float64]


@kernel
def surface_temperature(par: Array, y: Array, base: int) -> float:
    """Return the interface temperature [K]: the plate's mean and the modes on top of it."""
    total = y[np.uintp(base + L.Y_HEAT)]
    for i in range(int(par[L.D_MODES])):
        total += y[np.uintp(base + L.Y_HEAT + 1 + i)]
    return total


@kernel
def solve_stage(
    par: Array, s: float, slopes: tuple[float, float, float, float, float, float], work: Array,
    stage: int,
) -> None:  # fmt: skip
    """Turn the right side in the stage's place into its solution of (s - J) U = right side."""
    n = int(par[L.D_MODES]) + 1
    total, gain = 0.0, 0.0
    for i in range(n):
        pivot = s + par[np.uintp(L.D_DECAY + i)]
        total += work[np.uintp(stage + L.Y_HEAT + i)] / pivot
        gain += par[np.uintp(L.D_GAIN + i)] / pivot
    rate_u, rate_t, power_u, power_t = slopes[1], slopes[2], slopes[4], slopes[5]
    # film (s - f_u) du - f_T D = r;   surface (1 - gain P_T) D - gain P_u du = total
    a, d = s - rate_u, 1.0 - gain * power_t
    determinant = a * d - rate_t * gain * power_u
    if determinant == 0.0:
        determinant = math.nan
    r = work[np.uintp(stage + L.Y_FILM)]
    film = (r * d + rate_t * total) / determinant
    surface = (a * total + gain * power_u * r) / determinant
    power = power_u * film + power_t * surface
    work[np.uintp(stage + L.Y_FILM)] = film
    work[np.uintp(stage + L.Y_ENERGY)] = (work[np.uintp(stage + L.Y_ENERGY)] + power) / s
    for i in range(n):
        place = np.uintp(stage + L.Y_HEAT + i)
        work[place] = (work[place] + par[np.uintp(L.D_GAIN + i)] * power) / (
            s + par[np.uintp(L.D_DECAY + i)]
        )


@kernel
def runs(course: tuple[float, float, float, float, float, float]) -> bool:
    """Tell if the inputs at the end of a stretch differ from those at its start."""
    return course[0] != course[3] or course[1] != course[4] or course[2] != course[5]
