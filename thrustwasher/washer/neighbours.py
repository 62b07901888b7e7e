"""What solved draws say about the next one: where to start Newton's method, in which order to go.

A guess only: nothing here decides what a draw's solution is.
"""

import numpy as np

from ..numerics.jit import Array

NEIGHBOURS = 3  # times as many as a plane has coefficients: draws that a guess is made of
STIFF = 1e-3  # pull towards the mean where the neighbours do not span all directions


class Family:
    """Solutions of one kind met so far."""

    def __init__(self) -> None:
        self.n, self.x, self.y = 0, np.zeros((0, 0)), np.zeros((0, 0))

    def add(self, x: Array, y: Array) -> None:
        """Keep the solution ``y`` (m,) of the draw at ``x`` (k,)."""
        if self.n == len(self.x):
            room = max(32, 2 * self.n)
            new = np.zeros((room, len(x))), np.zeros((room, len(y)))
            for array, old in zip(new, (self.x, self.y), strict=True):
                array[: self.n] = old[: self.n].reshape(self.n, array.shape[1])
            self.x, self.y = new
        self.x[self.n], self.y[self.n] = x, y
        self.n += 1

    def guess(self, x: Array) -> Array | None:
        """Return about the solution (m,) of the draw at ``x`` (k,); None: none is known.

        On a plane through the nearest draws, weighted by their distance; of few the nearest.
        """
        if not self.n:
            return None
        away = self.x[: self.n] - x
        distance = np.einsum("ij,ij->i", away, away)
        n, k = away.shape
        if n < k + 3:
            nearest: Array = self.y[distance.argmin()].copy()
            return nearest
        near = np.arange(n)
        if n > (most := NEIGHBOURS * (k + 1)):
            near = np.argpartition(distance, most)[:most]
            away, distance = away[near], distance[near]
        weight = 1.0 / (distance + STIFF * float(distance.sum()) / len(near) + 1e-12)
        plane = np.empty((len(near), k + 1))
        plane[:, 0], plane[:, 1:] = 1.0, away
        normal = (plane.T * weight) @ plane
        normal.flat[k + 2 :: k + 2] += STIFF * float(weight @ distance) + 1e-12
        first = np.zeros(k + 1)
        first[0] = 1.0
        shares = weight * (plane @ np.linalg.solve(normal, first))
        guess: Array = np.einsum("i,ij->j", shares, self.y[near])  # BLAS would wake its threads
        return guess


def spread(rows: Array) -> Array:
    """Return what varies among rows (n, m), on scales (n, k) on which it varies by about one."""
    varied = rows[:, (rows != rows[:1]).any(axis=0)]
    if not varied.size:
        return varied
    positive = (varied > 0.0).all(axis=0)
    scaled = np.where(positive, np.log(np.where(positive, varied, 1.0)), varied)
    found: Array = scaled - scaled.mean(axis=0)
    found /= np.maximum(scaled.std(axis=0), 1e-300)
    return found


def chain(x: Array) -> list[int]:
    """Return the rows of ``x`` (n, k) in an order in which each is near the one before."""
    left, order = np.arange(len(x)), list[int]()
    here = np.zeros(x.shape[1])
    while len(left):
        away = x[left] - here
        nearest = int(np.argmin(np.einsum("ij,ij->i", away, away)))
        order.append(int(left[nearest]))
        here, left = x[order[-1]], np.delete(left, nearest)
    return order
