# mypy: disable-error-code="no-any-return"
"""Constants of a pack behind its parameters, and rules between these."""

import math

import numpy as np

from ...numerics.arrays import are_finite, copy
from ...numerics.jit import Array, kernel
from ...numerics.quadrature import GAUSS_NODES, GAUSS_WEIGHTS
from ...numerics.status import NOT_FINITE, OK
from ...tribology.flow_factors import squeeze_group
from ...tribology.greenwood_tripp import pressure_scale
from . import layout as L
from .pack_friction import ploughing, point_friction

SUMMED = 31.0 / 32.0 * 1.0369277551433699  # of 1/j^5 over odd j
SUMMED_CUBES = 7.0 / 8.0 * 1.2020569031595943  # of 1/j^3 over odd j
N_ODD = 13  # tanh(j pi/2) is 1 to rounding beyond
ROUNDING = 1e-12  # of a value: what a change of its unit may do to it
NUSSELT = 4.86  # Nusselt number of laminar flow in a slot, one wall heated


@kernel
def derive_friction(par: Array) -> None:
    """Fill area, mean radius and the two shares of boundary friction."""
    ri, ro = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    par[L.D_AREA] = math.pi * (ro - ri) * (ro + ri)
    mean = 2.0 * (ro * ro + ro * ri + ri * ri) / (3.0 * (ro + ri))
    par[L.D_RADIUS] = par[L.P_EFFECTIVE_RADIUS] if par[L.P_EFFECTIVE_RADIUS] > 0.0 else mean
    x = par[L.P_INDENTATION]
    root = math.sqrt((1.0 - x) * (1.0 + x))
    par[L.D_PLOUGH] = par[L.P_PLOUGH_WEIGHT] * ploughing(x)
    par[L.D_ADHESION] = (
        par[L.P_ADHESION_FACTOR] * 4.0 / (math.pi * par[L.P_HARDNESS_RATIO]) / (1.0 + root)
    )


@kernel
def has_start_table(par: Array) -> bool:
    """Tell if the table of friction over slip speed is that of the start values."""
    for k in range(L.N_TABLE + 1):
        start = L.START_FRICTION[k]
        if abs(par[np.uintp(L.P_TABLE_FRICTION_0 + 2 * k)] - start) > ROUNDING * start:
            return False
        start = L.START_SPEED[k]
        if (
            k > 0
            and abs(par[np.uintp(L.P_TABLE_FRICTION_0 + 2 * k - 1)] - start) > ROUNDING * start
        ):
            return False
    return True


@kernel
def slope_acts(par: Array) -> bool:
    """Tell if ``friction_temperature`` = auto lets the slope act.

    On the table of the start values and on the law of Wang et al., not on numbers of one's own.
    """
    if par[L.P_FIDELITY] == L.CLOSED:
        return False
    own = par[L.P_FRICTION_LAW] == L.TABLE_LAW and has_start_table(par)
    return own or par[L.P_FRICTION_LAW] == L.WANG_LAW


@kernel
def derive_temperature_law(par: Array) -> None:
    """Fill what changes friction with temperature, and the constant law at the reference."""
    par[L.D_TEMPERATURE_LAW] = par[L.D_POINTS] = 0.0
    par[L.D_POINT_REFERENCE], par[L.D_CONSTANT] = 1.0, par[L.P_CONSTANT_FRICTION]
    asked = par[L.P_FRICTION_TEMPERATURE]
    if asked == L.POINTS_LAW:
        n = 0
        for k in range(L.N_POINTS):
            if not par[np.uintp(L.P_POINT_FRICTION_1 + 2 * k)] > 0.0:
                break
            n = k + 1
        par[L.D_TEMPERATURE_LAW], par[L.D_POINTS] = float(L.POINTS_LAW), float(n)
        par[L.D_CONSTANT] = point_friction(par, par[L.P_REFERENCE_TEMPERATURE])[0]
        par[L.D_POINT_REFERENCE] = par[L.D_CONSTANT]
    elif asked == L.SLOPE_LAW or slope_acts(par):
        if par[L.P_FRICTION_TEMPERATURE_SLOPE] != 0.0:
            par[L.D_TEMPERATURE_LAW] = float(L.SLOPE_LAW)


@kernel
def derive_film(par: Array) -> None:
    """Fill what the asperities' pressure, the closing film and its shear need."""
    ri, ro, sigma = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_ROUGHNESS]
    group = par[L.P_ASPERITY_DENSITY] * par[L.P_ASPERITY_RADIUS] * sigma
    par[L.D_PRESSURE] = pressure_scale(
        sigma, par[L.P_CONTACT_MODULUS], par[L.P_ASPERITY_DENSITY], par[L.P_ASPERITY_RADIUS]
    )
    par[L.D_CONTACT_AREA] = math.pi * math.pi * group * group
    par[L.D_CLOSING] = (
        2.0
        * par[L.D_AREA]
        * sigma
        * sigma
        / (3.0 * math.pi * squeeze_group(ri, ro) * groove_factor(par))
    )
    cube = sigma * sigma * sigma
    par[L.D_SEEPAGE] = 12.0 * par[L.P_PERMEABILITY] * par[L.P_LINING_THICKNESS] / cube
    square = (ro - ri) * (ro + ri)
    lever = square * (ro * ro + ri * ri)
    par[L.D_VISCOUS] = par[L.P_FACES] * 0.5 * math.pi * lever / sigma
    # What centrifugal force pumps through a full gap; docs/theory/clutch.md.
    par[L.D_DEMAND] = math.pi * par[L.P_OIL_DENSITY] * cube * square / (12.0 * math.log(ro / ri))
    par[L.D_SUPPLY] = par[L.P_OIL_FLOW] / par[L.P_FACES]
    par[L.D_OPEN_RATIO] = par[L.P_INITIAL_FILM] / sigma
    par[L.D_GROOVE_RATIO] = par[L.P_GROOVE_DEPTH] / sigma
    par[L.D_PARTING] = par[L.P_SEPARATING_FORCE] / par[L.D_AREA]
    derive_lift(par)


@kernel
def derive_lift(par: Array) -> None:
    """Fill what slip piles up before the lands, and the share of it that parts the faces.

    The pressure on a pad a (along the slip) by b that is 1 at one end and 0 around is on average
    8 b/(pi^3 a) sum over odd j of tanh(j pi a/(2 b))/j^3. Derived in docs/theory/clutch/release.md.
    """
    ri, ro, n = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_GROOVE_COUNT]
    par[L.D_LIFT] = par[L.D_LIFT_SHARE] = par[L.D_PAD_RATIO] = 0.0
    if n == 0.0:
        return
    sigma, width = par[L.P_ROUGHNESS], par[L.P_GROOVE_WIDTH]
    along, across = math.pi * (ro + ri) / n - width, ro - ri
    total = SUMMED_CUBES
    for i in range(N_ODD):
        j = 2.0 * i + 1.0
        total -= 2.0 / (math.exp(min(j * math.pi * along / across, 700.0)) + 1.0) / (j * j * j)
    mean = 8.0 * across / (math.pi * math.pi * math.pi * along) * total
    par[L.D_LIFT_SHARE] = mean * n * along * across / par[L.D_AREA]
    par[L.D_PAD_RATIO] = width / along
    step = par[L.P_GROOVE_DEPTH] * width / (sigma * sigma * sigma)
    par[L.D_LIFT] = 3.0 * par[L.D_RADIUS] * step


@kernel
def groove_factor(par: Array) -> float:
    """Return the squeeze resistance [-] of the lands between the grooves over a plain ring's.

    N rectangular pads a x l, a <= l, each with F = eta v a^3 l k/h^3 and k = 1 - 192 a/(pi^5 l)
    sum over odd j of tanh(j pi l/(2 a))/j^5. Derived in docs/theory/clutch.md.
    """
    ri, ro, n = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_GROOVE_COUNT]
    if n == 0.0:
        return 1.0
    along = math.pi * (ro + ri) / n - par[L.P_GROOVE_WIDTH]
    a, b = min(ro - ri, along), max(ro - ri, along)
    total = SUMMED
    for i in range(N_ODD):
        j = 2.0 * i + 1.0
        total -= 2.0 / (math.exp(min(j * math.pi * b / a, 700.0)) + 1.0) / (j * j * j * j * j)
    k = 1.0 - 192.0 * a / (math.pi * math.pi * math.pi * math.pi * math.pi * b) * total
    return n * a * a * a * b * k / (1.5 * math.pi * squeeze_group(ri, ro))


@kernel
def derive_heat(par: Array) -> None:
    """Fill the lumped heat of half a plate and, where asked for, its conduction modes.

    Half a plate, heated at the face, insulated in its middle: surface minus mean temperature is
    the sum of modes d theta_n/dt = 2 P/C - (n pi/l)^2 a theta_n. The last one stands for all that
    follow, with the sum of their steady rises.
    """
    half = 0.5 * par[L.P_STEEL_THICKNESS]
    volume_heat = par[L.P_STEEL_DENSITY] * par[L.P_STEEL_HEAT_CAPACITY]
    capacity = volume_heat * par[L.D_AREA] * half
    par[L.D_CAPACITY] = capacity
    par[L.D_DECAY] = 0.0  # of the mean temperature: it depends on the film
    par[L.D_GAIN] = 1.0 / capacity
    par[L.D_MODES] = float(L.N_MODES) if par[L.P_CONTACT_RISE] != 0.0 else 0.0
    first = math.pi * math.pi * par[L.P_STEEL_CONDUCTIVITY] / (volume_heat * half * half)
    rest = math.pi * math.pi / 6.0
    for n in range(1, L.N_MODES + 1):
        square = float(n) * float(n)
        par[np.uintp(L.D_DECAY + n)] = first * square
        par[np.uintp(L.D_GAIN + n)] = 2.0 / capacity
        rest -= 1.0 / square
    last = float(L.N_MODES) * float(L.N_MODES)
    par[np.uintp(L.D_GAIN + L.N_MODES)] = 2.0 / capacity * (1.0 + last * rest)


@kernel
def derive_cooling(par: Array) -> None:
    """Fill how well a closed face is cooled, by oil in its grooves, and what the supply takes."""
    par[L.D_CLOSED_COOLING] = par[L.P_HEAT_TRANSFER]
    if par[L.P_GROOVE_COUNT] > 0.0 and par[L.P_LAND_SHARE] < 1.0:
        in_groove = NUSSELT * par[L.P_OIL_CONDUCTIVITY] / (2.0 * par[L.P_GROOVE_DEPTH])
        par[L.D_CLOSED_COOLING] = in_groove * (1.0 - par[L.P_LAND_SHARE])
    heat = par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY] * par[L.P_OIL_FLOW]
    par[L.D_OIL_COOLING] = heat / (par[L.P_FACES] * par[L.D_AREA])


@kernel
def derive_rings(par: Array, n: int) -> None:
    """Fill ``n`` rings of equal width: each is a pack of its own on the film of all.

    Its weight in the film is its share of the integral of (r^2 - c^2)^2/r over the radius, by
    which oil of viscosity eta(r) resists being squeezed; c is the radius where it does not flow.
    """
    ri, ro = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    scale = par[L.D_RADIUS] * 3.0 * (ro + ri) / (2.0 * (ro * ro + ro * ri + ri * ri))
    still = (ro - ri) * (ro + ri) / (2.0 * math.log(ro / ri))
    par[L.D_RINGS], par[L.D_FIRST] = float(n), float(L.D_BLOCKS)
    total = 0.0
    for k in range(n):
        ring = par[L.D_BLOCKS + k * L.N_PACK : L.D_BLOCKS + (k + 1) * L.N_PACK]
        copy(par, ring)
        a, b = ri + (ro - ri) * k / n, ri + (ro - ri) * (k + 1) / n
        ring[L.P_INNER_RADIUS], ring[L.P_OUTER_RADIUS] = a, b
        ring[L.P_FIDELITY] = float(L.FIELD)
        ring[L.P_EFFECTIVE_RADIUS] = scale * 2.0 * (b * b + a * b + a * a) / (3.0 * (a + b))
        derive_friction(ring)
        ring[L.D_VISCOUS] *= (b - a) * (b + a) * (b * b + a * a)
        ring[L.D_VISCOUS] /= (ro - ri) * (ro + ri) * (ro * ro + ri * ri)
        derive_heat(ring)
        par[np.uintp(L.D_SQUEEZE + k)] = _squeezed(a, b, still)
        total += par[np.uintp(L.D_SQUEEZE + k)]
    for k in range(n):
        par[np.uintp(L.D_SQUEEZE + k)] /= total


@kernel
def _squeezed(a: float, b: float, still: float) -> float:
    """Return the integral of (r^2 - still)^2/r from ``a`` to ``b``, by Gauss's rule."""
    total = 0.0
    for k in range(GAUSS_NODES.size):
        r = a + (b - a) * GAUSS_NODES[k]
        total += GAUSS_WEIGHTS[k] * (r * r - still) * (r * r - still) / r
    return (b - a) * total


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    derive_friction(par)
    derive_temperature_law(par)
    derive_film(par)
    derive_heat(par)
    derive_cooling(par)
    par[L.D_RINGS], par[L.D_FIRST], par[L.D_SQUEEZE] = 1.0, 0.0, 1.0
    if par[L.P_FIDELITY] == L.FINE:
        derive_rings(par, L.N_RINGS)
    return OK if are_finite(par[L.N_PARAM :]) else NOT_FINITE


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    if not par[L.P_INNER_RADIUS] < par[L.P_OUTER_RADIUS]:
        return 1
    if par[L.P_FRICTION_LAW] == L.TABLE_LAW:
        last = 0.0
        for k in range(L.N_TABLE):
            speed = par[np.uintp(L.P_TABLE_SPEED_1 + 2 * k)]
            if not speed > last:
                return 2 + k
            last = speed
    n, circle = par[L.P_GROOVE_COUNT], par[L.P_OUTER_RADIUS] + par[L.P_INNER_RADIUS]
    if n > 0.0 and not n * par[L.P_GROOVE_WIDTH] < math.pi * circle:
        return 2 + L.N_TABLE
    if par[L.P_FRICTION_TEMPERATURE] == L.POINTS_LAW:
        broken = _broken_points(par)
        return 2 + L.N_TABLE + broken if broken > 0 else 0
    return 0


@kernel
def _broken_points(par: Array) -> int:
    """Return the number, from 1, of the first rule that points over temperature break, or 0."""
    n, last, top = 0, L.NO_POINT, 0
    for k in range(L.N_POINTS):
        if par[np.uintp(L.P_POINT_FRICTION_1 + 2 * k)] > 0.0:
            n, top = n + 1, k + 1
    if n < top:
        return 2
    if n < 2:
        return 1
    for k in range(n):
        temperature = par[np.uintp(L.P_POINT_TEMPERATURE_1 + 2 * k)]
        if not temperature > last:
            return 3 + k
        last = temperature
    return 0
