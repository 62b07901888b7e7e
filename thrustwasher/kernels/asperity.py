"""Contact force of one elasto-plastic asperity against a rigid flat."""

import math
from typing import NamedTuple

from ._jit import kernel

YIELD_END = 1.9  # w_t*: up to here the asperity counts as elastic


class AsperityArgs(NamedTuple):
    """What one asperity needs: see `asperity_args`."""

    critical_interference: float  # w_c [m]
    critical_force: float  # P_c [N]
    c: float  # C of Eq 12 [-]
    yield_strain: float  # e_y [-]
    b: float  # B of the nomenclature [-]


@kernel
def asperity_args(
    youngs_modulus: float, poisson_ratio: float, yield_strength: float, by_contact: bool,
    radius: float,
) -> AsperityArgs:  # fmt: skip
    """Return the constants of one asperity; ``by_contact``: e_y = S_y/E' instead of S_y/E.

    Source: Jackson & Green Eq 11 (with E' in place of the printed E, or P_c = (4/3) E' sqrt(R)
    w_c^1.5 would not hold), Eq 12; E' = E/(2 (1 - nu^2)): two equal bodies.
    """
    contact_modulus = youngs_modulus / (2.0 * (1.0 - poisson_ratio**2))
    c = 1.295 * math.exp(0.736 * poisson_ratio)
    w_c = (math.pi * c * yield_strength / (2.0 * contact_modulus)) ** 2 * radius
    p_c = 4.0 / 3.0 * contact_modulus * math.sqrt(radius) * w_c * math.sqrt(w_c)
    e_y = yield_strength / (contact_modulus if by_contact else youngs_modulus)
    return AsperityArgs(w_c, p_c, c, e_y, 0.14 * math.exp(min(23.0 * e_y, 200.0)))


@kernel
def asperity_force(w: float, a: AsperityArgs) -> float:
    """Return the force [N] of one asperity pressed in by ``w`` >= 0 [m].

    Source: Jackson & Green Eq 8-10. The fit jumps by 0.558 % at w* = 1.9; kept as published.
    """
    if w <= 0.0:
        return 0.0
    x = w / a.critical_interference
    if x <= YIELD_END:
        return a.critical_force * x * math.sqrt(x)
    log_x = math.log(x)
    contact_strain = (
        0.5 * math.pi * a.c * a.yield_strain
        * math.exp(min(0.5 * log_x + 0.5 * a.b * (log_x - math.log(YIELD_END)), 300.0))
    )  # fmt: skip
    hardness = 2.84 * (1.0 - math.exp(-0.82 * contact_strain**-0.7))  # H/S_y
    elastic = math.exp(-0.25 * math.exp(5.0 / 12.0 * log_x)) * x * math.sqrt(x)
    plastic = 4.0 * hardness / a.c * -math.expm1(-0.04 * math.exp(5.0 / 9.0 * log_x)) * x
    return a.critical_force * (elastic + plastic)
