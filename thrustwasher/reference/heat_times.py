"""Time constants of three flat bodies in a stack that stores heat."""

import numpy as np


def stack_times(
    thicknesses: tuple[float, float, float], conductivity: float, volume_heat: float,
    between_carrier_washer: float, between_washer_gear: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Return the three times [s], shortest first, in which the stack's temperatures settle.

    Each body of thickness t [m] has one temperature and stores ``volume_heat`` [J/(m3 K)] times t;
    carrier and gear lose heat through t/``conductivity`` [W/(m K)], the bodies exchange it through
    the two resistances [m2 K/W]. Along the faces nothing flows, as when all is even.
    """
    carrier, _, gear = thicknesses
    out_c, out_g = conductivity / carrier, conductivity / gear
    one, two = 1.0 / between_carrier_washer, 1.0 / between_washer_gear
    flows = np.array([
        [out_c + one, -one, 0.0],
        [-one, one + two, -two],
        [0.0, -two, out_g + two],
    ])  # fmt: skip
    root = np.sqrt(volume_heat * np.array(thicknesses))
    rates = np.linalg.eigvalsh(flows / np.outer(root, root))
    times = sorted(float(1.0 / rate) for rate in rates)
    return times[0], times[1], times[2]
