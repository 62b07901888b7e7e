"""All that a washer is solved with, by name: the arrays of one washer, and its work."""

from typing import NamedTuple

import numpy as np

from ...numerics.banded import N_SIDES
from ...numerics.jit import Array, kernel, matrix
from . import layout as L
from .constants import WasherModel, washer_model

N_NODAL = 18  # arrays of one number per node


class Point(NamedTuple):
    """Operating point, or a change of one."""

    load: float  # [N]
    speed: float  # [rad/s]
    tilt: float  # [rad]
    oil_temperature: float  # [K]


class Workspace(NamedTuple):
    """The arrays of one washer, whole.

    Passed down in place of model and fields wherever their many arrays are not needed by name:
    each costs seven words in every call.
    """

    par: Array
    work: Array  # what ``Fields`` names
    info: Array  # (N_INFO,) counts and residuals
    found: Array  # (N_FOUND,) branch, multiplicity, folds
    curve: Array  # (N_CURVE,) where the walk along the curve of solutions stands
    outputs: Array  # (N_ALL,)
    q: Array  # (4,) positions


class Fields(NamedTuple):
    """All work of a solve; contents mean nothing between calls but for the tagged heat factor."""

    tag: Array  # (N_TAG + n_temp + 1,) what the factor belongs to
    factor: Array  # band of the heat equations
    following: Array  # (4, n_temp) dT/dq with the factor
    small: Array  # (N_SMALL,) balances and 4 x 4 systems
    ht: Array  # (n,) mean gap of film 1 and its slope
    dht: Array
    pc: Array  # (n,) contact pressure of film 1 and its slope
    dpc: Array
    ht2: Array  # the same in gap 2
    dht2: Array
    pc2: Array
    dpc2: Array
    mu: Array  # (n,) viscosity and its slope
    dmu: Array
    fluidity: Array  # (n,) 1/viscosity
    ct: Array  # (n,) conductance j..j+1 over fluidity sum, slope over h
    dct: Array
    cr: Array  # (n,) conductance i..i+1 over fluidity sum, slope over h
    dcr: Array
    wedge: Array  # (n,) what drives the film at the face j..j+1, slope over h
    dwedge: Array
    wet: Array  # (n,) 1 where the film is full, 0 where it cavitates
    place: Array  # (n_t,) position of a column in the film's system, -1 dry
    film: Array  # band of the film equations
    film_rhs: Array  # (n, N_SIDES) right sides, then solutions
    lag: Array  # (n, N_SIDES) fluidity changes that follow the temperatures
    sides: Array  # (n N_SIDES,) right sides in the order of the film's system
    temp: Array  # (n_temp,) rises above the oil [K], the iterate
    p: Array  # (n,) pressure [Pa], the iterate
    heat: Array  # (n_temp,) residual of the heat equations [W]
    dtemp: Array  # (n_temp,) T step at fixed positions
    spare: Array  # (n_temp,) permuted right side
    past: Array  # (n_temp,) rises that the storage of heat counts from [K]
    begin: Array  # (n_temp,) rises at the start of a substep
    keep: Array  # (N_KEPT (4 + n_temp + n),) remembered solutions; scratch of derivatives too


def temperatures_of(n_r: int, n_t: int) -> int:
    """Return the largest number of temperatures, that with the gear as wide as can be."""
    return (3 * n_r - 1) * n_t


def size_of_state(n_r: int, n_t: int) -> int:
    """Return the length of ``state`` for a grid."""
    return L.S_FIELDS + 2 * temperatures_of(n_r, n_t) + n_r * n_t


def size_of_work(n_r: int, n_t: int) -> int:
    """Return the length of ``work`` behind its head for a grid; the heat factor needs most."""
    n, n_temp = n_r * n_t, temperatures_of(n_r, n_t)
    width = 4 * n_temp // n_t + 2
    film = (2 * n_r + 1) * n
    kept = L.N_KEPT * (4 + n_temp + n)
    per_node = N_NODAL + 3 * N_SIDES + 1
    return L.N_TAG + 1 + n_temp * (width + 11) + L.N_SMALL + n_t + per_node * n + film + kept


@kernel
def workspace_of(par: Array, work: Array) -> Workspace:
    """Return the arrays of a washer by name; ``work`` begins with its head."""
    return Workspace(
        par=par,
        work=work[L.N_HEAD :],
        info=work[: L.N_INFO],
        found=work[L.AT_FOUND : L.AT_CURVE],
        curve=work[L.AT_CURVE : L.AT_OUTPUTS],
        outputs=work[L.AT_OUTPUTS : L.AT_POSITIONS],
        q=work[L.AT_POSITIONS : L.N_HEAD],
    )


@kernel
def model_of(w: Workspace) -> WasherModel:
    """Return the washer's constants by name."""
    return washer_model(w.par)


@kernel
def forget_factor(w: Workspace) -> None:
    """Have the heat factor made anew before it is used again."""
    w.work[L.TAG_VALID] = 0.0


@kernel
def copy(fro: Array, to: Array) -> None:
    """Copy an array into one of its length."""
    for k in range(to.size):
        to[np.uintp(k)] = fro[np.uintp(k)]


@kernel
def clear(a: Array) -> None:
    """Fill an array with 0."""
    for k in range(a.size):
        a[np.uintp(k)] = 0.0


@kernel
def negate(a: Array) -> None:
    """Turn the signs of all numbers."""
    for k in range(a.size):
        a[np.uintp(k)] = -a[np.uintp(k)]


@kernel
def size_of(a: Array) -> float:
    """Return the sum of the sizes of all numbers."""
    total = 0.0
    for k in range(a.size):
        total += abs(a[np.uintp(k)])
    return total


@kernel
def fields_of(w: Workspace) -> Fields:
    """Return the work by name; the arrays are views."""
    par, work = w.par, w.work
    n_r, n_t = int(par[L.D_RADIAL]), int(par[L.D_AROUND])
    n, m_t = n_r * n_t, 3 * n_r - int(par[L.D_GEAR_NODE])
    n_temp = m_t * n_t
    factor = L.N_TAG + 1 + n_temp
    following = factor + n_temp * (4 * m_t + 2)  # Cholesky's factor twice, or one of LU
    small = following + 4 * n_temp
    first = small + L.N_SMALL
    place = first + N_NODAL * n
    film = place + n_t
    rhs = film + (2 * n_r + 1) * n
    lag = rhs + N_SIDES * n
    sides = lag + N_SIDES * n
    temp = sides + N_SIDES * n
    pressure = temp + n_temp
    heat = pressure + n
    keep = heat + 5 * n_temp
    nodal = matrix(work[first:place], N_NODAL, n)
    thermal = matrix(work[heat:keep], 5, n_temp)
    return Fields(
        tag=work[:factor],
        factor=work[factor:following],
        following=matrix(work[following:small], 4, n_temp),
        small=work[small:first],
        ht=nodal[0],
        dht=nodal[1],
        pc=nodal[2],
        dpc=nodal[3],
        ht2=nodal[4],
        dht2=nodal[5],
        pc2=nodal[6],
        dpc2=nodal[7],
        mu=nodal[8],
        dmu=nodal[9],
        fluidity=nodal[10],
        ct=nodal[11],
        dct=nodal[12],
        cr=nodal[13],
        dcr=nodal[14],
        wedge=nodal[15],
        dwedge=nodal[16],
        wet=nodal[17],
        place=work[place:film],
        film=work[film:rhs],
        film_rhs=matrix(work[rhs:lag], n, N_SIDES),
        lag=matrix(work[lag:sides], n, N_SIDES),
        sides=work[sides:temp],
        temp=work[temp:pressure],
        p=work[pressure:heat],
        heat=thermal[0],
        dtemp=thermal[1],
        spare=thermal[2],
        past=thermal[3],
        begin=thermal[4],
        keep=work[keep : keep + L.N_KEPT * (4 + n_temp + n)],
    )


@kernel
def square(small: Array, place: int) -> Array:
    """Return one of the 4 x 4 matrices in ``Fields.small``."""
    return matrix(small[place : place + 16], 4, 4)


@kernel
def vector(small: Array, place: int) -> Array:
    """Return four of the numbers in ``Fields.small``."""
    return small[place : place + 4]
