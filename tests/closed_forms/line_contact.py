"""Two long cylinders pressed together: Hertz's contact, its oil film, friction of gear flanks."""

import math


def compliance(youngs_modulus: float, poisson_ratio: float) -> float:
    """Return (1 - nu^2)/E [1/Pa] of one body; the contact takes the sum of both."""
    return (1.0 - poisson_ratio**2) / youngs_modulus


def full_width(load: float, radius: float, theta: float) -> float:
    """Return the full width of contact [m] for a load per length [N/m].

    ``radius`` [m] is the equivalent one, ``theta`` [1/Pa] the sum of the compliances. An elliptic
    pressure p on |x| < a dents two half spaces by slopes that sum to -2 theta p0 x/a, which has
    to be the slope -x/R of the undeformed gap; with p0 = 2 w/(pi a): a^2 = 4 w R theta/pi.
    """
    return math.sqrt(16.0 * load * radius * theta / math.pi)


def peak_pressure(load: float, radius: float, theta: float) -> float:
    """Return the largest pressure [Pa], 4/pi of the mean w/(2a)."""
    return 4.0 / math.pi * load / full_width(load, radius, theta)


def dowson_higginson(
    load: float,
    radius: float,
    theta: float,
    viscosity: float,
    entrainment: float,
    pressure_viscosity: float,
) -> float:
    """Return the minimum film thickness [m] of an elastohydrodynamic line contact.

    ``entrainment`` [m/s] is the mean of the two surface speeds, ``pressure_viscosity`` in 1/Pa,
    E' = 2/theta. h = 2.65 U^0.7 G^0.54 W^-0.13 R. Source: Dowson & Higginson 1977.
    """
    modulus = 2.0 / theta
    u = viscosity * entrainment / (modulus * radius)
    g = pressure_viscosity * modulus
    w = load / (modulus * radius)
    return float(2.65 * u**0.7 * g**0.54 * w**-0.13 * radius)


def vogel_viscosity(temperature: float, scale: float, slope: float, shift: float) -> float:
    """Return scale exp(slope/(T + shift)) [Pa s], the temperature T in degC."""
    return scale * math.exp(slope / (temperature + shift))


def li_seireg(film_number: float, roughness_number: float, dry: float) -> float:
    """Return f = f_0 - a (1 - exp(b)) [-] for film and effective roughness over the radius.

    a = 0.0864 - 1372 S, b = -(h/R)/(2.873 S - 2.143e-5). Holds where sliding exceeds 0.27 of
    rolling. Source: Li & Seireg 1989, quoted by Atan 2005, Eq 4.
    """
    fall = 0.0864 - 1372.0 * roughness_number
    exponent = -film_number / (2.873 * roughness_number - 2.143e-5)
    return dry - fall * (1.0 - math.exp(exponent))


def iso_mean(
    load: float, rolling: float, radius: float, viscosity: float, roughness: float
) -> float:
    """Return the mean coefficient of a mesh [-], arguments in SI, all at the pitch point.

    0.06 (w/(v R))^0.2 eta^-0.05 Ra^0.25 with w in N/mm, the sum v of the surface speeds in m/s, R
    in mm, eta in mPa s, Ra in um. Source: ISO/TS 6336-20 (before: ISO/TR 13989-1), mineral oil,
    as it is usually quoted.
    """
    group = (1e-3 * load) / (rolling * 1e3 * radius)
    return float(0.06 * group**0.2 * (1e3 * viscosity) ** -0.05 * (1e6 * roughness) ** 0.25)
