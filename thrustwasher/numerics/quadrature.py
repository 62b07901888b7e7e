"""Gauss-Legendre nodes and weights on [0, 1], frozen as constants for the kernels."""

import numpy as np

_x, _w = np.polynomial.legendre.leggauss(12)
GAUSS_NODES = 0.5 * (_x + 1.0)
GAUSS_WEIGHTS = 0.5 * _w
