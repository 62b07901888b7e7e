# mypy: disable-error-code="no-any-return"
"""Load shared by the stiffness of the pairs in contact; tip relief is a gap in front of them.

All pairs are pressed together by the same distance d: a pair with stiffness c and gap g carries
c max(d - g, 0) per face width, and all together the load. Shares so depend on the load. Teeth with
an overlap have one d for all phases that lie beside each other along the face.

Positions count from the pitch point in base pitches, phases from the start of contact on through
one of them: pairs stand at a phase and whole pitches beyond it.

Source: single stiffness c' of ISO 6336-1, method B, as publicly quoted (the standard's text was
not at hand), without its fall below 100 N/mm; parabola over the path: an estimate.
"""

import math
from typing import NamedTuple

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored
from . import layout as L
from .mesh_point import LEAST_LINE_LOAD
from .micropitting import thinnest_films
from .path_of_contact import (
    N_NODES,
    NODES,
    WEIGHTS,
    base_pitch,
    derive_path,
    even_part,
)
from .working_pair import gear_shift, working_section

STEEL = 206e9  # Pa
CORRECTION = 0.8  # of the theoretical stiffness, C_M
LEAST_SHARE = 1e-12  # of a pair that relief has lifted off: its film and width stay finite
MOST_RATIO = (
    3.0  # contact ratio below which all positions have room; from 1 on a pair is in contact
)
HALVINGS, NEWTON = 60, 40
MOST_CORNERS = 32


class Pairs(NamedTuple):
    """Stiffness and relief along the path of contact."""

    approach: float  # base pitches
    recess: float
    stiffness: float  # [N/m2] in the middle of the path
    drop: float  # share of it that is lost towards the ends
    gear_relief: float  # [m] where contact starts
    gear_length: float  # base pitches
    pinion_relief: float  # where it ends
    pinion_length: float


@kernel
def pitch_of(par: Array) -> float:
    """Return the transverse base pitch [m]."""
    side, centre, angle, _ = working_section(par)
    pitch = base_pitch(par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH], angle, side)
    return pitch * centre * math.sin(angle)


@kernel
def single_stiffness(par: Array) -> float:
    """Return c' [N/m2], force per face width and deflection of a pair in the middle of its path."""
    slant, cos_base = math.cos(par[L.P_HELIX_ANGLE]), par[L.D_COS_BASE]
    one = slant * cos_base * cos_base / par[L.P_PINION_TEETH]  # 1/z_n
    two, x1, x2 = one / par[L.P_GEAR_RATIO], par[L.P_PROFILE_SHIFT_PINION], 0.0
    if par[L.D_SIDE] < 0.0:
        two = 0.0  # a ring counts as a rack
    else:
        x2 = gear_shift(par)
    q = 0.04723 + 0.15551 * one + 0.25791 * two
    q -= 0.00635 * x1 + 0.11654 * x1 * one + 0.00193 * x2 + 0.24188 * x2 * two
    q += 0.00529 * x1 * x1 + 0.00182 * x2 * x2
    first, second = par[L.P_YOUNGS_MODULUS], par[L.D_MODULUS_GEAR]
    mean_modulus = 2.0 * first * second / (first + second)
    rack = 1.0 + 0.5 * (1.2 - par[L.P_TOOL_ADDENDUM])
    rack *= 1.0 - 0.02 * (20.0 - math.degrees(par[L.P_PRESSURE_ANGLE]))
    return 1e9 * CORRECTION * rack * slant / q * mean_modulus / STEEL


@kernel
def pairs_of(par: Array) -> Pairs:
    """Return stiffness and relief of the pairs; the geometry is derived."""
    pitch = pitch_of(par)
    return Pairs(
        par[L.D_APPROACH],
        par[L.D_RECESS],
        single_stiffness(par),
        1.0 - par[L.P_STIFFNESS_AT_ENDS],
        par[L.P_TIP_RELIEF_GEAR],
        par[L.P_TIP_RELIEF_LENGTH_GEAR] / pitch,
        par[L.P_TIP_RELIEF_PINION],
        par[L.P_TIP_RELIEF_LENGTH_PINION] / pitch,
    )


@kernel
def sharing_rule(par: Array, ratio: float, pitch: float) -> int:
    """Return the number of the first rule of elastic sharing that is broken; 0: none.

    ``ratio``: contact ratio, ``pitch`` [m] of the base circles.
    """
    if par[L.P_LOAD_SHARING] != L.ELASTIC:
        return 0
    if par[L.P_FILM_HEAT] != L.LOSS:
        return 21
    if not 1.0 <= ratio < MOST_RATIO:
        return 22
    reach = 0.0
    for k in range(2):
        length = par[np.uintp(L.P_TIP_RELIEF_LENGTH_PINION + k)]
        if par[np.uintp(L.P_TIP_RELIEF_PINION + k)] > 0.0:
            if not length > 0.0:
                return 23
            reach += length
    return 0 if reach <= ratio * pitch else 23


@kernel
def stiffness_at(p: Pairs, s: float) -> float:
    """Return the stiffness [N/m2] of a pair at a position."""
    z = (2.0 * s - p.recess + p.approach) / (p.approach + p.recess)
    return p.stiffness * (1.0 - p.drop * z * z)


@kernel
def gap_at(p: Pairs, s: float) -> float:
    """Return the gap [m] that relief leaves in front of a pair: it falls linearly from the tip."""
    gap, run, left = 0.0, s + p.approach, p.recess - s
    if p.gear_relief > 0.0 and run < p.gear_length:
        gap += p.gear_relief * (1.0 - run / p.gear_length)
    if p.pinion_relief > 0.0 and left < p.pinion_length:
        gap += p.pinion_relief * (1.0 - left / p.pinion_length)
    return gap


@kernel
def pressed(p: Pairs, phase: float, pairs: int, without: int, load: float) -> float:
    """Return d [m] for ``pairs`` at ``phase`` and beyond; inf if none is left.

    ``without``: the number of a pair that is left out, or -1. Pairs whose gap is wider than d are
    taken out one after another, which lessens d.
    """
    d = math.inf
    for _ in range(pairs + 1):
        total, stiffness = load, 0.0
        for k in range(pairs):
            gap = gap_at(p, phase + k)
            if k != without and gap < d:
                here = stiffness_at(p, phase + k)
                total += here * gap
                stiffness += here
        before = d
        d = total / stiffness if stiffness > 0.0 else math.inf
        if d == before:
            break
    return d


@kernel
def _room(p: Pairs, phase: float, pairs: int, number: int, load: float) -> float:
    """Return by how much d without a pair is more than its gap [m]: it carries if above 0."""
    return pressed(p, phase, pairs, number, load) - gap_at(p, phase + number)


@kernel
def _lifts_off(
    p: Pairs, low: float, high: float, pairs: int, number: int, load: float
) -> tuple[bool, float]:
    """Tell if a pair begins or ends to carry between two phases, and where."""
    first, last = _room(p, low, pairs, number, load), _room(p, high, pairs, number, load)
    if (first > 0.0) == (last > 0.0):
        return False, low
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (_room(p, middle, pairs, number, load) > 0.0) == (first > 0.0):
            low = middle
        else:
            high = middle
    return True, 0.5 * (low + high)


@kernel
def _ends(p: Pairs, d: float) -> tuple[float, float]:
    """Return the positions between which a pair carries, pressed by ``d`` [m]."""
    low, high = -p.approach, p.recess
    if d < p.gear_relief:
        low += p.gear_length * (1.0 - d / p.gear_relief)
    if d < p.pinion_relief:
        high -= p.pinion_length * (1.0 - d / p.pinion_relief)
    return low, high


@kernel
def _carried(p: Pairs, d: float, low: float, high: float) -> tuple[float, float]:
    """Return what a stretch of the path carries at ``d``, [N/m], and its slope."""
    load, slope = 0.0, 0.0
    for k in range(N_NODES):
        s, weight = low + (high - low) * NODES[k], (high - low) * WEIGHTS[k]
        stiffness = weight * stiffness_at(p, s)
        load += stiffness * (d - gap_at(p, s))
        slope += stiffness
    return load, slope


@kernel
def pressed_evenly(p: Pairs, load: float) -> float:
    """Return d [m] where all positions of the path carry at the same time.

    Newton's method from above: what is carried is convex in d.
    """
    d = load / (p.stiffness * (1.0 - p.drop) * (p.approach + p.recess))
    d += p.gear_relief + p.pinion_relief
    for _ in range(NEWTON):
        low, high = _ends(p, d)
        one, two = -p.approach + p.gear_length, p.recess - p.pinion_length
        a, ga = _carried(p, d, low, max(one, low)) if p.gear_relief > 0.0 else (0.0, 0.0)
        b, gb = _carried(p, d, min(two, high), high) if p.pinion_relief > 0.0 else (0.0, 0.0)
        left = one if p.gear_relief > 0.0 else low
        right = two if p.pinion_relief > 0.0 else high
        c, gc = _carried(p, d, left, right)
        step = (a + b + c - load) / (ga + gb + gc)
        d -= step
        if abs(step) <= 1e-15 * d:
            break
    return d


@kernel
def _insert(corners: Array, count: int, value: float) -> int:
    """Insert a value into the ``count`` first, which rise; return how many there are then."""
    if count >= MOST_CORNERS:
        return count
    k = count
    while k > 0 and corners[k - 1] > value:
        corners[k] = corners[k - 1]
        k -= 1
    corners[k] = value
    return count + 1


@kernel
def _wrapped(p: Pairs, s: float) -> float:
    """Return the phase of a position."""
    return s - math.floor(s + p.approach)


@kernel
def _pairs_at(p: Pairs, phase: float) -> int:
    """Return how many pairs are within the path at a phase."""
    return int(p.recess - phase) + 1


@kernel
def _corners(p: Pairs, load: float, even: float, spread: float, found: Array) -> int:
    """Fill the phases where the shares or their slopes jump, rising; return how many."""
    start = -p.approach
    count = _insert(found, 0, start)
    count = _insert(found, count, start + 1.0)
    count = _insert(found, count, _wrapped(p, p.recess))
    count = _insert(found, count, _wrapped(p, 0.0))
    if p.gear_relief > 0.0:
        count = _insert(found, count, _wrapped(p, start + p.gear_length))
    if p.pinion_relief > 0.0:
        count = _insert(found, count, _wrapped(p, p.recess - p.pinion_length))
    if even > 0.0:
        low, high = _ends(p, spread)
        count = _insert(found, count, _wrapped(p, low))
        count = _insert(found, count, _wrapped(p, high))
    fixed = count
    for k in range(fixed - 1):
        found[MOST_CORNERS + k] = found[k]
    found[MOST_CORNERS + fixed - 1] = found[fixed - 1]
    for k in range(fixed - 1):
        low, high = found[MOST_CORNERS + k], found[MOST_CORNERS + k + 1]
        pairs = _pairs_at(p, 0.5 * (low + high))
        for number in range(pairs):
            moves, phase = _lifts_off(p, low, high, pairs, number, load)
            if moves:
                count = _insert(found, count, phase)
    return count


@kernel
def share_load(par: Array, load: float) -> None:
    """Fill positions, shares, lengths and losses of the path, and D_LOSS, at a line load [N/m].

    D_PLACES is 0 if they do not fit, which contact ratios below 3 do.
    """
    p, even = pairs_of(par), even_part(par)
    spread = pressed_evenly(p, load) if even > 0.0 else 0.0
    corners = par[L.D_PATH_FLASH : L.D_PATH_FLASH + 2 * MOST_CORNERS]  # filled anew later
    count = _corners(p, load, even, spread, corners)
    n, total = 0, 0.0
    for k in range(int(MOST_RATIO)):
        for c in range(count - 1):
            low, high = corners[c], corners[c + 1]
            middle = 0.5 * (low + high)
            if not (high > low and middle + k < p.recess) or n + N_NODES > L.N_PATH:
                continue
            pairs = _pairs_at(p, middle)
            for node in range(N_NODES):
                phase = low + (high - low) * NODES[node]
                s, length = phase + k, (high - low) * WEIGHTS[node]
                stiffness, gap = stiffness_at(p, s), gap_at(p, s)
                share = stiffness * max(pressed(p, phase, pairs, -1, load) - gap, 0.0)
                share *= (1.0 - even) / load
                share += even * stiffness * max(spread - gap, 0.0) / load
                par[L.D_POSITION + n] = s
                par[L.D_PATH_SHARE + n] = max(share, LEAST_SHARE)
                par[L.D_PATH_LENGTH + n] = length
                par[L.D_PATH_LOSS + n] = length * abs(s) * share
                total += length * abs(s) * share
                n += 1
    par[L.D_PLACES] = float(n)
    for k in range(n):
        par[L.D_PATH_LOSS + k] /= total
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    around = 2.0 * math.pi * (ratio + par[L.D_SIDE]) / (teeth * ratio)
    par[L.D_LOSS] = around * total / par[L.D_COS_BASE]


@kernel
def shared_at(par: Array, line: float, work: Array) -> Array:
    """Return the constants with the shares at a line load [N/m]: ``par`` where they are rigid."""
    if par[L.P_LOAD_SHARING] != L.ELASTIC:
        return par
    here = work[L.W_PAR : L.W_PAR + L.NPAR]
    copy(par, here)
    share_load(here, line)
    derive_path(here)
    thinnest_films(here)
    return here


@kernel
def shared(par: Array, torque: float, work: Array) -> Array:
    """Return the constants with the shares at a torque [N m]: ``par`` where they are rigid."""
    return shared_at(par, floored(torque * par[L.D_LINE], LEAST_LINE_LOAD), work)
