"""Compiled look-up in a washer's map.

==============  =================================================================================
``alone``       The washer that only looks up, behind the step ABI, without a solver
``map_layout``  How a washer's map lies in memory: one array of floats, header first, then a line
                per node
``map_point``   The washer's outputs where a look-up has found its point, and their derivatives
``map_rows``    Look-ups for Python: one number, many rows, and the folds of a curve
``map_search``  Looking a washer up: from load, speed, tilt and oil temperature to a point on the
                map's curve
``map_step``    One step of a washer through its map: which branch, where on it, what comes out
==============  =================================================================================
"""
