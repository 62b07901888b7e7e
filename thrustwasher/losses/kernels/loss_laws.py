"""How large the torque of a rolling bearing, of a gear that dips and of a shaft seal is.

SI units; a law gives the size of a torque [N m] that turns against the motion, and its slopes. The
speed is above 0.
"""

import math

from ...numerics.jit import kernel
from ...numerics.smoothing import smoothstep, smoothstep_slope, soft_most

# M0 = 1e-7 f0 (nu n)^(2/3) dm^3 N mm, nu in mm2/s, n in 1/min, dm in mm, nu n at least 2000.
BEARING, NU_N, LEAST_NU_N, ROUNDED = 0.1, 1e6 * 30.0 / math.pi, 2000.0, 500.0
GRAVITY = 9.80665
# C_m = factor (h/D)^a (V0/D^3)^b Fr^c (b/D)^d, times Re^e, below and above the critical Re.
SLOW = (1.366, 0.45, 0.1, -0.6, 0.21, -0.21)
FAST = (3.644, 0.1, -0.35, -0.88, 0.85, 0.0)
CRITICAL, CRITICAL_WIDTH = 6000.0, 3000.0
TEETH = 2.0 * 2.25 / (math.pi * math.cos(math.radians(20.0)))  # their flanks over the cylinder
# P = (145 - 1.6 T + 350 lg lg(nu40 + 0.8)) 1e-7 d^2 n W, T in degC, nu40 in mm2/s, d in mm.
SEAL, LEAST_SEAL, SEAL_ROUNDED = 30.0 / math.pi * 0.1, 20.0, 10.0


@kernel
def bearing_drag(
    speed: float, nu: float, load: float, diameter: float, f0: float, f1: float
) -> tuple[float, float, float]:
    """Return the torque of a rolling bearing, its slopes over speed [N m s] and nu [N m s/m2].

    ``nu`` kinematic viscosity [m2/s], ``load`` [N], mean ``diameter`` [m].
    Source: Palmgren 1959 (Harris 2001, ch. 14): M1 = f1 P dm and M0; its corner rounded.
    """
    x, inner = soft_most(NU_N * nu * speed, LEAST_NU_N, ROUNDED)
    size = BEARING * f0 * diameter**3
    slope = size * 2.0 / 3.0 * x ** (-1.0 / 3.0) * inner * NU_N
    return size * x ** (2.0 / 3.0) + f1 * load * diameter, slope * nu, slope * speed


@kernel
def churning_constants(
    diameter: float, width: float, depth: float, volume: float, density: float
) -> tuple[float, float]:
    """Return torque over speed^0.59 nu^0.21, and over speed^0.24, of the two regimes.

    ``depth``: immersion over ``diameter``; ``volume`` of oil [m3]. The wetted surface is that of
    both faces, the cylinder and the flanks. Source: Changenet & Velex 2007, as publicly quoted.
    """
    if depth <= 0.0:
        return 0.0, 0.0
    radius, angle = 0.5 * diameter, math.acos(1.0 - 2.0 * depth)
    faces = radius * radius * (2.0 * angle - math.sin(2.0 * angle))
    wetted = faces + (1.0 + TEETH) * diameter * width * angle
    size = 0.5 * density * radius**3 * wetted
    factor, a, b, c, d, e = SLOW
    oil, slim = volume / diameter**3, width / diameter
    slow = factor * depth**a * oil**b * (radius / GRAVITY) ** c * slim**d * (radius * width) ** e
    factor, a, b, c, d, e = FAST
    fast = factor * depth**a * oil**b * (radius / GRAVITY) ** c * slim**d
    return size * slow, size * fast


@kernel
def churning_drag(
    speed: float, nu: float, slow: float, fast: float, area: float
) -> tuple[float, float, float]:
    """Return the torque of a dipping gear, its slopes over speed [N m s] and nu [N m s/m2].

    ``slow``, ``fast``: of ``churning_constants``; ``area``: radius times width [m2]. From one
    regime to the other between Re = 6000 and 9000, smoothly.
    """
    reynolds = speed * area / nu
    z = (reynolds - CRITICAL) / CRITICAL_WIDTH
    share = smoothstep(z)
    calm = slow * speed ** (2.0 + 2.0 * SLOW[3] + SLOW[5]) * nu ** -SLOW[5]
    wild = fast * speed ** (2.0 + 2.0 * FAST[3])
    turn = (wild - calm) * smoothstep_slope(z) * reynolds / CRITICAL_WIDTH
    by_speed = (1.0 - share) * (2.0 + 2.0 * SLOW[3] + SLOW[5]) * calm
    by_speed += share * (2.0 + 2.0 * FAST[3]) * wild + turn
    by_nu = (1.0 - share) * -SLOW[5] * calm - turn
    return (1.0 - share) * calm + share * wild, by_speed / speed, by_nu / nu


@kernel
def seal_drag(oil: float, nu_40: float, diameter: float) -> tuple[float, float]:
    """Return the torque of a rotary lip seal and its slope over ``oil`` temperature [K].

    ``nu_40``: kinematic viscosity at 40 degC [m2/s]. Source: Simrit's formula in ISO/TR 14179-2,
    as publicly quoted. Its bracket counts at least 20, reached at about 120 degC.
    """
    thick = math.log10(math.log10(max(1e6 * nu_40, 0.5) + 0.8))
    bracket, inner = soft_most(
        145.0 - 1.6 * (oil - 273.15) + 350.0 * thick, LEAST_SEAL, SEAL_ROUNDED
    )
    size = SEAL * diameter * diameter
    return size * bracket, -1.6 * size * inner
