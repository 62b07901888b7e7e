"""Work arrays of the washer by name, and their sizes.

Nodal arrays are indexed ``j * n_r + i`` (angle j, radius i). Temperatures (rises above the oil) are
stored column by column: carrier, washer (n_r each), then gear (n_r - i_g nodes), which makes
``m_t = 3 n_r - i_g`` a column.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_model import WasherModel

N_TAG = 48  # what the stored heat factor was made for: inputs, positions, parameters, grid
N_SMALL = 128
N_KEEP = 3
RATE = 125  # in Fields.small: 1/s that storage weighs heat with; 0: steady


class Point(NamedTuple):
    """Operating point."""

    load: float  # [N]
    speed: float  # [rad/s]
    tilt: float  # [rad]
    oil_temperature: float  # [K]


class Bench(NamedTuple):
    """Where a washer is solved: parameters and work, whole.

    Passed down in place of model and fields wherever their many arrays are not needed by name:
    each costs seven words in every call.
    """

    par: NDArray[np.float64]
    work: NDArray[np.float64]  # what ``washer_fields`` names


class Fields(NamedTuple):
    """All work of a solve; contents mean nothing between calls but for the tagged heat factor."""

    tag: NDArray[np.float64]  # (N_TAG + n_temp + 1,) what the factor belongs to
    factor: NDArray[np.float64]  # band of the heat equations
    sens: NDArray[np.float64]  # (4 n_temp,) dT/d(z_w, z_g, gx, gy) with the factor
    small: NDArray[np.float64]  # (N_SMALL,) balances and 4 x 4 systems
    ht: NDArray[np.float64]  # (n,) mean gap of film 1 and its slope
    dht: NDArray[np.float64]
    pc: NDArray[np.float64]  # (n,) contact pressure of film 1 and its slope
    dpc: NDArray[np.float64]
    ht2: NDArray[np.float64]  # the same in gap 2
    dht2: NDArray[np.float64]
    pc2: NDArray[np.float64]
    dpc2: NDArray[np.float64]
    mu: NDArray[np.float64]  # (n,) viscosity and its slope
    dmu: NDArray[np.float64]
    fluidity: NDArray[np.float64]  # (n,) 1/viscosity
    ct: NDArray[np.float64]  # (n,) conductance j..j+1 over fluidity sum, slope over h
    dct: NDArray[np.float64]
    cr: NDArray[np.float64]  # (n,) conductance i..i+1 over fluidity sum, slope over h
    dcr: NDArray[np.float64]
    wedge: NDArray[np.float64]  # (n,) what drives the film at the face j..j+1, slope over h
    dwedge: NDArray[np.float64]
    wet: NDArray[np.float64]  # (n,) 1 where the film is full, 0 where it cavitates
    place: NDArray[np.float64]  # (n_t,) position of a column in the film's system, -1 dry
    film: NDArray[np.float64]  # band of the film equations
    film_rhs: NDArray[np.float64]  # (8 n,) node by node: right sides, then solutions
    lag: NDArray[np.float64]  # (8 n,) fluidity changes that follow the temperatures
    sides: NDArray[np.float64]  # (8 n,) right sides in the order of the film's system
    temp: NDArray[np.float64]  # (n_temp,) rises above the oil [K], the iterate
    p: NDArray[np.float64]  # (n,) pressure [Pa], the iterate
    heat: NDArray[np.float64]  # (n_temp,) residual of the heat equations [W]
    dtemp: NDArray[np.float64]  # (n_temp,) T step at fixed positions
    spare: NDArray[np.float64]  # (n_temp,) permuted right side
    past: NDArray[np.float64]  # (n_temp,) rises that the storage of heat counts from [K]
    begin: NDArray[np.float64]  # (n_temp,) rises at the start of a substep
    keep: NDArray[np.float64]  # (N_KEEP (4 + n_temp + n),) remembered solutions; of washer_sens too


def temperatures_of(n_r: int, n_t: int) -> int:
    """Return the largest number of temperatures, that with the gear as wide as can be."""
    return (3 * n_r - 1) * n_t


def size_of_work(n_r: int, n_t: int) -> int:
    """Return the length of ``work`` for a grid; the heat factor needs most of it."""
    n, n_temp = n_r * n_t, temperatures_of(n_r, n_t)
    width = 4 * n_temp // n_t + 2
    film = (2 * n_r + 1) * n
    kept = N_KEEP * (4 + n_temp + n)
    return N_TAG + 1 + n_temp * (width + 11) + N_SMALL + n_t + 43 * n + film + kept


@kernel
def forget_factor(b: Bench) -> None:
    """Have the heat factor made anew before it is used again."""
    b.work[0] = 0.0


@kernel
def washer_fields(m: WasherModel, work: NDArray[np.float64]) -> Fields:
    """Return ``work`` by name; the arrays are views."""
    n_r, n_t = m.n_r, m.n_t
    n, m_t = n_r * n_t, 3 * n_r - m.i_g
    n_temp = m_t * n_t
    width = 4 * m_t + 2  # Cholesky's factor twice, or one of LU
    a0 = N_TAG + 1 + n_temp
    a1 = a0 + n_temp * width
    a2 = a1 + 4 * n_temp
    a3 = a2 + N_SMALL
    b = a3 + 18 * n
    c = b + n_t
    d = c + (2 * n_r + 1) * n
    e = d + 24 * n
    g = e + n_temp
    k = g + n
    z = k + 5 * n_temp
    return Fields(
        work[:a0], work[a0:a1], work[a1:a2], work[a2:a3],
        work[a3 : a3 + n], work[a3 + n : a3 + 2 * n], work[a3 + 2 * n : a3 + 3 * n],
        work[a3 + 3 * n : a3 + 4 * n], work[a3 + 4 * n : a3 + 5 * n],
        work[a3 + 5 * n : a3 + 6 * n], work[a3 + 6 * n : a3 + 7 * n],
        work[a3 + 7 * n : a3 + 8 * n], work[a3 + 8 * n : a3 + 9 * n],
        work[a3 + 9 * n : a3 + 10 * n], work[a3 + 10 * n : a3 + 11 * n],
        work[a3 + 11 * n : a3 + 12 * n], work[a3 + 12 * n : a3 + 13 * n],
        work[a3 + 13 * n : a3 + 14 * n], work[a3 + 14 * n : a3 + 15 * n],
        work[a3 + 15 * n : a3 + 16 * n], work[a3 + 16 * n : a3 + 17 * n], work[a3 + 17 * n : b],
        work[b:c], work[c:d], work[d : d + 8 * n],
        work[d + 8 * n : d + 16 * n], work[d + 16 * n : e], work[e:g], work[g:k],
        work[k : k + n_temp], work[k + n_temp : k + 2 * n_temp],
        work[k + 2 * n_temp : k + 3 * n_temp], work[k + 3 * n_temp : k + 4 * n_temp],
        work[k + 4 * n_temp : z], work[z : z + N_KEEP * (4 + n_temp + n)],
    )  # fmt: skip
