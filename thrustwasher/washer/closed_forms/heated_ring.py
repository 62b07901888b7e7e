"""Thin annuli that are heated: unevenly around the circumference, or in a stack of three."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


def annulus_rise(
    radius: NDArray[np.float64], heat: float, harmonic: int, conductivity: float, thickness: float,
    inner_radius: float, outer_radius: float,
) -> NDArray[np.float64]:  # fmt: skip
    """Return the amplitude [K] over ``radius`` [m] of T = amplitude cos(n theta).

    K t lap T - (K/t) T + q_0 (r/r_o)^n cos(n theta) = 0 with no flux through either rim: heat
    ``heat`` = q_0 [W/m2] on one face, the other face held at zero. Since lap(r^n cos n theta) = 0,
    T = c r^n + a I_n(r/t) + b K_n(r/t), c = q_0 t/(K r_o^n).
    """
    from scipy.special import iv, ivp, kv, kvp  # late: a shift takes another form from here

    n, t = harmonic, thickness
    c = heat * t / (conductivity * outer_radius**n)
    rims = np.array([inner_radius, outer_radius])
    slopes = np.column_stack((ivp(n, rims / t) / t, kvp(n, rims / t) / t))
    a, b = np.linalg.solve(slopes, -c * n * rims ** (n - 1))
    return np.asarray(c * radius**n + a * iv(n, radius / t) + b * kv(n, radius / t))


class StackRise(NamedTuple):
    """Temperature rises [K] above the oil."""

    carrier: float
    washer: float
    gear: float


def stack_rise(
    heat: float, share: float, between_carrier_washer: float, between_washer_gear: float,
    behind_carrier: float, behind_gear: float,
) -> StackRise:  # fmt: skip
    """Return the rises for a heat flow [W/m2] made between carrier and washer.

    ``share`` of it enters the carrier, the rest the washer; resistances in m2 K/W. The heat that
    leaves through the carrier follows from the two parallel ways out.
    """
    by_gear = between_washer_gear + behind_gear
    loop = behind_carrier + between_carrier_washer + by_gear
    out_carrier = heat * (by_gear + share * between_carrier_washer) / loop
    out_gear = heat - out_carrier
    return StackRise(out_carrier * behind_carrier, out_gear * by_gear, out_gear * behind_gear)


def stack_times(
    conductances: tuple[float, float], storages: tuple[float, float, float],
    between_carrier_washer: float, between_washer_gear: float,
    terms: Sequence[tuple[float, float]] = ((1.0, 1.0),),
) -> list[float]:  # fmt: skip
    """Return the times [s], shortest first, in which the stack's temperatures settle.

    Carrier, washer and gear store ``storages`` [J/(m2 K)]; carrier and gear lose heat through
    ``conductances`` [W/(m2 K)], the bodies exchange it through the two resistances. The face of
    carrier and gear follows a flux as the sum of ``terms``: shares of the resistance, and times in
    storage over conductance. Along the faces nothing flows, as when all is even.
    """
    n = len(terms)
    washer = 2 * n
    rates = np.zeros((2 * n + 1, 2 * n + 1))
    across = between_carrier_washer, between_washer_gear
    for body, out, stored in zip(range(2), conductances, storages[::2], strict=True):
        faces = slice(body * n, body * n + n)
        flux = np.zeros(2 * n + 1)  # into the body
        flux[washer], flux[faces] = 1.0 / across[body], -1.0 / across[body]
        for k, (share, time) in enumerate(terms, faces.start):
            rates[k] = share / (time * stored) * flux
            rates[k, k] -= out / (time * stored)
        rates[washer] -= flux / storages[1]
    return sorted(float(-1.0 / rate.real) for rate in np.linalg.eigvals(rates))
