# mypy: disable-error-code="no-any-return"
"""The path of contact: where the pairs touch, what each bears, what its sliding costs and heats.

Positions count from the pitch point in base pitches. Spur teeth share the load equally, all pairs
that are in contact; teeth with an overlap of 1 and more bear evenly on the whole path. In between
the overlap ratio says which part of the load does the one, which the other. Below a contact ratio
of 1 the lines of contact themselves say it.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import smoothstep
from . import layout as L
from .contact import film_thickness, hertz_width
from .flank_temperature import blok_rise

# Lobatto's rule of five nodes on [0, 1]: both ends are among them, exact to power 7
NODES = (0.0, 0.5 - math.sqrt(3.0 / 28.0), 0.5, 0.5 + math.sqrt(3.0 / 28.0), 1.0)
WEIGHTS = (0.05, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 0.05)
N_NODES = 5
MAX_PIECES = 16
CLOSE = 1e-9  # base pitches between places that are one
EVEN_HEAT = math.sqrt(2.0 / math.pi) / 0.7859834  # Blok's factor of even over elliptic heat
# X_L of mineral oil, polyalphaolefin, ester, polyglycol: with Schlenk's law, as an open program
# has them; against scuffing, ISO/TS 6336-22 as publicly quoted, of an ester (not there) mineral's.
LOSS_LUBRICANT = (0.846, 0.65, 0.65, 0.585)
SCUFFING_LUBRICANT = (1.0, 0.8, 1.0, 0.7)
JOINS = 0.05  # base pitches that one pair more must be in contact to bear its share; chosen here
NEAR = 0.02  # of the greatest flash, within which other places count as hottest too; chosen here
MEAN_FLASH = 0.47  # of it the bodies of gears in dip lubrication are warmer than the oil


@kernel
def base_pitch(ratio: float, teeth: float, angle: float, side: float) -> float:
    """Return the transverse base pitch over the length of the line of action."""
    return 2.0 * math.pi * math.cos(angle) / (teeth * (ratio + side) * math.sin(angle))


@kernel
def flanks_at(par: Array, position: float) -> tuple[float, float, float]:
    """Return combined radius [m] across the contact line, both rolling speeds per speed [m]."""
    ratio, angle, side = par[L.P_GEAR_RATIO], par[L.D_ANGLE], par[L.D_SIDE]
    x = 1.0 / (ratio + side) + position * base_pitch(ratio, par[L.P_PINION_TEETH], angle, side)
    line = par[L.D_CENTRE] * math.sin(angle)
    radius = x * (1.0 - side * x) * line / par[L.D_COS_BASE]
    return radius, x * line, (1.0 - side * x) * line / ratio


@kernel
def even_part(par: Array) -> float:
    """Return which part of the load bears evenly on the whole path [-]: the overlap, at most 1."""
    return min(par[L.D_OVERLAP], 1.0)


@kernel
def pair_share(par: Array, pairs: float) -> float:
    """Return X [-], what a pair bears per face width where ``pairs`` of them are in contact.

    X = (1 - eps_beta)/pairs + eps_beta/eps_alpha: linear in the overlap ratio eps_beta up to 1, as
    the contact ratio factor of the pitting stress is.
    """
    even = even_part(par)
    return (1.0 - even) / pairs + even / par[L.D_CONTACT_RATIO]


@kernel
def joined(par: Array, whole: float, more: float, between: bool) -> float:
    """Return what a pair bears [-] while ``whole`` + 1 are in contact, ``more`` base pitches long.

    Just above a whole contact ratio the pair more takes over smoothly as ``more`` grows to JOINS,
    so that nothing jumps: at both ends of the path from a share of ``whole`` pairs, ``between``
    from that of one less, which is what they bear just below it.
    """
    full = pair_share(par, whole + 1.0)
    before = pair_share(par, max(whole - 1.0 if between else whole, 1.0))
    return before + (full - before) * smoothstep(more / JOINS)


@kernel
def _nodes(par: Array, low: float, high: float, shared: float, borne: float) -> None:
    """Add the positions from ``low`` to ``high`` [base pitches].

    ``borne``: what a pair there bears; ``shared`` 1/X as the loss books it.
    """
    n = int(par[L.D_PLACES])
    if not high > low or n + N_NODES > L.N_PATH:
        return
    for k in range(N_NODES):
        s = low + (high - low) * NODES[k]
        par[L.D_POSITION + n + k] = s
        par[L.D_PATH_SHARE + n + k] = borne
        par[L.D_PATH_LENGTH + n + k] = (high - low) * WEIGHTS[k]
        par[L.D_PATH_LOSS + n + k] = (high - low) * WEIGHTS[k] * abs(s) / shared
    par[L.D_PLACES] = float(n + N_NODES)


@kernel
def _piece(par: Array, low: float, high: float, shared: float, borne: float) -> None:
    """Add a piece; two halves of it for the level `fine` where the loss heats."""
    is_fine = par[L.P_FIDELITY] == L.FINE and par[L.P_FILM_HEAT] == L.LOSS
    if is_fine and par[L.D_CONTACT_RATIO] < 4.0:
        middle = 0.5 * (low + high)
        _nodes(par, low, middle, shared, borne)
        _nodes(par, middle, high, shared, borne)
    else:
        _nodes(par, low, high, shared, borne)


@kernel
def _split(par: Array, low: float, high: float, shared: float, borne: float) -> None:
    """Add an interval, cut at the pitch point, where sliding turns round."""
    if low < 0.0 < high:
        _piece(par, low, 0.0, shared, borne)
        _piece(par, 0.0, high, shared, borne)
    else:
        _piece(par, low, high, shared, borne)


@kernel
def part_of(value: float) -> float:
    """Return what of a number is behind its whole part."""
    return value - math.floor(value)


@kernel
def shortest_lines(contact: float, overlap: float) -> float:
    """Return the least length of all lines of contact together, of full ones across the face.

    symbol   meaning                                                                     unit
    contact  transverse contact ratio                                                    -
    overlap  overlap ratio; with the contact ratio more than 1 together                  -

    On the mean it is the contact ratio.
    """
    one, two = part_of(contact), part_of(overlap)
    less = one * two if one + two <= 1.0 else (1.0 - one) * (1.0 - two)
    return contact - less / overlap


@kernel
def lines_at(contact: float, overlap: float, phase: float) -> float:
    """Return the length of all lines of contact together at a phase [base pitches along the face].

    One line grows from 0 to the smaller of both ratios and shrinks again while it moves on by
    their sum; the next one follows a pitch behind. What whole pitches of overlap bear is constant.
    """
    rest = part_of(overlap)
    small, moved = min(contact, rest), part_of(phase)
    total = (overlap - rest) * contact
    for _ in range(2):
        total += max(min(moved, small, contact + rest - moved), 0.0)
        moved += 1.0
    return total


@kernel
def gathered(contact: float, overlap: float, phase: float) -> float:
    """Return the integral of 1/L from 0 to ``phase`` [base pitches], L as of ``lines_at``.

    L is straight between the phases where a line begins, is full, shrinks or ends.
    """
    corners = (contact, part_of(overlap), part_of(contact + overlap), 1.0)
    end, before = part_of(phase), lines_at(contact, overlap, 0.0)
    low, found, period = 0.0, 0.0, 0.0
    for _ in range(6):
        high = 1.0
        for k in range(4):
            if low < corners[k] < high:
                high = corners[k]
        if low < end < high:
            high = end
        here = lines_at(contact, overlap, high)
        rises = here / before - 1.0
        if abs(rises) > 1e-6:
            part = (high - low) / before * math.log1p(rises) / rises
        else:
            part = (high - low) / before * (1.0 - 0.5 * rises)
        period += part
        if high <= end:
            found += part
        low, before = high, here
    return found + math.floor(phase) * period


@kernel
def lines_of_contact(par: Array) -> None:
    """Fill positions, shares and losses where the contact ratio is below 1.

    The load spreads evenly over all lines of contact there are at a time. What a position bears is
    the most of that at any time and place along the face; the loss books the mean of it.
    """
    contact, overlap = par[L.D_CONTACT_RATIO], par[L.D_OVERLAP]
    least, small = shortest_lines(contact, overlap) * overlap, min(contact, overlap)
    middle = math.sqrt(least * small)
    corners = (
        part_of(overlap),
        part_of(contact + overlap),
        part_of(1.0 - overlap),
        part_of(contact - overlap),
        small,
        contact - small,
        middle,
        contact - middle,
        0.5 * contact,
        par[L.D_APPROACH],  # the pitch point, where sliding turns round
    )
    low, n = 0.0, 0
    for _ in range(11):
        high = contact
        for k in range(10):
            if low + CLOSE < corners[k] < high - CLOSE:
                high = corners[k]
        for k in range(N_NODES):
            at, length = low + (high - low) * NODES[k], (high - low) * WEIGHTS[k]
            s = at - par[L.D_APPROACH]
            mean = gathered(contact, overlap, at + overlap) - gathered(contact, overlap, at)
            shortest = least
            if overlap < 1.0:
                shortest = max(least, min(at, contact - at, small))
            par[L.D_POSITION + n + k] = s
            par[L.D_PATH_SHARE + n + k] = overlap / shortest
            par[L.D_PATH_LENGTH + n + k] = length
            par[L.D_PATH_LOSS + n + k] = length * abs(s) * mean
        n += N_NODES if high > low else 0  # else filled anew, or never read
        low = high
    par[L.D_PLACES] = float(n)


@kernel
def line_of_action(par: Array, approach: float, recess: float) -> None:
    """Fill positions, shares and losses from the start to the end of contact.

    The loss books the shares X, as D_LOSS does, and comes to it; pressure, flash and film have
    those of ``joined``. The paper's heat is made by the
    pair that bears the parameter ``load_share`` where it has company, all where it is alone.
    """
    whole = math.floor(approach + recess)
    more = approach + recess - whole
    given = par[L.P_LOAD_SHARE]
    alone = 1.0 if whole <= 1.0 else min(1.0, given * (whole + 1.0) / whole)
    many, few = whole + 1.0, max(whole, 1.0)
    if par[L.P_FILM_HEAT] == L.LOSS:
        given, alone = pair_share(par, many), pair_share(par, few)
        many, few = 1.0 / given, 1.0 / alone
    intervals = int(min(whole, 0.5 * MAX_PIECES - 1.0)) + 1
    par[L.D_PLACES] = 0.0
    if whole < 1.0:
        lines_of_contact(par)
        intervals = 0
    elif par[L.D_OVERLAP] >= 1.0:
        _split(par, -approach, recess, approach + recess, 1.0 / (approach + recess))
        intervals = 0
    for k in range(intervals):
        low, borne = -approach + k, given
        if par[L.P_FILM_HEAT] == L.LOSS:
            borne = joined(par, whole, more, 0 < k < whole)
        _split(par, low, low + more, many, borne)
        if k < whole:
            _split(par, low + more, low + 1.0, few, alone)
    total = 0.0
    for k in range(int(par[L.D_PLACES])):
        total += par[L.D_PATH_LOSS + k]
    if whole < 1.0:  # a transverse section is not always in contact
        ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
        around = 2.0 * math.pi * (ratio + par[L.D_SIDE]) / (teeth * ratio)
        par[L.D_LOSS] = par[L.D_LOSS_SPUR] = around * total / par[L.D_COS_BASE]
    for k in range(int(par[L.D_PLACES])):  # shares of the loss for one coefficient of friction
        par[L.D_PATH_LOSS + k] /= total


@kernel
def loss_over_scuffing(par: Array) -> float:
    """Return the friction of the loss over that against scuffing [-], mineral oil, no bounds.

    1 for laws that make both.
    """
    law = par[L.P_FRICTION_LAW]
    if law == L.SCHLENK or law == L.MIXED_FRICTION:
        return 0.8 * LOSS_LUBRICANT[0] * math.exp(-0.2 * math.log(math.cos(par[L.D_ANGLE])))
    return 1.0


@kernel
def place_constants(par: Array, k: int) -> None:
    """Fill what position ``k`` makes of load, speed and viscosity of 1.

    Flash temperature of a friction of 1 over w^(3/4) om^(1/2), film over (mu om)^0.7 w^-0.13, mean
    Hertz pressure over w^(1/2); w is the load per face width if one pair bore all of it.
    """
    radius, v1, v2 = flanks_at(par, par[L.D_POSITION + k])
    share, theta = par[L.D_PATH_SHARE + k], par[L.D_THETA]
    width = hertz_width(share, radius, theta)
    first, second = par[L.D_EFFUSIVITY], par[L.D_EFFUSIVITY_GEAR]
    rise = EVEN_HEAT * blok_rise(1.0, share, v1, v2, width, first, second)
    par[np.uintp(L.D_PATH_FLASH + k)] = rise
    par[np.uintp(L.D_PATH_FILM + k)] = film_thickness(
        1.0, 0.5 * (v1 + v2), share, radius, theta, par[L.D_ALPHA]
    )
    par[np.uintp(L.D_PATH_PRESSURE + k)] = share / width


@kernel
def _blend_hottest(par: Array) -> None:
    """Fill what is seen where the flash is greatest: radius, speeds, share, film of 1.

    So that nothing jumps where another place becomes the hottest, a mean: a place less hot by the
    share d of the greatest flash weighs (1 - d/NEAR)^2 times its length.
    """
    total, radius, rolling, sliding, share, film = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(int(par[L.D_PLACES])):
        near = 1.0 - (1.0 - par[L.D_PATH_FLASH + k] / par[L.D_FLASH_MOST]) / NEAR
        if near > 0.0:
            weight = near * near * par[L.D_PATH_LENGTH + k]
            here, v1, v2 = flanks_at(par, par[L.D_POSITION + k])
            total += weight
            radius += weight * here
            rolling += weight * (v1 + v2)
            sliding += weight * abs(v1 - v2)
            share += weight * par[L.D_PATH_SHARE + k]
            film += weight * par[L.D_PATH_FILM + k]
    par[L.D_HOT_RADIUS], par[L.D_HOT_ROLLING] = radius / total, rolling / total
    par[L.D_HOT_SLIDING], par[L.D_HOT_SHARE] = sliding / total, share / total
    par[L.D_HOT_FILM] = film / total


@kernel
def derive_path(par: Array) -> None:
    """Fill the constants of all positions, their extremes, and the bodies' conductance.

    The bodies are to be warmer than the oil by 0.47 X_S X_mp times the mean flash temperature at
    the load factors, which goes with w^(3/4) om^(1/2) as the loss goes with w om: the conductance
    over w^(1/4) om^(1/2). X_mp = (1 + n)/2, n mates of the gear that has more of them. The flash is
    that of the scuffing standard's friction, the heat that of the loss.
    """
    mean, length = 0.0, 0.0
    par[L.D_FLASH_MOST] = par[L.D_PRESSURE_MOST] = 0.0
    for k in range(int(par[L.D_PLACES])):
        place_constants(par, k)
        flash = par[L.D_PATH_FLASH + k]
        mean += par[L.D_PATH_LENGTH + k] * flash
        length += par[L.D_PATH_LENGTH + k]
        par[L.D_PRESSURE_MOST] = max(par[L.D_PRESSURE_MOST], par[L.D_PATH_PRESSURE + k])
        if flash > par[L.D_FLASH_MOST]:
            par[L.D_FLASH_MOST], par[L.D_HOTTEST] = flash, float(k)
    _blend_hottest(par)
    mates = max(par[L.P_MATES_PINION], par[L.P_MATES_GEAR])
    rise = MEAN_FLASH * par[L.P_LUBRICATION_FACTOR] * mean / length
    rise *= 0.5 * (1.0 + mates) * par[L.D_FLASH_FACTOR]
    par[L.D_CONDUCTANCE] = loss_over_scuffing(par) * par[L.D_LOSS] / (par[L.D_LOAD] * rise)
