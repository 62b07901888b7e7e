"""The workshop, not in the wheel: how the package is measured, compiled, packed and drawn.

``python -m lab.NAME`` from the top of a checkout:

================  =======================================================================
``chart``         error against cost of every way to solve the models, drawn (``charts``)
``worst``         the longest step of an FMU (``realtime``)
``verify``        errors of the package's own parameter sets, for the verification tables it ships
``tables``        tables in README and docs
``places``        names of the places of parameters and outputs in the kernels
``structure``     what the rings hold, counted and drawn
``ship_all``      compiled files of all platforms (``ship``: those of the kernels)
``site.build``    the documentation as a site
``benchmarks.*``  speed, accuracy, robustness, hosts; where methods fail
================  =======================================================================

``jumps``, ``mesh_jumps`` and ``macro_steps`` are what pages and tests take of it.
"""
