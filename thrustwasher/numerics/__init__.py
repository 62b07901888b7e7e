"""Numerical methods that know nothing of friction. Imports numpy, numba and math only.

==============  ==================================================================================
``banded``      Band matrices: symmetric (Cholesky) and general (LU without exchange), factor and
                solve
``chebyshev``   Charts: functions of three parameters as piecewise Chebyshev interpolants, read at
                one place
``dense``       Small dense linear systems: Gaussian elimination with row exchange, in place
``jit``         The one decorator of kernels
``quadrature``  Gauss-Legendre nodes and weights on [0, 1], frozen as constants for the kernels
``smoothing``   Corners rounded to one continuous derivative; exact outside the rounded stretch
``spline``      Quadrature weights of the not-a-knot cubic spline through given nodes
``status``      Numbers of the statuses that kernels return, equal to errors.Status
==============  ==================================================================================
"""
