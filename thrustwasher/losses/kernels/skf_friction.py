# mypy: disable-error-code="no-any-return"
"""The torque of a rolling bearing by SKF's model: rolling and sliding friction of its contacts.

SI units outside, those of the catalogue within: N, mm, mm2/s, 1/min, N mm.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import smoothstep
from .loss_laws import thinned
from .skf_series import ANGULAR, BALL, CYLINDRICAL

PALMGREN, SKF = 1, 2  # laws
RPM, MM2 = 30.0 / math.pi, 1e6
MIXED, BOUNDARY = 2.6e-8, 0.12  # of the weight of mixed friction; friction of asperities in motion
ROLLERS, TAPERS = 0.02, 0.002  # friction in full film
SOME = 0.01  # of the radial force, an axial one up to which the exponents of both cases are blended


@kernel
def geometry(
    row: Array, n: float, radial: float, axial: float, d: float, y: float, static: float
) -> tuple[float, float, float, float]:
    """Return G_rr and G_sl of SKF's tables, and their slopes over ln n (of centrifugal forces).

    ``row``: type and constants of the series; ``d`` mean diameter [mm]; ``y``: Y of a taper roller
    bearing; ``static``: C0 [N] of a ball bearing with axial force. With hardly any axial force the
    exponent of a ball bearing's diameter goes over from that of none.
    """
    kind, r1, r2, s1, s2 = int(row[0]), row[1], row[2], row[4], row[5]
    if kind == BALL:
        if axial <= 0.0:
            rolling = r1 * d**1.96 * radial**0.54
            return rolling, s1 * d**-0.26 * radial ** (5.0 / 3.0), 0.0, 0.0
        angle = math.radians(24.6 * (axial / static) ** 0.24)
        sine = math.sin(min(angle, 0.5 * math.pi))
        share = smoothstep(axial / (SOME * max(radial, 1e-3)))
        rolling = r1 * d**1.96 * (radial + r2 / sine * axial) ** 0.54
        pressed = radial**5 + s2 * d**1.5 / sine * axial**4
        return rolling, s1 * d ** (-0.26 + 0.115 * share) * pressed ** (1.0 / 3.0), 0.0, 0.0
    if kind == ANGULAR:
        thrown, flung = row[3] * d**4 * n * n, row[6] * d**4 * n * n
        force, pressed = radial + thrown + r2 * axial, radial + flung
        rolling = r1 * d**1.97 * force**0.54
        by_rolling = 1.08 * rolling * thrown / max(force, 1e-9)
        size = s1 * d**0.26
        sliding = size * (pressed ** (4.0 / 3.0) + s2 * axial ** (4.0 / 3.0))
        return rolling, sliding, by_rolling, 8.0 / 3.0 * size * pressed ** (1.0 / 3.0) * flung
    if kind == CYLINDRICAL:
        rolling = r1 * d**2.41 * radial**0.31
        return rolling, s1 * d**0.9 * axial + s2 * d * radial, 0.0, 0.0
    rolling = r1 * d**2.38 * (radial + r2 * y * axial) ** 0.31
    return rolling, s1 * d**0.82 * (radial + s2 * y * axial), 0.0, 0.0


@kernel
def skf_drag(
    speed: float,
    nu: float,
    forces: tuple[float, float],
    diameter: float,
    starving: float,
    row: Array,
    of_size: tuple[float, float],
    film: float,
) -> tuple[float, float, float]:
    """Return the torque of a rolling bearing, its slopes over speed [N m s] and nu [N m s/m2].

    ``forces``: radial and axial [N]; ``starving``: of ``starved``; ``row``: see ``geometry``;
    ``of_size``: its Y and C0 [N]; ``film``: friction of a ball bearing in full film. Drag of an oil
    bath and of seals is not in it. Source: see ``skf_series``; friction of asperities 0.12 of a
    bearing that turns, as in SKF's later editions (2013: 0.15).
    """
    n, d, thick = RPM * speed, 1e3 * diameter, MM2 * nu
    kind = int(row[0])
    smooth = film if kind <= ANGULAR else (ROLLERS if kind == CYLINDRICAL else TAPERS)
    rolling, sliding, turn_rolling, turn_sliding = geometry(
        row, n, forces[0], forces[1], d, of_size[0], of_size[1]
    )
    less, by_speed, by_nu = thinned(speed, nu, diameter, starving)
    rolled = 1e-3 * less * (thick * n) ** 0.6
    shared = MIXED * (n * thick) ** 1.4 * d
    weight = math.exp(-shared)
    friction = weight * BOUNDARY + (1.0 - weight) * smooth
    steeper = -1.4 * shared * weight * (BOUNDARY - smooth)  # over ln n and ln nu
    slope = rolled * (rolling * (0.6 + by_speed) + turn_rolling)
    slope += 1e-3 * (sliding * steeper + turn_sliding * friction)
    thicker = rolled * rolling * (0.6 + by_nu) + 1e-3 * sliding * steeper
    return rolled * rolling + 1e-3 * sliding * friction, slope / speed, thicker / nu


@kernel
def fill_series(numbers: tuple[float, ...], number: int, row: Array) -> None:
    """Fill type and constants of the series of that option; zeros for the first one, none."""
    for k in range(7):
        row[np.uintp(k)] = numbers[7 * (number - 2) + k] if number > 1 else 0.0
