"""The washer's constants for the kernels: parameters by name, mesh, contact tables.

The mesh is polar: nodes at both rims and at the gear's inner radius. Radial nodes are uniform up
to the gear's inner radius and then graded towards the outer rim, where film and contact are
thinnest. Around the circumference they crowd near theta = 0, where the tilt about y closes the
film: theta = s - c sin(s), s uniform, which keeps the trapezoid rule spectrally accurate.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .asperities import N_CONTACT_WORK, N_TABLE, asperity_args, contact_table
from .spline import spline_weights

N_PARAM = 36  # 35 fields of WasherParams, then the fidelity
N_STEADY = 31  # the fields that a steady solution depends on; what follows belongs to time
THERMAL_MODE, THERMAL_START = 31, 34  # places in `par`
QUASI_STEADY, TRANSIENT, FROM_OIL = 1.0, 2.0, 2.0  # their values
N_SCALAR = 16
OUTER_RADIUS, SIGMA1, SIGMA2 = 1, N_PARAM + 3, N_PARAM + 4  # places in `par`
SUMMIT1, SUMMIT_SIGMA1 = N_PARAM + 6, N_PARAM + 8
TABLES = N_PARAM + N_SCALAR
MESH = TABLES + 2 * N_TABLE
WEDGE = MESH  # where a rung without a mesh has its nodes
N_RADIAL = 7  # arrays over the radial nodes
N_AROUND = 8  # arrays over the angles
COARSE_GRADING, FINE_GRADING = 1.6, 2.0  # best below and from FINE_FROM radial nodes
FINE_FROM = 16
ANGULAR_GRADING = 0.3
OK, NOT_FINITE, BAD_INPUT = 0, 14, 15  # errors.Status; a test keeps them equal


class WasherModel(NamedTuple):
    """Parameters by name (SI), derived scalars, mesh arrays, contact tables."""

    inner_radius: float
    outer_radius: float
    gear_inner_radius: float
    carrier_thickness: float
    washer_thickness: float
    gear_thickness: float
    conductivity: float
    oil_conductivity: float
    viscosity_constant: float
    viscosity_exponent: float
    viscosity_scale: float
    constant_friction: bool
    dry_friction: float
    friction_constant: float
    friction_slope: float
    friction_load_min: float
    friction_load_max: float
    heat_split: float
    film_heat_fraction: float
    volume_heat: float  # [J/(m^3 K)] density times specific heat
    carrier_spread: float  # factor on conduction around the circumference
    rotating_spread: float
    n_r: int
    n_t: int
    i_g: int  # radial node at the gear's inner radius
    sigma1: float  # [m] film 1
    sigma2: float  # [m] gap 2
    shear: float  # (sigma_carrier^2 - sigma_washer^2)/sigma^2
    mean_summit1: float  # [m] height of the summits' mean above the surface's
    mean_summit2: float
    summit_sigma1: float  # [m] scatter of the summits
    summit_sigma2: float
    table1: NDArray[np.float64]
    table2: NDArray[np.float64]
    r: NDArray[np.float64]  # (n_r,) nodes [m]
    r_face: NDArray[np.float64]  # (n_r,) outer face of each cell [m]; the last is the rim
    log_width: NDArray[np.float64]  # (n_r,) ln(outer/inner face)
    weight1: NDArray[np.float64]  # (n_r,) spline weights x r over ri..ro [m^2]
    weight2: NDArray[np.float64]  # (n_r,) the same over rig..ro, zero inside
    along: NDArray[np.float64]  # (n_r,) outer face over the distance to the next node; last 0
    gear_width: NDArray[np.float64]  # (n_r,) log_width, from rig outwards only
    cos: NDArray[np.float64]  # (n_t,) at nodes
    sin: NDArray[np.float64]
    cos_face: NDArray[np.float64]  # (n_t,) at the face between j and j + 1
    sin_face: NDArray[np.float64]
    weight_t: NDArray[np.float64]  # (n_t,) trapezoid weights [rad]
    width_t: NDArray[np.float64]  # (n_t,) cell widths [rad]
    step_t: NDArray[np.float64]  # (n_t,) from j to j + 1 [rad]
    per_step: NDArray[np.float64]  # (n_t,) its reciprocal


class Plates(NamedTuple):
    """The parameters alone by the same names: a fifth of the words in every call."""

    inner_radius: float
    outer_radius: float
    gear_inner_radius: float
    carrier_thickness: float
    washer_thickness: float
    gear_thickness: float
    conductivity: float
    oil_conductivity: float
    viscosity_constant: float
    viscosity_exponent: float
    viscosity_scale: float
    constant_friction: bool
    dry_friction: float
    friction_constant: float
    friction_slope: float
    friction_load_min: float
    friction_load_max: float
    heat_split: float
    film_heat_fraction: float


@kernel
def washer_plates(par: NDArray[np.float64]) -> Plates:
    """Return the parameters in ``par`` by name."""
    return Plates(
        par[0], par[1], par[2], par[3], par[4], par[5],
        par[17], par[19], par[20], par[21], par[22],
        par[23] == 2.0, par[24], par[25], par[26], par[27], par[28], par[29], par[30],
    )  # fmt: skip


@kernel
def gear_node(n_r: int, share: float) -> int:
    """Return the radial node on the gear's inner radius, which has ``share`` of the width inside.

    A little less than its share of the intervals goes inside (a third for the default washer), for
    the outer part is the harder one; each part keeps what its quadrature needs.
    """
    return min(max(1, int(0.86 * share * (n_r - 1) + 0.3)), n_r - 4)


def size_of_par(n_r: int, n_t: int) -> int:
    """Return the length of ``par`` for a grid; its tail is scratch for `derive_grid`."""
    scratch = max(N_CONTACT_WORK, n_r * n_r + n_r)
    return MESH + N_RADIAL * n_r + N_AROUND * n_t + scratch


@kernel
def _pair(par: NDArray[np.float64], first: int, second: int) -> tuple[float, float]:
    """Return the RMS roughness of two surfaces, overrides taken into account."""
    common = par[6]
    a = par[first] if par[first] > 0.0 else common
    b = par[second] if par[second] > 0.0 else common
    return a, b


@kernel
def _gap_constants(par: NDArray[np.float64], sigma: float) -> tuple[float, float, bool]:
    """Return height and scatter [m] of the summits (Jackson & Green Eq 15), and if they exist."""
    density_radius = par[15] * par[14]
    variance = sigma * sigma
    if par[16] == 2.0:
        variance -= 3.717e-4 / density_radius**2
    if not variance > 0.0:
        return 0.0, sigma, False
    return 0.045944 / density_radius, math.sqrt(variance), True


@kernel
def _mesh(par: NDArray[np.float64], n_r: int, n_t: int, i_g: int) -> bool:
    """Fill the mesh arrays of ``par``."""
    base = MESH
    r = par[base : base + n_r]
    face = par[base + n_r : base + 2 * n_r]
    log_width = par[base + 2 * n_r : base + 3 * n_r]
    weight1 = par[base + 3 * n_r : base + 4 * n_r]
    weight2 = par[base + 4 * n_r : base + 5 * n_r]
    ri, ro, rg = par[0], par[1], par[2]
    for i in range(i_g + 1):
        r[i] = ri + (rg - ri) * i / i_g
    grading = FINE_GRADING if n_r >= FINE_FROM else COARSE_GRADING
    for i in range(i_g, n_r):
        s = (i - i_g) / (n_r - 1 - i_g)
        r[i] = rg + (ro - rg) * (1.0 - (1.0 - s) ** grading)
    r[n_r - 1] = ro
    for i in range(n_r):
        face[i] = 0.5 * (r[i] + r[i + 1]) if i + 1 < n_r else ro
        log_width[i] = math.log(face[i] / (face[i - 1] if i > 0 else ri))
    for i in range(n_r):
        par[base + 5 * n_r + i] = face[i] / (r[i + 1] - r[i]) if i + 1 < n_r else 0.0
        par[base + 6 * n_r + i] = math.log(face[i] / r[i]) if i == i_g else log_width[i]
    around = base + N_RADIAL * n_r
    scratch = par[around + N_AROUND * n_t :]
    good = spline_weights(r, weight1, n_r, scratch)
    good = spline_weights(r[i_g:], weight2[i_g:], n_r - i_g, scratch) and good
    least1, least2 = 1.0, 1.0
    for i in range(n_r):
        weight1[i] *= r[i]
        weight2[i] = weight2[i] * r[i] if i >= i_g else 0.0
        least1 = min(least1, weight1[i])
        least2 = min(least2, weight2[i] if i >= i_g else 1.0)
    # on parts of very unequal width a spline may count a node negative: cell areas instead
    for i in range(n_r):
        inner = face[i - 1] if i > 0 else ri
        if least1 <= 0.0:
            weight1[i] = 0.5 * (face[i] * face[i] - inner * inner)
        if least2 <= 0.0 and i >= i_g:
            inner = rg if i == i_g else inner
            weight2[i] = 0.5 * (face[i] * face[i] - inner * inner)
    c, step = ANGULAR_GRADING, 2.0 * math.pi / n_t
    for j in range(n_t):
        s, s_before, s_half = j * step, (j - 0.5) * step, (j + 0.5) * step
        here, half = s - c * math.sin(s), s_half - c * math.sin(s_half)
        k = around + j
        par[k], par[k + n_t] = math.cos(here), math.sin(here)
        par[k + 2 * n_t], par[k + 3 * n_t] = math.cos(half), math.sin(half)
        par[k + 4 * n_t] = step * (1.0 - c * math.cos(s))
        par[k + 5 * n_t] = half - (s_before - c * math.sin(s_before))
        par[k + 6 * n_t] = step - c * (math.sin(s + step) - math.sin(s))
        par[k + 7 * n_t] = 1.0 / par[k + 6 * n_t]
    return good


@kernel
def derive_grid(par: NDArray[np.float64], n_r: int, n_t: int) -> int:
    """Fill everything behind the parameters in ``par`` for a grid; return a status.

    ``par`` has at least ``size_of_par(n_r, n_t)`` entries; n_r >= 5, n_t >= 8.
    """
    if n_r < 5 or n_t < 8 or not (0.0 < par[0] < par[2] < par[1]):
        return BAD_INPUT
    i_g = gear_node(n_r, (par[2] - par[0]) / (par[1] - par[0]))
    good = _mesh(par, n_r, n_t, i_g)
    scratch = par[MESH + N_RADIAL * n_r + N_AROUND * n_t :]
    status = derive_surfaces(par, scratch)
    par[N_PARAM], par[N_PARAM + 1], par[N_PARAM + 2] = n_r, n_t, i_g
    return status if status != OK or good else NOT_FINITE


@kernel
def derive_surfaces(par: NDArray[np.float64], scratch: NDArray[np.float64]) -> int:
    """Fill the scalars and the contact tables of ``par``; ``scratch`` (N_CONTACT_WORK,) or more."""
    carrier, washer = _pair(par, 7, 8)
    gear, _ = _pair(par, 9, 8)
    sigma1 = math.sqrt(carrier * carrier + washer * washer)
    sigma2 = math.sqrt(gear * gear + washer * washer)
    height1, scatter1, good1 = _gap_constants(par, sigma1)
    height2, scatter2, good2 = _gap_constants(par, sigma2)
    a = asperity_args(par[10], par[11], par[12], par[13] == 2.0, par[14])
    first, second = par[TABLES : TABLES + N_TABLE], par[TABLES + N_TABLE : MESH]
    good = contact_table(a, par[15], scatter1, first, scratch)
    if scatter2 == scatter1:
        for k in range(N_TABLE):
            second[k] = first[k]
    else:
        good = contact_table(a, par[15], scatter2, second, scratch) and good
    d = N_PARAM
    par[d], par[d + 1], par[d + 2] = 0.0, 0.0, 0.0
    par[d + 3], par[d + 4] = sigma1, sigma2
    par[d + 5] = (carrier * carrier - washer * washer) / (sigma1 * sigma1)
    par[d + 6], par[d + 7], par[d + 8], par[d + 9] = height1, height2, scatter1, scatter2
    if not (good1 and good2):
        return BAD_INPUT
    return OK if good else NOT_FINITE


@kernel
def washer_model(par: NDArray[np.float64]) -> WasherModel:
    """Return ``par`` by name; the arrays are views."""
    d = N_PARAM
    n_r, n_t = int(par[d]), int(par[d + 1])
    many = 1e6  # evens a ring out to a thousandth of its variation without spoiling the matrix
    carrier_spread = many if par[18] == 3.0 else 1.0
    rotating_spread = many if par[18] == 2.0 else 1.0
    m, a = MESH, MESH + N_RADIAL * n_r
    return WasherModel(
        par[0], par[1], par[2], par[3], par[4], par[5],
        par[17], par[19], par[20], par[21], par[22],
        par[23] == 2.0, par[24], par[25], par[26], par[27], par[28], par[29], par[30],
        par[32] * par[33], carrier_spread, rotating_spread,
        n_r, n_t, int(par[d + 2]),
        par[d + 3], par[d + 4], par[d + 5], par[d + 6], par[d + 7], par[d + 8], par[d + 9],
        par[TABLES : TABLES + N_TABLE], par[TABLES + N_TABLE : MESH],
        par[m : m + n_r], par[m + n_r : m + 2 * n_r], par[m + 2 * n_r : m + 3 * n_r],
        par[m + 3 * n_r : m + 4 * n_r], par[m + 4 * n_r : m + 5 * n_r],
        par[m + 5 * n_r : m + 6 * n_r], par[m + 6 * n_r : m + 7 * n_r],
        par[a : a + n_t], par[a + n_t : a + 2 * n_t], par[a + 2 * n_t : a + 3 * n_t],
        par[a + 3 * n_t : a + 4 * n_t], par[a + 4 * n_t : a + 5 * n_t],
        par[a + 5 * n_t : a + 6 * n_t], par[a + 6 * n_t : a + 7 * n_t],
        par[a + 7 * n_t : a + 8 * n_t],
    )  # fmt: skip
