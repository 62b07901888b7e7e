# mypy: disable-error-code="no-any-return"
"""Where a planet settles on its needles, and what of its tilting couple is left to the washers.

The planet shifts by (x, y) against its pin, along tangent and radius, and tilts by (a, b) in the
planes of both. A needle at the angle phi is pressed at height z by

    delta = (x + a z) cos(phi) + (y + b z) sin(phi) - clearance

and carries q = (delta/(3.84e-5 L^0.1))^(1/0.9) [N/mm], lengths in mm, slice by slice. Both tooth
forces push along the tangent, the centrifugal force along the radius; the couple of the axial
forces tilts along the radius. From tilt x outer diameter = end play on the washers bear, with a
lever of twice their radius.

The energy of needles and washers is convex, so the place is found by Newton's method with a line
search. Tilts count times half the length: all unknowns are lengths.

Source: Palmgren's line contact as in Harris, Rolling Bearing Analysis, as publicly quoted.
"""

import math

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.dense import dense_solve
from ...numerics.jit import Array, kernel
from . import layout as L

PALMGREN = 3.84e-5  # mm, N
POWER = 1.0 / 0.9
LIGHT = 1e-3  # N: below, the planet lies anywhere in its clearance, untilted here
SOFT = np.array([1e-3, 1e-2, 0.1, 1.0])  # of the washers' stiffness, stage by stage
SEARCHES, HALVINGS = 300, 40
ROUNDING, LOOSE = 4e-16, 1e-7  # the latter: what a search that has not ended may leave
SETTLED = 1e-12  # of the load
STIFF = 1e4  # of the needles' stiffness over tilt: that of the washers
N = 4


@kernel
def derive_needles(par: Array) -> None:
    """Fill the constants: stiffness of a slice [N/m^(10/9)], largest tilt times half the length."""
    length, slices = par[L.P_NEEDLE_LENGTH], par[L.P_NEEDLE_SLICES]
    line = 1e3 * (1e3 / (PALMGREN * (1e3 * length) ** 0.1)) ** POWER  # N/m
    par[L.D_NEEDLE_LINE] = line * length / slices
    largest = par[L.P_END_PLAY] / (2.0 * par[L.P_WASHER_OUTER_RADIUS])
    par[L.D_LARGEST_TILT] = largest * 0.5 * length
    module = par[L.P_NORMAL_MODULE] / math.cos(par[L.P_HELIX_ANGLE])
    sun, planet = par[L.P_SUN_TEETH], par[L.D_PLANET_RADIUS] / (0.5 * module)
    par[L.D_CENTRE] = 0.5 * module * (sun + planet)


@kernel
def pressed_needles(par: Array, z: Array, bear: float, gradient: Array, stiffness: Array) -> None:
    """Fill forces and stiffness of needles and washers at ``z``.

    ``z``: x, y and both tilts times half the length [m]; ``bear``: the washers' stiffness [N/m].
    """
    clear(gradient)
    clear(stiffness)
    count, slices = int(par[L.P_NEEDLE_COUNT]), int(par[L.P_NEEDLE_SLICES])
    line, free = par[L.D_NEEDLE_LINE], par[L.P_NEEDLE_CLEARANCE]
    for j in range(count):
        angle = 2.0 * math.pi * j / count
        c, s = math.cos(angle), math.sin(angle)
        middle, slope = z[0] * c + z[1] * s - free, z[2] * c + z[3] * s
        for k in range(slices):
            at = (2.0 * k + 1.0) / slices - 1.0  # of half the length
            delta = middle + slope * at
            if delta <= 0.0:
                continue
            force = line * delta**POWER
            stiff = POWER * force / delta
            for i in range(N):
                lever = (c if i % 2 == 0 else s) * (1.0 if i < 2 else at)
                gradient[np.uintp(i)] += force * lever
                for m in range(i + 1):
                    other = (c if m % 2 == 0 else s) * (1.0 if m < 2 else at)
                    stiffness[np.uintp(i * N + m)] += stiff * lever * other
    tilt = math.hypot(z[2], z[3])
    over = tilt - par[L.D_LARGEST_TILT]
    if over > 0.0:
        c, s = z[2] / tilt, z[3] / tilt
        gradient[2] += bear * over * c
        gradient[3] += bear * over * s
        across = bear * over / tilt
        stiffness[2 * N + 2] += bear * c * c + across * s * s
        stiffness[3 * N + 2] += (bear - across) * c * s
        stiffness[3 * N + 3] += bear * s * s + across * c * c
    for i in range(N):
        for m in range(i):
            stiffness[np.uintp(m * N + i)] = stiffness[np.uintp(i * N + m)]


@kernel
def washer_stiffness(par: Array) -> float:
    """Return the stiffness [N/m] with which washers stop the tilt: rigid beside the needles."""
    largest = max(par[L.D_LARGEST_TILT], 1e-6)
    slope = POWER * par[L.D_NEEDLE_LINE] * largest ** (POWER - 1.0)
    return STIFF * slope * par[L.P_NEEDLE_COUNT] * par[L.P_NEEDLE_SLICES]


@kernel
def settle(par: Array, loads: Array, work: Array) -> bool:
    """Find the place of the planet under ``loads``: at the front of ``work``; tell if it was found.

    ``loads`` [N]: along tangent and radius, both couples over half the length. Behind the place lie
    what bears the load, its stiffness, and room for the search.
    """
    z = work[0:N]
    size = math.hypot(math.hypot(loads[0], loads[1]), math.hypot(loads[2], loads[3]))
    clear(work[0 : L.N_SETTLED])
    if size < LIGHT:
        return True
    count, slices = par[L.P_NEEDLE_COUNT], par[L.P_NEEDLE_SLICES]
    reach = (4.0 * size / (count * slices * par[L.D_NEEDLE_LINE])) ** (1.0 / POWER)
    push = math.hypot(loads[0], loads[1])
    for i in range(2):
        along = loads[np.uintp(i)] / push if push > 0.0 else 0.0
        z[np.uintp(i)] = (par[L.P_NEEDLE_CLEARANCE] + reach) * along
        turn = math.hypot(loads[2], loads[3])
        if turn > 0.0:
            z[np.uintp(2 + i)] = reach * loads[np.uintp(2 + i)] / turn
    for soft in SOFT:  # washers that are soft first show the way to where they bear
        bear = washer_stiffness(par) * soft
        if not search(par, loads, size, reach + par[L.P_NEEDLE_CLEARANCE], bear, work):
            return False
        if math.hypot(z[2], z[3]) <= par[L.D_LARGEST_TILT]:
            break
    return True


@kernel
def search(par: Array, loads: Array, size: float, reach: float, bear: float, work: Array) -> bool:
    """Move the planet to where needles and washers of stiffness ``bear`` hold the ``loads``.

    ``size`` of the loads [N], ``reach`` of the planet [m]; ``work`` as for ``settle``.
    """
    z, gradient = work[0:N], work[N : 2 * N]
    stiffness, move = work[2 * N : 6 * N], work[6 * N : 7 * N]
    trial = work[7 * N : 8 * N]
    pressed_needles(par, z, bear, gradient, stiffness)
    longest, off = 4.0 * reach + par[L.D_LARGEST_TILT], math.inf
    for _ in range(SEARCHES):
        off, rounding = 0.0, bear * math.hypot(z[2], z[3])
        for i in range(N):
            trial[np.uintp(i)] = loads[np.uintp(i)] - gradient[np.uintp(i)]
            move[np.uintp(i)] = trial[np.uintp(i)]
            off = max(off, abs(trial[np.uintp(i)]))
            rounding += stiffness[np.uintp(i * N + i)] * reach
        if off <= SETTLED * size + ROUNDING * rounding:
            return True
        for i in range(N):
            stiffness[np.uintp(i * N + i)] += 1e-9 * size / reach
        if not dense_solve(stiffness, move, N):
            return False
        steep, far = 0.0, 0.0
        for i in range(N):
            steep += trial[np.uintp(i)] * move[np.uintp(i)]
            far = max(far, abs(move[np.uintp(i)]))
        share = min(1.0, longest / far)
        for _ in range(HALVINGS):
            for i in range(N):
                trial[np.uintp(i)] = z[np.uintp(i)] + share * move[np.uintp(i)]
            pressed_needles(par, trial, bear, gradient, stiffness)
            left = 0.0  # of what drives the move; it falls along the way
            for i in range(N):
                left += (loads[np.uintp(i)] - gradient[np.uintp(i)]) * move[np.uintp(i)]
            if left >= -0.1 * steep:
                break
            share *= max(0.1, steep / (steep - left))
        copy(trial, z)
    return off <= LOOSE * size


@kernel
def loads_of(par: Array, force: float, carrier: float, couple: float, loads: Array) -> None:
    """Fill the loads on a planet: ``force`` [N] of each mesh, ``couple`` [N m], carrier [rad/s]."""
    loads[0] = 2.0 * force
    loads[1] = par[L.P_PLANET_MASS] * par[L.D_CENTRE] * carrier * carrier
    loads[2] = 0.0
    loads[3] = couple / (0.5 * par[L.P_NEEDLE_LENGTH])


@kernel
def washer_share(par: Array, work: Array) -> tuple[float, float]:
    """Return the washers' load [N] and the tilt [rad] after ``settle`` filled ``work``."""
    half = 0.5 * par[L.P_NEEDLE_LENGTH]
    tilt = math.hypot(work[2], work[3])
    over = max(tilt - par[L.D_LARGEST_TILT], 0.0)
    couple = washer_stiffness(par) * over * half
    return couple / (2.0 * par[L.P_WASHER_RADIUS]), tilt / half


@kernel
def washer_changes(par: Array, changes: Array, work: Array) -> tuple[float, float]:
    """Return how load and tilt of ``washer_share`` change with the loads; ``work`` as left there.

    The stiffness is that of the settled place.
    """
    z, stiffness = work[0:N], work[9 * N : 13 * N]
    copy(work[2 * N : 6 * N], stiffness)
    tilt = math.hypot(z[2], z[3])
    if not tilt > 0.0 or not dense_solve(stiffness, changes, N):
        return 0.0, 0.0
    change = (z[2] * changes[2] + z[3] * changes[3]) / tilt
    half = 0.5 * par[L.P_NEEDLE_LENGTH]
    if tilt <= par[L.D_LARGEST_TILT]:
        return 0.0, change / half
    return washer_stiffness(par) * change * half / (2.0 * par[L.P_WASHER_RADIUS]), change / half
