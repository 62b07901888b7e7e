"""Numerical methods that know nothing of friction. Imports numpy, numba and math only.

==============  ===============================================================================
``arrays``      whole arrays: copied, cleared, added up, compared
``banded``      band matrices, symmetric and general: factor and solve
``chebyshev``   charts: piecewise Chebyshev interpolants of three parameters
``dense``       small dense linear systems: Gaussian elimination
``elementary``  exponential and logarithm of several numbers side by side
``jit``         the one decorator of kernels
``power_flow``  which way power runs between two shafts, the efficiency in that direction
``profiles``    inputs that run straight within a step: values at its start, then rates
``quadrature``  Gauss-Legendre nodes and weights on [0, 1], frozen as constants for the kernels
``smoothing``   corners rounded to one continuous derivative; exact outside the rounded stretch
``spline``      weights that integrate a spline; the quintic through values, slopes, curvatures
``status``      numbers of the statuses that kernels return, equal to errors.Status
``step_size``   the step at which an error would be as large as it may be
==============  ===============================================================================
"""
