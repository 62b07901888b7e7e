"""Coefficients of friction of gear flanks."""

import math

# Outside this range of the effective roughness number a changes sign or b has no decay.
LEAST_ROUGHNESS, LARGEST_ROUGHNESS = 2.143e-5 / 2.873, 0.0864 / 1372.0


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
