"""An exact solution: the times in which the heat of the bodies settles."""

from collections.abc import Sequence

import numpy as np


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
