"""The first points of Sobol's sequence, without scipy.stats, whose import takes half a second.

Source: direction numbers of Joe and Kuo (2008), SIAM J. Sci. Comput. 30(5), file new-joe-kuo-6;
points in the order of Gray's code, as ``scipy.stats.qmc.Sobol`` has them.
"""

import numpy as np

from ...numerics.jit import Array

POINTS = 32
# Of each axis the second to the fifth direction number; the first is 1, and 32 points need no more.
_DIRECTIONS = """
1.1.1.1 3.5.15.17 3.3.9.29 3.1.5.31 1.1.11.31 1.3.3.25 3.5.13.11 1.5.5.17 1.5.5.5 1.7.11.19
1.5.1.1 1.1.3.11 3.5.5.31 3.3.9.7 1.1.15.21 3.1.13.27 1.1.15.7 3.1.15.13 1.5.5.19 3.7.11.23
3.7.13.13 1.3.13.7 3.5.9.1 3.1.13.9 3.1.5.27 1.5.11.19 3.5.3.3 1.7.13.1 3.7.5.13 1.3.9.25
3.5.13.23 3.7.3.13 3.1.3.5 1.5.5.23 1.7.7.1 1.7.9.13 3.3.5.3 3.1.15.31 3.5.15.31 3.1.11.11
3.1.11.27 1.7.15.21 3.7.3.25 3.1.1.19 1.5.9.19 3.7.11.1 3.3.3.15 3.7.11.15 1.3.1.11 1.1.3.23
3.7.7.17 3.1.5.27 1.3.5.11 3.5.5.29 3.3.11.3 1.1.5.17 3.1.5.25 1.1.11.11 1.5.11.9 1.5.15.19
3.7.7.31 1.1.3.23 1.5.13.31 1.3.13.25
""".split()


def first_points(n: int) -> Array:
    """Return the first 32 points (32, n), each axis in [0, 1); from 65 axes on they are scipy's."""
    if n > len(_DIRECTIONS):
        from scipy.stats.qmc import Sobol

        found: Array = Sobol(n, scramble=False).random(POINTS)
        return found
    numbers = np.array([[1, *map(int, own.split("."))] for own in _DIRECTIONS[:n]]).reshape(n, 5)
    steps = (numbers << np.arange(4, -1, -1)).T  # one more bit of the point's number each
    points = np.zeros((POINTS, n), np.int64)
    for i in range(1, POINTS):
        points[i] = points[i - 1] ^ steps[(i & -i).bit_length() - 1]
    return points / POINTS
