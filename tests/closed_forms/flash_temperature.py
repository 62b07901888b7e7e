"""Heat of a sliding line contact: flash temperature of a deep body, shear of the oil film.

The film's formulas are those of Rashid & Seireg (1987) as Atan (2005) uses them, Eq 6 and 7.
"""

import math
from typing import NamedTuple

from closed_forms.involute_mesh import Mesh, flanks_at, line_load, pinion_radius, start_of_contact
from closed_forms.line_contact import full_width

# Blok's constant depends on how the heat is spread over the band: evenly, then the flank is hottest
# where it leaves; or as Hertz's pressure, then inside the band (the number: largest value of
# 2/pi^1.5 times the integral of sqrt(1 - u^2)/sqrt(s - u) over u from -1 to s).
EVEN, ELLIPTIC = math.sqrt(2.0 / math.pi), 0.7859834
ISO_GEOMETRY, ISO_ANGLE = 0.51, 1.22


class Body(NamedTuple):
    """What a flank is made of."""

    compliance: float  # [1/Pa] (1 - nu^2)/E
    conductivity: float  # [W/(m K)]
    density: float  # [kg/m3]
    heat_capacity: float  # [J/(kg K)]

    @property
    def effusivity(self) -> float:
        """B = sqrt(k rho c) [W s^1/2/(m2 K)]."""
        return math.sqrt(self.conductivity * self.density * self.heat_capacity)


def deep_body_rise(flux: float, time: float, effusivity: float) -> float:
    """Return the rise [K] of a deep body's surface after a constant flux [W/m2] for ``time`` [s].

    2 q sqrt(t)/sqrt(pi k rho c). Source: Atan 2005, Eq 2; Carslaw & Jaeger 1959.
    """
    return 2.0 * flux * math.sqrt(time / math.pi) / effusivity


def pinion_flash(
    mesh: Mesh, torque: float, speed: float, face_width: float, heat: float, steel: Body
) -> float:
    """Return the flash rise of the pinion's flank at the start of contact [K], step by step.

    ``heat`` is psi f A_0/A_c: share of the heat, coefficient of friction, area ratio. The load on
    the contact's full width b makes the flux heat (w/b) V_s; a point of the flank is in it for
    b/V_1. Source: Atan 2005, Eq 2 with Eq 9.
    """
    flanks = flanks_at(start_of_contact(mesh), mesh, speed)
    load = line_load(torque, mesh, face_width)
    width = full_width(load, flanks.radius, 2.0 * steel.compliance)
    flux = heat * load / width * abs(flanks.sliding)
    return deep_body_rise(flux, width / flanks.speed_pinion, steel.effusivity)


def atan_flash(
    mesh: Mesh, power: float, speed: float, face_width: float, heat: float, steel: Body
) -> float:
    """Return the same rise [K] as the product of four groups: Atan 2005, Eq 3.

    ``power`` [W] enters per face width [m]: as printed, without a width, the equation has the
    unit of a temperature only if its power is one per metre.
    """
    m, phi, x = mesh.ratio, mesh.pressure_angle, start_of_contact(mesh)
    material = 1.0 / ((2.0 * steel.compliance) ** 0.25 * steel.effusivity)
    up = (1.0 + m) ** 0.75 * abs(1.0 - (m + 1.0) * x) * math.sin(phi) ** 0.25
    geometry = up / (m * x**0.75 * (1.0 - x) ** 0.25 * math.cos(phi) ** 0.75)
    duty = (power / face_width) ** 0.75 / (speed**0.25 * math.sqrt(mesh.centre_distance))
    return float(math.pi**-0.25 * material * geometry * heat * duty)


def even_share(speed_pinion: float, speed_gear: float) -> float:
    """Return the share of the heat [-] that leaves both flanks, of one steel, equally hot."""
    first, second = math.sqrt(speed_pinion), math.sqrt(speed_gear)
    return first / (first + second)


def blok_flash(
    load: float, friction: float, speed_pinion: float, speed_gear: float, width: float,
    effusivity: float, profile: float = EVEN,
) -> float:  # fmt: skip
    """Return Blok's flash temperature [K], the heat divided so that both flanks are equally hot.

    ``load`` [N/m], speeds of the flanks [m/s], full ``width`` of the band [m], ``profile`` is
    EVEN or ELLIPTIC. K f w |V_1 - V_2|/(B (sqrt V_1 + sqrt V_2) sqrt(width/2)). Source: Blok 1937.
    """
    roots = abs(math.sqrt(speed_pinion) - math.sqrt(speed_gear))
    return profile * friction * load * roots / (effusivity * math.sqrt(0.5 * width))


def iso_flash(
    mesh: Mesh, torque: float, speed: float, face_width: float, friction: float, steel: Body
) -> float:
    """Return the flash temperature at the start of contact [K] in the standard's groups.

    mu X_M X_G w_t^(3/4) v_t^(1/2)/a^(1/4) with Gamma = x (1 + M) - 1 for the place on the line of
    action, X_M = (2/theta)^(1/4)/B, X_G = 0.51 X_ab sqrt(u + 1) |sqrt(1 + Gamma) -
    sqrt(1 - Gamma/u)|/((1 + Gamma)(u - Gamma))^(1/4) and X_ab = 1.22 sin^(1/4)/cos^(3/4): the
    scuffing calculation of ISO/TR 13989-1 (now ISO/TS 6336-20) for spur gears of one steel, whole
    load, no tip relief. Constants as they are usually quoted, not compared with the standard.
    """
    u, phi = mesh.ratio, mesh.pressure_angle
    gamma = start_of_contact(mesh) * (1.0 + u) - 1.0
    angle = ISO_ANGLE * math.sin(phi) ** 0.25 / math.cos(phi) ** 0.75
    roots = abs(math.sqrt(1.0 + gamma) - math.sqrt(1.0 - gamma / u))
    shape = math.sqrt(u + 1.0) * roots / ((1.0 + gamma) * (u - gamma)) ** 0.25
    material = (1.0 / steel.compliance) ** 0.25 / steel.effusivity
    unit_load = torque / (pinion_radius(mesh) * face_width)
    pitch_speed = speed * pinion_radius(mesh)
    duty = unit_load**0.75 * math.sqrt(pitch_speed) / mesh.centre_distance**0.25
    return float(friction * material * ISO_GEOMETRY * angle * shape * duty)


def sheared_heat(viscosity: float, sliding: float, width: float, film: float) -> float:
    """Return q = V_s b tau [W/m] with tau = mu V_s/h of a full width b [m] and film h [m]."""
    return viscosity * sliding**2 * width / film


def surface_rise(
    heat: float, speed: float, width: float, conductivity: float, density: float,
    heat_capacity: float,
) -> float:  # fmt: skip
    """Return the rise of the flank's surface above its bulk [K], Eq 7.

    ``heat`` [W/m] is the share that enters the flank, which moves at ``speed`` [m/s] through a
    band of full ``width`` [m].
    """
    peclet = density * heat_capacity * speed * width / conductivity
    return 1.03 * heat / (conductivity * math.sqrt(peclet))


def film_rise(
    heat: float, speed: float, width: float, film: float, conductivity: float,
    heat_content: float, oil_conductivity: float, oil_heat_content: float,
) -> float:  # fmt: skip
    """Return how much hotter the middle of the film is than the surface [K], Eq 6.

    Heat contents are density times heat capacity [J/(m3 K)]. As printed: the first group holds
    the steel's heat content, the exponential the oil's.
    """
    half = speed * film / (2.0 * oil_conductivity)
    powers = (heat_content * half) ** -0.013 * (2.0 * width / film) ** -1.003
    powers *= (conductivity / oil_conductivity) ** 0.013
    decay = math.exp(-9e-4 * oil_heat_content * half)
    return float(1.14 * heat / oil_conductivity * powers * decay)
