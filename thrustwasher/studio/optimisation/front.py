"""Which designs no other one beats, and where the next searches aim."""

import numpy as np

from .designs import Array, Places

APART = 0.1  # of the box, between starts of one round


def unbeaten(costs: Array) -> Places:
    """Return the places of designs (n, 1 or 2) that none is better than, by rising first cost."""
    order = np.lexsort((costs[:, -1], costs[:, 0]))
    if costs.shape[1] == 1:
        return order[:1]
    found, least = [], np.inf
    for i in order:
        if costs[i, 1] < least:
            found.append(i)
            least = costs[i, 1]
    return np.array(found, np.intp)


def along(costs: Array) -> Array:
    """Return how far each design of a front lies along it, 0 .. 1; costs in shares of the front."""
    span = np.maximum(np.ptp(costs, axis=0), 1e-300)
    steps = np.linalg.norm(np.diff(costs / span, axis=0), axis=1)
    length = np.concatenate(([0.0], np.cumsum(steps)))
    found: Array = length / length[-1] if length[-1] > 0.0 else length
    return found


def spread(costs: Array, n: int) -> Places:
    """Return the places of at most ``n`` unbeaten designs, evenly along their front."""
    front = unbeaten(costs)
    if len(front) <= n:
        return front
    there = along(costs[front])
    near = [int(np.abs(there - x).argmin()) for x in np.linspace(0.0, 1.0, n)]
    return front[sorted(set(near))]


def levels(costs: Array, n: int) -> Array:
    """Return ``n`` values of the second cost, evenly along the front of designs (m, 2)."""
    front = costs[unbeaten(costs)]
    found: Array = np.interp(np.linspace(0.0, 1.0, n), along(front), front[:, 1])
    return found


def knee(costs: Array) -> int:
    """Return the place of the design of a front nearest to the best of both costs."""
    span = np.maximum(np.ptp(costs, axis=0), 1e-300)
    return int(np.linalg.norm((costs - costs.min(0)) / span, axis=1).argmin())


def apart(points: Array, order: Places, n: int) -> list[int]:
    """Return the first ``n`` places in ``order`` of points (m, k) that are not near one another."""
    found: list[int] = []
    for i in order.tolist():
        near = (np.abs(points[found] - points[i]).max(1) < APART).any() if found else False
        if not near:
            found.append(i)
        if len(found) == n:
            break
    return found
