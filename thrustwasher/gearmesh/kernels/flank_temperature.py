"""Temperature rises at a sliding line contact: friction on the flank, shear of the oil film."""

import math

from ...numerics.jit import kernel
from ...numerics.smoothing import soft_least

ELLIPTIC = 0.7859834  # Blok's factor for heat spread as Hertz's pressure
LOWEST_OIL = 233.15  # K; the viscosity law counts colder oil as this
MAX_ITERATIONS = 100


@kernel
def oil_viscosity(temperature: float, scale: float, b: float, c: float) -> float:
    """Return the viscosity [Pa s] = scale exp(b/(T + c)), T in degC: Atan Eq 13.

    ``temperature`` [K]; Atan prints a scale of 0.97, which is 0.97e-3 g/(cm s) = 9.7e-5 Pa s.
    """
    return scale * math.exp(b / (max(temperature, LOWEST_OIL) - 273.15 + c))


@kernel
def flash_rise(heat: float, width: float, speed: float, effusivity: float) -> float:
    """Return the rise [K] of a flank that takes up ``heat`` [W/m] on its way through the contact.

    dT = 2 q'' sqrt(t)/(sqrt(pi) B), q'' = heat/width, t = width/speed, B = sqrt(k rho c)
    [W s^0.5/(m2 K)]. Atan Eq 2; with Hertz's width and the involute's speeds it is his Eq 3.
    """
    return 2.0 * heat / (math.sqrt(math.pi * width * speed) * effusivity)


@kernel
def blok_rise(
    friction: float,
    line_load: float,
    v1: float,
    v2: float,
    width: float,
    effusivity: float,
    effusivity_2: float,
) -> float:
    """Return Blok's flash temperature [K]: both flanks equally hot, elliptic heat.

    0.786 f w |V1 - V2|/((B1 sqrt V1 + B2 sqrt V2) sqrt(b/2)), ``width`` b [m] in full.
    """
    takes = effusivity * math.sqrt(v1) + effusivity_2 * math.sqrt(v2)
    return ELLIPTIC * friction * line_load * abs(v1 - v2) / (takes * math.sqrt(0.5 * width))


@kernel
def surface_factor(width: float, speed: float, conductivity: float, capacity: float) -> float:
    """Return the rise of the surface per heat of the film [K m/W]: Atan Eq 7.

    (1.03/k_1) (rho_1 c_1 V_1 b/k_1)^(-1/2), ``capacity`` rho_1 c_1 [J/(m3 K)].
    """
    return 1.03 / (conductivity * math.sqrt(capacity * speed * width / conductivity))


@kernel
def film_factor(
    film: float,
    width: float,
    speed: float,
    conductivity: float,
    capacity: float,
    oil_conductivity: float,
    oil_capacity: float,
) -> float:
    """Return the rise of the film above the surface per heat of the film [K m/W]: Atan Eq 6.

    As printed the first group holds the solid's ``capacity`` and the exponential the oil's, both
    rho c [J/(m3 K)].
    """
    half = 0.5 * speed * film / oil_conductivity
    power = (
        -0.013 * math.log(capacity * half)
        - 1.003 * math.log(2.0 * width / film)
        + 0.013 * math.log(conductivity / oil_conductivity)
        - 9e-4 * oil_capacity * half
    )
    return 1.14 / oil_conductivity * math.exp(max(power, -700.0))


@kernel
def shear_stress(shear: float, cap: float) -> tuple[float, float]:
    """Return the stress [Pa] in the film, ``shear`` but no more than ``cap``, and its log slope."""
    stress, slope = soft_least(shear, cap, 0.1 * cap)
    return stress, slope * shear / stress


@kernel
def heated_flank(
    bulk: float, factor: float, shear: float, cap: float, exponent: float, b: float, c: float
) -> tuple[float, float, float, int, int]:
    """Return T [K] of the flank heated by oil of viscosity mu(T), and the stress in the oil [Pa].

    With them the log slope of the stress over the uncapped one, status and iterations.

    T = bulk + factor x stress, ``factor`` [K/Pa]; ``shear`` [Pa] is the stress at the viscosity of
    the bulk, elsewhere shear (mu(T)/mu(bulk))^exponent (0.3 if the film thins with T, 1 if not).
    The right side falls with T: there is exactly one root, between the bulk and the rise without
    thinning. Newton's method inside that bracket finds it, with a bisection wherever it fails to
    halve its step; substitution may swing for ever.
    """
    cold = max(bulk, LOWEST_OIL) - 273.15 + c
    stress, slope = shear_stress(shear, cap)
    low, high = 0.0, factor * stress
    rise, last = 0.0, 2.0 * high
    for n in range(MAX_ITERATIONS):
        warm = cold + rise
        stress, slope = shear_stress(
            shear * math.exp(max(exponent * b * (1.0 / warm - 1.0 / cold), -700.0)), cap
        )
        gap = rise - factor * stress
        if gap > 0.0:
            high = rise
        else:
            low = rise
        step = -gap / (1.0 + factor * stress * slope * exponent * b / (warm * warm))
        if min(abs(step), high - low) <= 1e-13 * (bulk + rise):
            return bulk + min(max(rise + step, low), high), stress, slope, 0, n + 1
        if not low <= rise + step <= high or abs(step) > 0.5 * last:
            step = 0.5 * (low + high) - rise
        rise += step
        last = abs(step)
    return bulk + rise, stress, slope, 10, MAX_ITERATIONS
