"""How large the torque of a rolling bearing, of a gear that dips and of a shaft seal is.

SI units; a law gives the size of a torque [N m] that turns against the motion, and its slopes. The
speed is above 0, but where a gear is classed.
"""

import math

from ...numerics.jit import kernel
from ...numerics.smoothing import smoothstep, smoothstep_slope, soft_least, soft_most

# M0 = 1e-7 f0 (nu n)^(2/3) dm^3 N mm, nu in mm2/s, n in 1/min, dm in mm, nu n at least 2000.
BEARING, NU_N, LEAST_NU_N, ROUNDED = 0.1, 1e6 * 30.0 / math.pi, 2000.0, 500.0
# Over it, of the viscous part: 1/(1 + 1.84e-9 (n dm)^1.28 nu^0.64), the same units.
HEATED, HEATED_SPEED, HEATED_NU = 1.84e-9, 1.28, 0.64
GRAVITY = 9.80665
# C_m = larger of (viscous Re^-0.21, inertial) (h/D)^a (V0/D^3)^b Fr^c (b/D)^d; two sets, below and
# above a range of the centrifugal acceleration w^2 (b R^2)^(1/3) [m/s2].
SLOW = (1.366, 0.239, 0.45, 0.1, -0.6, 0.21)
FAST = (20.797, 3.644, 0.1, -0.35, -0.88, 0.85)
THICK, ROUNDED_RE = 0.21, 0.1  # power of Re; of ln Re, where the two lines of a set meet
CRITICAL_RE, GAMMA, GAMMA_WIDTH = 4000.0, 750.0, 500.0
NONE, VISCOUS, INERTIAL, BETWEEN, CENTRIFUGAL_VISCOUS, CENTRIFUGAL_INERTIAL = range(1, 7)
# Range of the laws of churning; estimates, see docs/theory/losses.md.
LEAST_FR, MOST_FR, LEAST_RE, MOST_RE = 10.0, 5000.0, 300.0, 2e5
TEETH = 2.0 * 2.25 / (math.pi * math.cos(math.radians(20.0)))  # their flanks over the cylinder
# P = (145 - 1.6 T + 350 lg lg(nu40 + 0.8)) 1e-7 d^2 n W, T in degC, nu40 in mm2/s, d in mm.
SEAL, LEAST_SEAL, SEAL_ROUNDED = 30.0 / math.pi * 0.1, 20.0, 10.0


@kernel
def starved(factor: float, kind: float, diameter: float, section: float) -> float:
    """Return what nu n [mm2/s, 1/min] is multiplied by in the exponent of starvation.

    ``factor``: K_rs; ``kind``: K_Z; mean ``diameter`` [m]; ``section``: (D - d) over it. Source:
    SKF: exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), lengths in mm.
    """
    return factor * math.sqrt(2e3 * kind * diameter / section)


@kernel
def thinned(
    speed: float, nu: float, diameter: float, starving: float
) -> tuple[float, float, float]:
    """Return by what the viscous torque of a rolling bearing is less in thick oil, or fast.

    And its slopes, relative, over ln speed and ln nu. Oil before the contacts is sheared and warm,
    and in the tracks it has no time to come back. ``starving``: of ``starved``. Source: SKF's
    factors of inlet shear heating and of kinematic replenishment, as publicly quoted.
    """
    n = 30.0 / math.pi * speed
    heat = HEATED * (1e3 * n * diameter) ** HEATED_SPEED * (1e6 * nu) ** HEATED_NU
    short = starving * NU_N * nu * speed
    share = heat / (1.0 + heat)
    by_speed, by_nu = -HEATED_SPEED * share - short, -HEATED_NU * share - short
    return math.exp(-short) / (1.0 + heat), by_speed, by_nu


@kernel
def bearing_drag(
    speed: float,
    nu: float,
    load: float,
    diameter: float,
    f0: float,
    f1: float,
    starving: float,
) -> tuple[float, float, float]:
    """Return the torque of a rolling bearing, its slopes over speed [N m s] and nu [N m s/m2].

    ``nu`` kinematic viscosity [m2/s], ``load`` [N], mean ``diameter`` [m], ``starving``: of
    ``starved``. Source: Palmgren 1959 (Harris 2001, ch. 14): M1 = f1 P dm and M0; its corner
    rounded; M0 less by ``thinned``.
    """
    x, inner = soft_most(NU_N * nu * speed, LEAST_NU_N, ROUNDED)
    less, by_speed, by_nu = thinned(speed, nu, diameter, starving)
    viscous = less * BEARING * f0 * diameter**3 * x ** (2.0 / 3.0)
    grows = 2.0 / 3.0 * inner * NU_N * nu * speed / x
    slopes = viscous * (grows + by_speed) / speed, viscous * (grows + by_nu) / nu
    return viscous + f1 * load * diameter, slopes[0], slopes[1]


@kernel
def churning_constants(
    diameter: float, width: float, depth: float, volume: float, density: float
) -> tuple[float, float]:
    """Return torque over speed^(2 + 2 c) and over the part of Re in C_m, of the two sets.

    ``depth``: immersion over ``diameter``; ``volume`` of oil [m3]. The wetted surface is that of
    both faces, the cylinder and the flanks. Source: Changenet, Leprince, Ville & Velex 2011, as
    publicly quoted; the width stands over the diameter, as in Changenet & Velex 2007.
    """
    if depth <= 0.0:
        return 0.0, 0.0
    radius, angle = 0.5 * diameter, math.acos(1.0 - 2.0 * depth)
    faces = radius * radius * (2.0 * angle - math.sin(2.0 * angle))
    wetted = faces + (1.0 + TEETH) * diameter * width * angle
    size = 0.5 * density * radius**3 * wetted
    oil, slim, heavy = volume / diameter**3, width / diameter, radius / GRAVITY
    _, _, a, b, c, d = SLOW
    slow = size * depth**a * oil**b * heavy**c * slim**d
    _, _, a, b, c, d = FAST
    return slow, size * depth**a * oil**b * heavy**c * slim**d


@kernel
def set_drag(
    speed: float, reynolds: float, size: float, viscous: float, inertial: float, power: float
) -> tuple[float, float, float]:
    """Return the torque by one of the sets, its slopes over ln speed and ln nu.

    ``size``: of ``churning_constants``; ``power`` c of Fr.
    """
    meet = math.log(viscous / inertial) / THICK
    thick, slope = soft_least(math.log(reynolds), meet, ROUNDED_RE)
    torque = size * viscous * math.exp(-THICK * thick) * speed ** (2.0 + 2.0 * power)
    by_nu = THICK * slope * torque
    return torque, (2.0 + 2.0 * power) * torque - by_nu, by_nu


@kernel
def churning_drag(
    speed: float, nu: float, slow: float, fast: float, area: float, cube: float
) -> tuple[float, float, float]:
    """Return the torque of a dipping gear, its slopes over speed [N m s] and nu [N m s/m2].

    ``slow``, ``fast``: of ``churning_constants``; ``area``: radius times width [m2]; ``cube``: cube
    root of width times radius squared [m]. From one set to the other between 750 and 1250 m/s2 of
    centrifugal acceleration, smoothly; within a set the lines meet near Re = 4000.
    """
    reynolds, gamma = speed * area / nu, speed * speed * cube
    z = (gamma - GAMMA) / GAMMA_WIDTH
    share = smoothstep(z)
    calm, calm_speed, calm_nu = set_drag(speed, reynolds, slow, SLOW[0], SLOW[1], SLOW[4])
    wild, wild_speed, wild_nu = set_drag(speed, reynolds, fast, FAST[0], FAST[1], FAST[4])
    turn = (wild - calm) * smoothstep_slope(z) * 2.0 * gamma / GAMMA_WIDTH
    by_speed = (1.0 - share) * calm_speed + share * wild_speed + turn
    by_nu = (1.0 - share) * calm_nu + share * wild_nu
    return (1.0 - share) * calm + share * wild, by_speed / speed, by_nu / nu


@kernel
def churning_regime(speed: float, nu: float, depth: float, area: float, cube: float) -> int:
    """Return which of the sets counts for a gear, NONE at rest or where ``depth`` is 0."""
    if depth <= 0.0 or speed == 0.0:
        return NONE
    thin, gamma = abs(speed) * area / nu >= CRITICAL_RE, speed * speed * cube
    if gamma < GAMMA:
        return INERTIAL if thin else VISCOUS
    if gamma <= GAMMA + GAMMA_WIDTH:
        return BETWEEN
    return CENTRIFUGAL_INERTIAL if thin else CENTRIFUGAL_VISCOUS


@kernel
def churning_is_outside(speed: float, nu: float, depth: float, radius: float, area: float) -> bool:
    """Tell if a gear churns outside the range of the laws; slower than it, it hardly does."""
    froude, reynolds = speed * speed * radius / GRAVITY, abs(speed) * area / nu
    if depth <= 0.0 or froude < LEAST_FR:
        return False
    return froude > MOST_FR or reynolds < LEAST_RE or reynolds > MOST_RE


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
