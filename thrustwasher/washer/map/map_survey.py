"""How finely a map has to be cut: measured on some lines that cross its box.

Along each axis a few lines are solved at Chebyshev nodes of the whole box. The polynomial through
them tells how far any number of patches is off, and its tails over the film ratio tell how many
coefficients a piece needs. The fewest lines that keep the tolerance are taken.
"""

import dataclasses
import math
from collections.abc import Callable, Sequence
from itertools import islice, product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.chebyshev import lines_of
from ...numerics.jit import Array
from ..kernels.map import map_layout as M
from .map_line import Curve, fit_of, slope_of
from .map_line import nodes_of as ends_of
from .map_plan import FIELD_FROM, PLACES, MapPlan, Place

SHARE = 0.7  # of the tolerance: how far a map may be off its mesh
LIGHT = 0.8  # of the minimum load: what carries less is of no interest
TERMS_SHARE = 0.3  # of that: what the coefficients left out may come to
LOOSER = 3.0  # the tolerance of temperatures and flows over that of the torque
NODES = (10, 5, 5)  # solved along speed, tilt and oil temperature
MOST_PATCHES = (10, 4, 4)
BENDS = (0.7, 1.2, 2.5, 6.0)  # [rad/s]
FINE_TERMS, FEW_TERMS = 10, 7  # coefficients of the lines of a survey
LEAST_TERMS = 4
MIDDLE, LOW, HIGH = 0.0, -1.0, 1.0  # places across an axis
STEEPEST = 6.0  # relative change of the torque over that of the load that counts at most
DENSE = np.linspace(-1.0, 1.0, 81)
# across the other two axes; the first three are one tilt after the other along speed and oil
ACROSS = (
    ((LOW, MIDDLE), (MIDDLE, MIDDLE), (HIGH, MIDDLE)),
    ((MIDDLE, MIDDLE),),
    ((MIDDLE, LOW), (MIDDLE, MIDDLE), (MIDDLE, HIGH)),
)

Weights = tuple[NDArray[np.bool_], Array, Array, Array]
Solve = Callable[[Sequence[Sequence[Place]], tuple[int, ...]], list[list[Curve]]]


def surveyed(plan: MapPlan, solve: Solve) -> MapPlan:
    """Return the plan with the patches, coefficients and bend that its tolerance needs.

    ``solve`` returns the curves of rows of neighbours with so many coefficients.
    """
    n = (FEW_TERMS if plan.tolerance >= FIELD_FROM else FINE_TERMS,) * M.N_PIECES
    moved = [axis for axis, patches in enumerate(plan.patches) if patches]
    rows = [
        [across(plan, [*rest[:axis], x, *rest[axis:]]) for x in ends_of(NODES[axis])[::-1]]
        for axis in moved
        for rest in ACROSS[axis]
    ]
    curves = solve(rows or [[across(plan, [MIDDLE] * 3)]], n)
    terms, more = _terms(plan, curves)
    plan = dataclasses.replace(plan, terms=terms, more_terms=more)
    left = iter(curves)
    found = {axis: list(islice(left, len(ACROSS[axis]))) for axis in moved}
    return _cheapest(plan, found)


def across(plan: MapPlan, shares: Sequence[float]) -> Place:
    """Return a place from -1 .. 1 on the three scaled axes."""
    ends = zip(plan.axes, shares, strict=True)
    return plan.at(*(0.5 * (low + high + s * (high - low)) for (low, high), s in ends))


def torque_difference(plan: MapPlan, one: Curve, other: Curve) -> float:
    """Return how far two curves of one line are apart in torque at a load, relative, at most."""
    here, there, change = (
        np.stack([_dense(piece, slope) for piece in curve.pieces], 1)[None]
        for curve, slope in ((one, False), (other, False), (one, True))
    )
    scale = np.log([one.task.scale])[:, None, None]
    weights = _weights(here, change, scale, LIGHT * plan.box["load"][0])
    return _worst(there - here, weights)[0]


def _dense(piece: Array, slope: bool) -> Array:
    """Return the curves of a piece, or their slopes, all along it."""
    n = len(piece)
    matrix = np.polynomial.chebyshev.chebvander(DENSE, n - 1) @ fit_of(n)
    return np.asarray(matrix @ (slope_of(n) @ piece if slope else piece))


def _terms(plan: MapPlan, rows: Sequence[Sequence[Curve]]) -> tuple[tuple[int, ...], ...]:
    """Return how many coefficients main and other curves need in each piece, from all lines."""
    curves = [c for row in rows for c in row]
    n = len(curves[0].pieces[0])
    values = np.array([c.pieces for c in curves])
    sums = np.einsum("ij,lpjq->lpiq", fit_of(n), values)
    vander = np.polynomial.chebyshev.chebvander
    here = np.einsum("di,lpiq->ldpq", vander(DENSE, n - 1), sums)
    scale = np.log([c.task.scale for c in curves])[:, None, None]
    slope = vander(DENSE, n - 1) @ fit_of(n) @ slope_of(n)
    change = np.einsum("di,lpiq->ldpq", slope, values)
    weights = _weights(here, change, scale, LIGHT * plan.box["load"][0])
    allowed = TERMS_SHARE * SHARE * plan.tolerance
    terms, more = [n] * M.N_PIECES, [n] * M.N_PIECES
    for few in range(n - 1, LEAST_TERMS - 1, -1):
        ends = vander(ends_of(few), n - 1)
        matrix = vander(DENSE, few - 1) @ fit_of(few) @ ends - vander(DENSE, n - 1)
        off = np.einsum("di,lpiq->ldpq", matrix, sums)
        for p in range(M.N_PIECES):
            main, others = _worst(off[:, :, p], [x[:, :, p] for x in weights])
            terms[p] = few if main <= allowed and terms[p] == few + 1 else terms[p]
            more[p] = few if others <= LOOSER * allowed and more[p] == few + 1 else more[p]
    return tuple(terms), tuple(map(min, terms, more))


def _weights(here: Array, change: Array, scale: Array, least: float) -> Weights:
    """Return what counts, the film's shares of load and torque, and d ln(torque)/d ln(load).

    ``here`` are the curves, pieces on the third axis, ``change`` their slopes along a piece;
    ``scale`` is the logarithm of viscosity x speed. What carries less than ``least`` [N] or lies
    between folds does not count.
    """
    lift = scale + here[..., M.GF] - here[..., M.GC]
    drag = scale + here[..., M.VISCOUS] - here[..., M.GC] - here[..., M.DRY]
    lift, drag = (1.0 / (1.0 + np.exp(np.clip(-x, -500.0, 500.0))) for x in (lift, drag))
    for share in (lift, drag):
        share[:, :, M.THICK] = 1.0
    contact = here[..., M.GC].copy()
    contact[:, :, M.THICK] = -np.inf
    load = np.logaddexp(scale + here[..., M.GF], contact)
    grows, rubs = _of_both(change, lift, drag)
    steep = np.clip(rubs / np.minimum(grows, -1e-9), -STEEPEST, STEEPEST)
    return (load > math.log(least)) & (grows < 0.0), lift, drag, steep


def _of_both(part: Array, lift: Array, drag: Array) -> tuple[Array, Array]:
    """Return changes of ln(load) and ln(torque) of those of the curves."""
    dry = part[..., M.GC] + part[..., M.DRY]
    return (
        np.asarray(lift * part[..., M.GF] + (1.0 - lift) * part[..., M.GC]),
        np.asarray(drag * part[..., M.VISCOUS] + (1.0 - drag) * dry),
    )


def _off(patches: int, cubic: bool, warp: Callable[[Array], Array], n: int) -> Array:
    """Return the matrix from Chebyshev coefficients along an axis to errors of patches there.

    ``warp`` maps an axis that is bent otherwise onto that of the coefficients.
    """
    vander = np.polynomial.chebyshev.chebvander
    places = [(k + x) / patches for k in range(patches) for x in PLACES]
    nodes = 2.0 * np.array([*places, 1.0]) - 1.0
    weights = np.zeros((len(DENSE), len(nodes)))
    for row, x in zip(weights, DENSE, strict=True):
        k = min(int(0.5 * (x + 1.0) * patches), patches - 1)
        at = nodes[3 * k : 3 * k + 4]
        if cubic:
            row[3 * k : 3 * k + 4] = [
                np.prod([(x - b) / (a - b) for b in at if b != a]) for a in at
            ]
        else:
            share = (x - at[0]) / (at[3] - at[0])
            row[3 * k], row[3 * k + 3] = 1.0 - share, share
    return np.asarray(weights @ vander(warp(nodes), n - 1) - vander(warp(DENSE), n - 1))


def _errors(
    lines: Sequence[Sequence[Curve]],
    least: float,
    most: int,
    warp: Callable[[Array], Array],
    speed: Callable[[Array], Array] | None = None,
) -> tuple[list[float], list[float]]:
    """Return errors for 1, 2, ... patches: along the axis, and of what tilt adds between them.

    What carries less than ``least`` [N] does not count. ``speed`` gives the speed along the axis if
    it is that of the speed.
    """
    n = len(lines[0])
    values = np.array([[c.pieces for c in line] for line in lines])
    sums = np.einsum("ij,ljpnq->lipnq", fit_of(n)[:, ::-1], values)
    # what the middle tilt has beyond the mean of the two ends
    bent = sums[1:2] - 0.5 * (sums[:1] + sums[2:3]) if len(lines) == 3 else 0.0 * sums
    there = np.polynomial.chebyshev.chebvander(warp(DENSE), n - 1)
    scale = np.array([[np.log(c.task.scale) for c in line] for line in lines])
    if speed is not None:
        scale -= np.log([[c.task.place[0] for c in line] for line in lines])
    scale = scale @ (there @ fit_of(n)[:, ::-1]).T
    if speed is not None:
        scale += np.log(speed(DENSE))
    here = np.einsum("di,lipnq->ldpnq", there, sums)
    change = np.einsum("nm,ldpmq->ldpnq", slope_of(here.shape[3]), here)
    weights = _weights(here, change, scale[:, :, None, None], least)
    middle = slice(1, 2) if len(lines) == 3 else slice(None)
    along, mixed = [], []
    for patches in range(1, most + 1):
        off = np.einsum("di,lipnq->ldpnq", _off(patches, True, warp, n), sums)
        along.append(_size(_worst(off, weights)))
        off = np.einsum("di,lipnq->ldpnq", _off(patches, False, warp, n), bent)
        mixed.append(_size(_worst(off, [x[middle] for x in weights])))
    return along, mixed


def _worst(off: Array, weights: Sequence[Any]) -> tuple[float, float]:
    """Return the largest error of the torque at a given load, and of the other curves."""
    counts, lift, drag, steep = weights
    load, torque = _of_both(off, lift, drag)
    rest = [off[..., k] for k in (M.MEAN, M.FILM, M.FLOW, M.CARRIED, M.GRIP)]
    main, others = (
        max(np.abs(x[counts]).max(initial=0.0) for x in part)
        for part in ((torque - steep * load,), rest)
    )
    return float(main), float(others)


def _size(errors: tuple[float, float]) -> float:
    """Return one error for both."""
    return max(errors[0], errors[1] / LOOSER)


def _cheapest(plan: MapPlan, found: dict[int, list[list[Curve]]]) -> MapPlan:
    """Return the plan with the fewest lines whose errors, in root of squares, are allowed."""
    choices = [
        range(1, most + 1) if n else range(1)
        for n, most in zip(plan.patches, MOST_PATCHES, strict=True)
    ]
    least = LIGHT * plan.box["load"][0]
    speed = tilt = oil = ([0.0], [0.0])
    if 1 in found:
        tilt = _errors(found[1], least, MOST_PATCHES[1], np.asarray)
    if 2 in found:
        oil = _errors(found[2], least, MOST_PATCHES[2], np.asarray)
    best: tuple[bool, float, MapPlan] | None = None
    for bend in BENDS if 0 in found else (plan.bend,):
        bent = dataclasses.replace(plan, bend=bend)
        if 0 in found:
            speed = _errors(found[0], least, MOST_PATCHES[0], *_warp(plan, bent))
        for p1, p2, p3 in product(*choices):
            parts = [speed[0][p1 - 1], tilt[0][p2 - 1], oil[0][p3 - 1]]
            parts += [speed[1][p1 - 1] / p2**2, oil[1][p3 - 1] / p2**2] if p2 else []
            error = math.hypot(*parts)
            off = max(error / (SHARE * plan.tolerance), 1.0)
            candidate = dataclasses.replace(bent, patches=(p1, p2, p3))
            if candidate.size > M.ROOM:
                continue
            rank = off > 1.0, off if off > 1.0 else float(lines_of(p1, p2, p3))
            if best is None or rank < best[:2]:
                best = (*rank, candidate)
    return best[2] if best else plan


def _warp(
    plan: MapPlan, bent: MapPlan
) -> tuple[Callable[[Array], Array], Callable[[Array], Array]]:
    """Return from places on a speed axis with another bend to the plan's own, and to the speed."""
    (low, high), (low_bent, high_bent) = plan.axes[0], bent.axes[0]

    def speed(x: Array) -> Array:
        at = 0.5 * (low_bent + high_bent + x * (high_bent - low_bent))
        return np.asarray(bent.bend * np.sinh(at))

    def places(x: Array) -> Array:
        there = np.arcsinh(speed(x) / plan.bend)
        return np.asarray(np.clip((2.0 * there - low - high) / (high - low), -1.0, 1.0))

    return places, speed
