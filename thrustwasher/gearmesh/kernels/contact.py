"""Line contact of two flanks: Hertz, oil film, friction, thermal stress and endurance."""

import math

from ...numerics.jit import kernel
from ...numerics.smoothing import smoothstep, soft_least, soft_most

BEND = 0.1  # of a bound: the width over which the friction bends into it
# Factor [1/Pa] and power of the pressure coefficient over the viscosity, both at 38 degC, of
# mineral oil, polyalphaolefin, ester, polyglycol.
ALPHA = ((2.657e-8, 0.1348), (1.466e-8, 0.0507), (1.466e-8, 0.0507), (1.392e-8, 0.1572))
REFERENCE = 311.0  # K, 38 degC, at which the pressure coefficient of the viscosity is given
FALL = 516.0  # K; alpha = alpha_38 (1 + 516 (1/T - 1/311)): ISO/TR 15144-1 as publicly quoted
LEAST_ALPHA = 0.01  # of alpha_38; the formula ends at some 780 K
LEAST_B, THINS = 1e-6, 50.0  # K, of the law of viscosity; real oils have 500 and more
BOUNDARY_SPEED = 1.0  # m/s at the pitch line; below, boundary friction limits the law of the loss


@kernel
def compliance(modulus: float, poisson: float, modulus_2: float, poisson_2: float) -> float:
    """Return theta = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [1/Pa] of two bodies."""
    return (1.0 - poisson * poisson) / modulus + (1.0 - poisson_2 * poisson_2) / modulus_2


@kernel
def hertz_width(line_load: float, radius: float, theta: float) -> float:
    """Return the full width b [m] of a line contact under ``line_load`` [N/m].

    b = sqrt(16 w R theta/pi), ``radius`` R [m] combined; mean pressure w/b, maximum 4/pi of it.
    """
    return math.sqrt(16.0 / math.pi * line_load * radius * theta)


@kernel
def surface_stress(line_load: float, radius: float, modulus: float) -> float:
    """Return sigma_m [Pa] = 0.591 sqrt(w E_eq/R), E_eq = E/2 for equal materials: Atan Eq 9.

    0.591 is the rounded factor of the maximum pressure for a Poisson ratio of 0.3 (0.59136).
    """
    return 0.591 * math.sqrt(line_load * 0.5 * modulus / radius)


@kernel
def film_thickness(
    viscosity: float,
    entrainment: float,
    line_load: float,
    radius: float,
    theta: float,
    pressure_viscosity: float,
) -> float:
    """Return the least film h [m] of Dowson & Higginson: 2.65 U^0.7 G^0.54 W^-0.13 R.

    ``entrainment`` (V1 + V2)/2 [m/s], ``viscosity`` [Pa s], E' = 2/theta, U = mu V/(E' R),
    G = alpha_p E', W = w/(E' R). All arguments are above 0.
    """
    stiff = 2.0 / theta
    u = viscosity * entrainment / (stiff * radius)
    g = pressure_viscosity * stiff
    w = line_load / (stiff * radius)
    return 2.65 * radius * math.exp(0.7 * math.log(u) + 0.54 * math.log(g) - 0.13 * math.log(w))


@kernel
def alpha_of_oil(base: int, viscosity: float) -> float:
    """Return the pressure coefficient of the viscosity at 38 degC [1/Pa] by the base of the oil.

    ``base``: place in ``ALPHA``; ``viscosity`` [Pa s] at 38 degC, ambient pressure. Source:
    approximations of ISO/TR 15144-1 as publicly quoted, the same as those of AGMA 925-A03 in other
    units; an ester, which neither has, counts as polyalphaolefin.
    """
    factor, power = ALPHA[base]
    return factor * math.exp(power * math.log(viscosity))


@kernel
def pressure_coefficient(temperature: float) -> tuple[float, float]:
    """Return the pressure coefficient over that at 38 degC [-], its relative slope [1/K]."""
    found = 1.0 + FALL * (1.0 / temperature - 1.0 / REFERENCE)
    if found <= LEAST_ALPHA:
        return LEAST_ALPHA, 0.0
    return found, -FALL / (temperature * temperature * found)


@kernel
def coefficient_at(viscosity: float, scale: float, b: float, c: float) -> tuple[float, float]:
    """Return ``pressure_coefficient`` where the oil is as viscous [Pa s], and its log slope.

    ``scale`` [Pa s], ``b``, ``c`` [K]: the law of the viscosity, which tells the temperature. An
    oil that does not thin as it warms up, ``b`` 0, keeps its coefficient; up to THINS that fades.
    The slope is that over the logarithm of the viscosity.
    """
    if b < LEAST_B:
        return 1.0, 0.0
    warmth, thins = b / math.log(viscosity / scale), smoothstep(b / THINS)
    found, slope = pressure_coefficient(warmth - c + 273.15)
    taken = 1.0 + thins * (found - 1.0)
    return taken, -thins * found / taken * slope * warmth * warmth / b


@kernel
def li_seireg(film: float, radius: float, f0: float, roughness: float) -> tuple[float, float]:
    """Return the coefficient of friction [-] of Li & Seireg (Atan Eq 4); slope over ln(film).

    symbol     meaning                                              unit
    film       film thickness h                                     m
    radius     combined radius of curvature R_c                     m
    f0         coefficient without a film                           -
    roughness  effective roughness parameter S, 7.459e-6..6.297e-5  -

    f = f0 - a (1 - exp(-(h/R_c)/(2.873 S - 2.143e-5))), a = 0.0864 - 1372 S; between f0 (h = 0)
    and f0 - a. Holds for a slide/roll ratio above 0.27.
    """
    depth = min(film / radius / (2.873 * roughness - 2.143e-5), 700.0)
    thin, most = math.exp(-depth), 0.0864 - 1372.0 * roughness
    return f0 - most * (1.0 - thin), -most * thin * depth


@kernel
def common_law(
    line_load: float, rolling: float, radius: float, viscosity: float, roughness: float
) -> float:
    """Return (w/(v R))^0.2 eta^-0.05 Ra^0.25 in N/mm, m/s, mm, mPa s, um.

    Here ``line_load`` [N/m], ``rolling`` sum of the speeds at the pitch point [m/s], ``radius``
    there [m], ``viscosity`` at the oil's temperature [Pa s], ``roughness`` Ra [m].
    """
    load = 1e-6 * line_load / (rolling * radius)
    return math.exp(
        0.2 * math.log(load) - 0.05 * math.log(1e3 * viscosity) + 0.25 * math.log(1e6 * roughness)
    )


@kernel
def iso_and_slope(law: float, lubricant: float, f0: float) -> tuple[float, float]:
    """Return the mean coefficient of friction [-] against scuffing, and no more than ``f0``.

    The second number is its slope over the logarithm of ``law``, as ``common_law`` returns it with
    the force F_t at the pitch circle per width. ``lubricant``: X_L of the base oil.

    Source: ISO/TR 13989-1 and ISO/TS 6336-20 as publicly quoted, 0.06 X_L law. The bound is chosen
    here: towards standstill the formula grows without limit.
    """
    mu = 0.06 * lubricant * law
    if f0 <= 0.0:
        return 0.0, 0.0
    bounded, slope = soft_least(mu, f0, BEND * f0)
    return bounded, slope * mu


@kernel
def schlenk_and_slopes(
    law: float, rolling: float, slow: float, lubricant: float, boundary: float
) -> tuple[float, float, float]:
    """Return the mean coefficient of friction [-] that the loss feels.

    The other two numbers are its slopes over the logarithm of ``law`` at a speed that is held, and
    over that part of it which the speed makes.

    symbol     meaning                                                           unit
    law        ``common_law`` with the force F_bt on the base circle per width   -
    rolling    sum of the speeds at the pitch point                              m/s
    slow       the same at a pitch-line speed of 1 m/s                           m/s
    lubricant  X_L of the base oil                                               -
    boundary   boundary friction                                                 -

    Source: Schlenk (1995) as publicly quoted, 0.048 X_L law. Below a pitch-line speed of 1 m/s it
    grows to the boundary friction at most, where it has not been above that before; that bound is
    chosen here.
    """
    mu = 0.048 * lubricant * law
    at_slow = mu * math.exp(0.2 * math.log(rolling / slow))
    bound, by_slow = soft_most(at_slow, boundary, BEND * boundary)
    found, by_law = soft_least(mu, bound, BEND * bound)
    by_bound = (found - by_law * mu) / bound * by_slow * at_slow
    return found, by_law * mu + by_bound, by_law * mu


@kernel
def thermal_stress(rise: float, modulus: float, poisson: float, expansion: float) -> float:
    """Return sigma_t [Pa] = E alpha dT/(3 (1 - nu)) of a rise [K]: Atan Eq 8."""
    return modulus * expansion * rise / (3.0 * (1.0 - poisson))


@kernel
def modification(
    thermal: float, mechanical: float, thermal_limit: float, mechanical_limit: float
) -> tuple[float, float]:
    """Return (K, 1/sqrt(1 + K)) [-]: Atan Eq 11, K = (K_m sigma_t/(K_t sigma_m))^2.

    The limits are K_t and K_m, endurance limits over ultimate strength.
    """
    root = mechanical_limit * thermal / (thermal_limit * mechanical)
    return root * root, 1.0 / math.sqrt(1.0 + root * root)


@kernel
def utilization(
    thermal: float,
    mechanical: float,
    thermal_limit: float,
    mechanical_limit: float,
    ultimate: float,
) -> float:
    """Return the root of the right side of Atan Eq 10 [-]: at 1 the endurance limit is used up."""
    m = mechanical / (mechanical_limit * ultimate)
    t = thermal / (thermal_limit * ultimate)
    return math.sqrt(m * m + t * t)
