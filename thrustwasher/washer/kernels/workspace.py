"""All that a washer is solved with, by name: the arrays of one washer, and its work."""

from typing import NamedTuple

from ...numerics.banded import N_SIDES
from ...numerics.jit import Array, kernel, matrix
from . import layout as L
from .constants import WasherModel, washer_model

N_NODAL = 38  # arrays of one number per node
N_THERMAL = 7  # arrays of one number per temperature


class Point(NamedTuple):
    """Operating point, or a change of one."""

    load: float  # [N]
    speed: float  # [rad/s]
    tilt: float  # [rad]
    oil_temperature: float  # [K]
    far_face: float  # [K] temperature at the gear's far face; the oil's, if it is not the bulk's


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
    factor: Array  # factors of the heat equations, see ``heat_factor``
    following: Array  # (4, n_temp) dT/dq with the factor
    small: Array  # (N_SMALL,) balances and 4 x 4 systems
    ht: Array  # (n,) mean gap of film 1 and its slope
    dht: Array
    pc: Array  # (n,) contact pressure of film 1 and its slope
    dpc: Array
    arm_pc: Array  # (n,) radius at which the gap's change counts for it [m]
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
    arm_cr: Array  # (n,) radius at which the gap's change counts for it [m]
    wedge: Array  # (n,) what drives the film at the face j..j+1, slope over h
    dwedge: Array
    wet: Array  # (n,) 1 where the film is full, 0 where it cavitates
    flow_t: Array  # (n,) oil flow through the face j..j+1 [m^3/s], and its change
    dflow_t: Array
    flow_r: Array  # (n,) through the face i..i+1, and its change
    dflow_r: Array
    leaving: Array  # (n,) what leaves a node, at rims over the rim too [m^3/s], and its change
    dleaving: Array
    rim: Array  # (n,) what leaves over the rim [m^3/s], and its change
    drim: Array
    liquid: Array  # (n,) share of the gap that liquid fills, and its change
    dliquid: Array
    outlet: Array  # (n,) rise of the oil that leaves a node above the supply [K], and its change
    doutlet: Array
    edge: Array  # (n,) the same of oil that leaves across the circumference
    dedge: Array
    across: Array  # (n,) share of the outlet's rise over the node that counts there, its change
    dacross: Array
    made: Array  # (n,) heat made in the film [W]
    exchange: Array  # (n,) its conductance to the walls [W/K]
    place: Array  # (n_t,) position of a column in the film's system, -1 dry
    film: Array  # band of the film equations
    film_rhs: Array  # (n, N_SIDES) right sides, then solutions
    lag: Array  # (n, N_SIDES) fluidity changes that follow the temperatures
    sides: Array  # (n N_SIDES,) right sides in the order of the film's system
    temp: Array  # (n_temp,) rises above the oil [K], the iterate
    p: Array  # (n,) pressure [Pa] at the positions and temperatures last evaluated
    dp: Array  # (n,) its change
    heat: Array  # (n_temp,) residual of the heat equations [W]
    dtemp: Array  # (n_temp,) T step at fixed positions
    spare: Array  # (n_temp,) permuted right side
    outward: Array  # (n_temp,) rises that heat flows out to through the bodies [K]
    begin: Array  # (n_temp,) rises at the start of a substep
    trial: Array  # (n_temp,) scratch
    flux: Array  # (n_temp,) heat that enters a body at the start of a substep [W/m^2]
    ladder: Array  # (N_TERMS, n_temp) rises of the terms of the ladders [K], see ``ladder``
    rings: Array  # (padded n_ring,) a right side of the rings
    keep: Array  # (N_KEPT (4 + n_temp + n),) remembered solutions; scratch of derivatives too


def temperatures_of(n_r: int, n_t: int) -> int:
    """Return the largest number of temperatures: oil and bodies, the gear as wide as can be."""
    return (4 * n_r - 1) * n_t


def size_of_state(n_r: int, n_t: int) -> int:
    """Return the length of ``state`` for a grid."""
    return L.S_FIELDS + (2 + L.N_TERMS) * temperatures_of(n_r, n_t) + n_r * n_t


def size_of_work(n_r: int, n_t: int) -> int:
    """Return the length of ``work`` behind its head for a grid; the heat factor needs most."""
    n, n_temp = n_r * n_t, temperatures_of(n_r, n_t)
    film = (2 * n_r + 1) * n
    kept = L.N_KEPT * (4 + n_temp + n)
    per_node = N_NODAL + 3 * N_SIDES + 2
    per_temperature = 1 + 4 + 1 + N_THERMAL + L.N_TERMS
    rings = 3 * n_r + N_SIDES  # of the bodies that turn, or of the carrier, at most
    head = L.N_TAG + L.N_SMALL + n_t + rings
    return head + size_of_factor(n_r, n_t) + per_temperature * n_temp + per_node * n + film + kept


def size_of_factor(n_r: int, n_t: int) -> int:
    """Return the length of the largest factor: band four times, borders twice, rings."""
    width, n_temp, rings = 2 * (4 * n_r - 1) + 1, temperatures_of(n_r, n_t), 3 * n_r + N_SIDES
    return n_temp * (4 * width + 2 * rings) + rings * (rings + 1)


@kernel
def padded(n_ring: int) -> int:
    """Return the number of rings rounded up to whole vector registers."""
    return (n_ring + N_SIDES - 1) // N_SIDES * N_SIDES


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
def fields_of(w: Workspace) -> Fields:
    """Return the work by name; the arrays are views."""
    par, work = w.par, w.work
    n_r, n_t = int(par[L.D_RADIAL]), int(par[L.D_AROUND])
    n, n_ring = n_r * n_t, int(par[L.D_RINGS])
    n_band = int(par[L.D_PER_COLUMN]) * n_t
    n_temp = n_band + n_ring
    width, sides = 2 * int(par[L.D_PER_COLUMN]) + 1, padded(n_ring)
    factor = L.N_TAG + 1 + n_temp
    following = factor + n_band * (4 * width + 2 * sides) + sides * (sides + 1)
    small = following + 4 * n_temp
    first = small + L.N_SMALL
    place = first + N_NODAL * n
    film = place + n_t
    rhs = film + (2 * n_r + 1) * n
    lag = rhs + N_SIDES * n
    right = lag + N_SIDES * n
    temp = right + N_SIDES * n
    pressure = temp + n_temp
    heat = pressure + 2 * n
    ladder = heat + N_THERMAL * n_temp
    rings = ladder + L.N_TERMS * n_temp
    keep = rings + sides
    nodal = matrix(work[first:place], N_NODAL, n)
    thermal = matrix(work[heat:ladder], N_THERMAL, n_temp)
    return Fields(
        tag=work[:factor],
        factor=work[factor:following],
        following=matrix(work[following:small], 4, n_temp),
        small=work[small:first],
        ht=nodal[0],
        dht=nodal[1],
        pc=nodal[2],
        dpc=nodal[3],
        arm_pc=nodal[4],
        ht2=nodal[5],
        dht2=nodal[6],
        pc2=nodal[7],
        dpc2=nodal[8],
        mu=nodal[9],
        dmu=nodal[10],
        fluidity=nodal[11],
        ct=nodal[12],
        dct=nodal[13],
        cr=nodal[14],
        dcr=nodal[15],
        arm_cr=nodal[16],
        wedge=nodal[17],
        dwedge=nodal[18],
        wet=nodal[19],
        flow_t=nodal[20],
        dflow_t=nodal[21],
        flow_r=nodal[22],
        dflow_r=nodal[23],
        leaving=nodal[24],
        dleaving=nodal[25],
        rim=nodal[26],
        drim=nodal[27],
        liquid=nodal[28],
        dliquid=nodal[29],
        outlet=nodal[30],
        doutlet=nodal[31],
        edge=nodal[32],
        dedge=nodal[33],
        across=nodal[34],
        dacross=nodal[35],
        made=nodal[36],
        exchange=nodal[37],
        place=work[place:film],
        film=work[film:rhs],
        film_rhs=matrix(work[rhs:lag], n, N_SIDES),
        lag=matrix(work[lag:right], n, N_SIDES),
        sides=work[right:temp],
        temp=work[temp:pressure],
        p=work[pressure : pressure + n],
        dp=work[pressure + n : heat],
        heat=thermal[0],
        dtemp=thermal[1],
        spare=thermal[2],
        outward=thermal[3],
        begin=thermal[4],
        trial=thermal[5],
        flux=thermal[6],
        ladder=matrix(work[ladder:rings], L.N_TERMS, n_temp),
        rings=work[rings:keep],
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
