"""The washer's constants for the kernels: parameters by name, mesh, contact tables.

The mesh is polar: nodes at both rims and at the gear's inner radius. Radial nodes are uniform up
to the gear's inner radius and then graded towards the outer rim, where film and contact are
thinnest. Around the circumference they crowd near theta = 0, where the tilt about y closes the
film: theta = s - c sin(s), s uniform, which keeps the trapezoid rule spectrally accurate.
"""

import math
from typing import NamedTuple

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel, matrix
from ...numerics.spline import spline_weights
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK
from ...tribology.asperities import N_CONTACT_WORK, N_TABLE, asperity_args, contact_table
from . import layout as L

RADIAL_GRADING = 1.7
ANGULAR_GRADING = 0.5


class WasherModel(NamedTuple):
    """Parameters by name (SI), derived scalars, mesh arrays, contact tables."""

    par: Array  # all parameters, whole
    inner_radius: float
    outer_radius: float
    carrier_thickness: float
    washer_thickness: float
    gear_thickness: float
    carrier_conductivity: float
    washer_conductivity: float
    gear_conductivity: float
    oil_conductivity: float
    heat_split: float
    film_heat_fraction: float
    oil_storage: float  # [J/(m^3 K)] oil's density times specific heat; 0: it carries no heat
    film_exchange: float  # 12 oil_conductivity [W/(m K)]; 0 where the film is as warm as the walls
    pressure_shear: float  # 1 if pressure flow counts in torque and heat, else 0
    is_insulated: bool  # the gear's far face
    only_liquid: bool  # the cavity counts by its liquid in shear and heat exchange
    n_r: int
    n_t: int
    i_g: int  # radial node at the gear's inner radius
    per_column: int  # temperatures of a column
    n_ring: int  # temperatures of rings
    film_at: int  # where the fields of temperature begin and their steps, see the layout
    film_step: int
    carrier_at: int
    carrier_step: int
    washer_at: int
    washer_step: int
    gear_at: int  # of the node on the gear's inner radius
    gear_step: int
    sigma1: float  # [m] film 1
    sigma2: float  # [m] gap 2
    shear: float  # (sigma_carrier^2 - sigma_washer^2)/sigma^2
    mean_summit1: float  # [m] height of the summits' mean above the surface's
    mean_summit2: float
    summit_sigma1: float  # [m] scatter of the summits
    summit_sigma2: float
    table1: Array
    table2: Array
    r: Array  # (n_r,) nodes [m]
    r_face: Array  # (n_r,) outer face of each cell [m]; the last is the rim
    middle: Array  # (n_r,) centre of each cell's area [m]: a gap linear in r has its mean there
    log_width: Array  # (n_r,) ln(outer/inner face)
    weight1: Array  # (n_r,) spline weights x r over ri..ro [m^2]
    weight2: Array  # (n_r,) the same over rig..ro, zero inside
    along: Array  # (n_r,) outer face over the distance to the next node; last 0
    gear_width: Array  # (n_r,) log_width, from rig outwards only
    cos: Array  # (n_t,) at nodes
    sin: Array
    cos_face: Array  # (n_t,) at the face between j and j + 1
    sin_face: Array
    weight_t: Array  # (n_t,) trapezoid weights [rad]
    width_t: Array  # (n_t,) cell widths [rad]
    step_t: Array  # (n_t,) from j to j + 1 [rad]
    per_step: Array  # (n_t,) its reciprocal


@kernel
def gear_node(n_r: int, share: float) -> int:
    """Return the radial node on the gear's inner radius, which has ``share`` of the width inside.

    Less than its share of the intervals goes inside (two of nine for the default washer), for the
    outer part is the harder one; each part keeps what its quadrature needs.
    """
    least = max(1, min(2, int(share * (n_r - 1))))
    return min(max(least, int(0.6 * share * (n_r - 1) + 0.3)), n_r - 4)


def size_of_par(n_r: int, n_t: int) -> int:
    """Return the length of ``par`` for a grid; its tail is scratch for `derive_grid`."""
    mesh = L.N_RADIAL * n_r + L.N_AROUND * n_t
    return L.D_MESH + mesh + max(N_CONTACT_WORK, n_r * n_r + n_r)


@kernel
def _end_of_mesh(n_r: int, n_t: int) -> int:
    return L.D_MESH + L.N_RADIAL * n_r + L.N_AROUND * n_t


@kernel
def mesh_arrays(par: Array, n_r: int, n_t: int) -> tuple[Array, Array]:
    """Return the mesh in ``par``: (N_RADIAL, n_r) and (N_AROUND, n_t), rows as in the layout."""
    around = L.D_MESH + L.N_RADIAL * n_r
    end = around + L.N_AROUND * n_t
    return matrix(par[L.D_MESH : around], L.N_RADIAL, n_r), matrix(par[around:end], L.N_AROUND, n_t)


@kernel
def summits(par: Array, sigma: float) -> tuple[float, float, bool]:
    """Return height and scatter [m] of the summits (Jackson & Green Eq 15), and if they exist."""
    density_radius = par[L.P_ASPERITY_DENSITY] * par[L.P_ASPERITY_RADIUS]
    variance = sigma * sigma
    if par[L.P_ASPERITY_HEIGHT_LAW] == L.SUMMIT_HEIGHTS:
        variance -= 3.717e-4 / density_radius**2
    if not variance > 0.0:
        return 0.0, sigma, False
    return 0.045944 / density_radius, math.sqrt(variance), True


@kernel
def _mesh(par: Array, n_r: int, n_t: int, i_g: int) -> bool:
    """Fill the mesh arrays of ``par``."""
    radial, around = mesh_arrays(par, n_r, n_t)
    r, face, middle = radial[L.RADIUS], radial[L.FACE], radial[L.MIDDLE]
    log_width = radial[L.LOG_WIDTH]
    weight1, weight2 = radial[L.WEIGHT1], radial[L.WEIGHT2]
    along, gear_width = radial[L.ALONG], radial[L.GEAR_WIDTH]
    ri, ro, rg = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_GEAR_INNER_RADIUS]
    for i in range(i_g + 1):
        r[i] = ri + (rg - ri) * i / i_g
    for i in range(i_g, n_r):
        s = (i - i_g) / (n_r - 1 - i_g)
        r[i] = rg + (ro - rg) * (1.0 - (1.0 - s) ** RADIAL_GRADING)
    r[n_r - 1] = ro
    for i in range(n_r):
        face[i] = 0.5 * (r[i] + r[i + 1]) if i + 1 < n_r else ro
        inner = face[i - 1] if i > 0 else ri
        log_width[i] = math.log(face[i] / inner)
        middle[i] = 2.0 / 3.0 * (inner + face[i] * face[i] / (inner + face[i]))
    for i in range(n_r):
        along[i] = face[i] / (r[i + 1] - r[i]) if i + 1 < n_r else 0.0
        gear_width[i] = math.log(face[i] / r[i]) if i == i_g else log_width[i]
    scratch = par[_end_of_mesh(n_r, n_t) :]
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
        around[L.COS, j], around[L.SIN, j] = math.cos(here), math.sin(here)
        around[L.COS_FACE, j], around[L.SIN_FACE, j] = math.cos(half), math.sin(half)
        around[L.WEIGHT_T, j] = step * (1.0 - c * math.cos(s))
        around[L.WIDTH_T, j] = half - (s_before - c * math.sin(s_before))
        around[L.STEP_T, j] = step - c * (math.sin(s + step) - math.sin(s))
        around[L.PER_STEP, j] = 1.0 / around[L.STEP_T, j]
    return good


@kernel
def derive_grid(par: Array, n_r: int, n_t: int) -> int:
    """Fill everything behind the parameters in ``par`` for a grid; return a status.

    ``par`` has at least ``size_of_par(n_r, n_t)`` entries; n_r >= 5, n_t >= 8.
    """
    inner, outer, gear = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_GEAR_INNER_RADIUS]
    if n_r < 5 or n_t < 8 or not (0.0 < inner < gear < outer):
        return BAD_INPUT
    i_g = gear_node(n_r, (gear - inner) / (outer - inner))
    good = _mesh(par, n_r, n_t, i_g)
    status = derive_surfaces(par, par[_end_of_mesh(n_r, n_t) :])
    par[L.D_RADIAL], par[L.D_AROUND], par[L.D_GEAR_NODE] = n_r, n_t, i_g
    own = n_r if par[L.P_OIL_COOLING] != 0.0 else 0  # temperatures of the film
    rotating = 2 * n_r - i_g
    if par[L.P_CONDUCTION] == L.ONLY_CARRIER:
        par[L.D_PER_COLUMN], par[L.D_RINGS] = own + n_r, rotating
    elif par[L.P_CONDUCTION] == L.ONLY_ROTATING:
        par[L.D_PER_COLUMN], par[L.D_RINGS] = own + rotating, n_r
    else:
        par[L.D_PER_COLUMN], par[L.D_RINGS] = own + n_r + rotating, 0
    return status if status != OK or good else NOT_FINITE


@kernel
def combined_roughness(par: Array) -> tuple[float, float, float]:
    """Return the RMS roughness of film 1 and gap 2 [m], and how film 1 is shared (see D_SHEAR)."""
    carrier = of_body(par, L.P_ROUGHNESS, L.OF_CARRIER)
    washer = of_body(par, L.P_ROUGHNESS, L.OF_WASHER)
    gear = of_body(par, L.P_ROUGHNESS, L.OF_GEAR)
    sigma1 = math.sqrt(carrier * carrier + washer * washer)
    sigma2 = math.sqrt(gear * gear + washer * washer)
    return sigma1, sigma2, (carrier * carrier - washer * washer) / (sigma1 * sigma1)


class ContactPair(NamedTuple):
    """Two bodies in contact: E' of both, the rest of the softer one (SI)."""

    contact_modulus: float
    youngs_modulus: float
    poisson_ratio: float
    yield_strength: float


@kernel
def of_body(par: Array, common: int, body: int) -> float:
    """Return a property of a body (OF_CARRIER, OF_WASHER, OF_GEAR): its own, else the common."""
    own = par[np.uintp(common + body)]
    if own > 0.0:
        return float(own)
    return float(par[np.uintp(common)])


@kernel
def contact_pair(par: Array, body: int) -> ContactPair:
    """Return what the contact of the washer with another body needs."""
    e1, e2 = of_body(par, L.P_YOUNGS_MODULUS, body), of_body(par, L.P_YOUNGS_MODULUS, L.OF_WASHER)
    nu1, nu2 = of_body(par, L.P_POISSON_RATIO, body), of_body(par, L.P_POISSON_RATIO, L.OF_WASHER)
    s1, s2 = of_body(par, L.P_YIELD_STRENGTH, body), of_body(par, L.P_YIELD_STRENGTH, L.OF_WASHER)
    modulus = 1.0 / ((1.0 - nu1 * nu1) / e1 + (1.0 - nu2 * nu2) / e2)
    if s1 < s2:
        return ContactPair(modulus, e1, nu1, s1)
    return ContactPair(modulus, e2, nu2, s2)


@kernel
def _tabulate(par: Array, pair: ContactPair, scatter: float, table: Array, scratch: Array) -> bool:
    """Fill the contact table of a pair of bodies; return True if it could be filled."""
    a = asperity_args(
        pair.contact_modulus,
        pair.youngs_modulus,
        pair.poisson_ratio,
        pair.yield_strength,
        par[L.P_YIELD_STRAIN_LAW] == L.CONTACT_YIELD,
        par[L.P_ASPERITY_RADIUS],
    )
    return contact_table(a, par[L.P_ASPERITY_DENSITY], scatter, table, scratch)


@kernel
def derive_surfaces(par: Array, scratch: Array) -> int:
    """Fill the scalars and the contact tables of ``par``; ``scratch`` (N_CONTACT_WORK,) or more."""
    sigma1, sigma2, shear = combined_roughness(par)
    height1, scatter1, good1 = summits(par, sigma1)
    height2, scatter2, good2 = summits(par, sigma2)
    first, second = par[L.D_TABLE1 : L.D_TABLE2], par[L.D_TABLE2 : L.D_MESH]
    pair1, pair2 = contact_pair(par, L.OF_CARRIER), contact_pair(par, L.OF_GEAR)
    good = _tabulate(par, pair1, scatter1, first, scratch)
    if scatter2 == scatter1 and pair1 == pair2:
        copy(first, second[:N_TABLE])
    else:
        good = _tabulate(par, pair2, scatter2, second, scratch) and good
    par[L.D_RADIAL], par[L.D_AROUND], par[L.D_GEAR_NODE] = 0.0, 0.0, 0.0
    par[L.D_SIGMA1], par[L.D_SIGMA2], par[L.D_SHEAR] = sigma1, sigma2, shear
    par[L.D_MEAN_SUMMIT1], par[L.D_MEAN_SUMMIT2] = height1, height2
    par[L.D_SUMMIT_SIGMA1], par[L.D_SUMMIT_SIGMA2] = scatter1, scatter2
    if not (good1 and good2):
        return BAD_INPUT
    return OK if good else NOT_FINITE


@kernel
def washer_model(par: Array) -> WasherModel:
    """Return ``par`` by name; the arrays are views."""
    n_r, n_t = int(par[L.D_RADIAL]), int(par[L.D_AROUND])
    radial, around = mesh_arrays(par, n_r, n_t)
    i_g = int(par[L.D_GEAR_NODE])
    cooled = par[L.P_OIL_COOLING] != 0.0
    column, rings = int(par[L.D_PER_COLUMN]), int(par[L.D_RINGS])
    storage = par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY] if cooled else 0.0
    exchange = 12.0 * par[L.P_OIL_CONDUCTIVITY] if cooled else 0.0
    shears = 1.0 if par[L.P_PRESSURE_FLOW_SHEAR] != 0.0 else 0.0
    carrier_at, film_step = 0, 0
    if cooled:
        carrier_at, film_step = n_r, column
    end = column * n_t
    carrier_step, rotating_step = column, column
    washer_at = carrier_at + n_r
    gear_at = washer_at + n_r
    if par[L.P_CONDUCTION] == L.ONLY_CARRIER:
        washer_at, gear_at, rotating_step = end, end + n_r, 0
    elif par[L.P_CONDUCTION] == L.ONLY_ROTATING:
        washer_at, gear_at = carrier_at, carrier_at + n_r
        carrier_at, carrier_step = end, 0
    return WasherModel(
        par=par,
        inner_radius=par[L.P_INNER_RADIUS],
        outer_radius=par[L.P_OUTER_RADIUS],
        carrier_thickness=par[L.P_CARRIER_THICKNESS],
        washer_thickness=par[L.P_WASHER_THICKNESS],
        gear_thickness=par[L.P_GEAR_THICKNESS],
        carrier_conductivity=of_body(par, L.P_CONDUCTIVITY, L.OF_CARRIER),
        washer_conductivity=of_body(par, L.P_CONDUCTIVITY, L.OF_WASHER),
        gear_conductivity=of_body(par, L.P_CONDUCTIVITY, L.OF_GEAR),
        oil_conductivity=par[L.P_OIL_CONDUCTIVITY],
        heat_split=par[L.P_HEAT_SPLIT],
        film_heat_fraction=par[L.P_FILM_HEAT_FRACTION],
        oil_storage=storage,
        film_exchange=exchange,
        pressure_shear=shears,
        is_insulated=par[L.P_GEAR_FAR_FACE] == L.INSULATED,
        only_liquid=par[L.P_CAVITY_SHEAR] == L.ONLY_LIQUID,
        n_r=n_r,
        n_t=n_t,
        i_g=i_g,
        per_column=column,
        n_ring=rings,
        film_at=0,
        film_step=film_step,
        carrier_at=carrier_at,
        carrier_step=carrier_step,
        washer_at=washer_at,
        washer_step=rotating_step,
        gear_at=gear_at,
        gear_step=rotating_step,
        sigma1=par[L.D_SIGMA1],
        sigma2=par[L.D_SIGMA2],
        shear=par[L.D_SHEAR],
        mean_summit1=par[L.D_MEAN_SUMMIT1],
        mean_summit2=par[L.D_MEAN_SUMMIT2],
        summit_sigma1=par[L.D_SUMMIT_SIGMA1],
        summit_sigma2=par[L.D_SUMMIT_SIGMA2],
        table1=par[L.D_TABLE1 : L.D_TABLE2],
        table2=par[L.D_TABLE2 : L.D_MESH],
        r=radial[L.RADIUS],
        r_face=radial[L.FACE],
        middle=radial[L.MIDDLE],
        log_width=radial[L.LOG_WIDTH],
        weight1=radial[L.WEIGHT1],
        weight2=radial[L.WEIGHT2],
        along=radial[L.ALONG],
        gear_width=radial[L.GEAR_WIDTH],
        cos=around[L.COS],
        sin=around[L.SIN],
        cos_face=around[L.COS_FACE],
        sin_face=around[L.SIN_FACE],
        weight_t=around[L.WEIGHT_T],
        width_t=around[L.WIDTH_T],
        step_t=around[L.STEP_T],
        per_step=around[L.PER_STEP],
    )
