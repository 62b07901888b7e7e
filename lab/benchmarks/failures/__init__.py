"""Where methods fail, and the limits of coupling: measured by ``lab.benchmarks.same_everywhere``.

Methods of the trade, small ones written for this, and the package's own meet hazards. The method of
the washer's paper is charted as well, by ``lab/benchmarks/chart_2006.py``.

====================  =============================================================================
``cavitation``        Five methods to solve a cavitating film, on a small pad
``compiled``          Compile rivals like the kernels, with a cache of their own
``coupling_limits``   Steps and slopes at which a loop of two parts stops being stable
``failure_cells``     Cells of the stability map: what one method does at one hazard, measured
``failure_map``       The failure map: each method meets each hazard, and what comes out is judged
``failure_masters``   Where the package's own masters fail
``failure_washer``    Where methods fail on the washer's equations: its balance, closed forms
``heat_loop``         A surface that its own oil heats: hotter oil is thinner and heats less
``lockup``            A clutch that locks: the minimum problem in which co-simulation goes wrong
``plain2006``         The thrust washer by the method it was published with
``plain2006_fields``  Mesh, pressures and temperatures of the method of 2006
``shaft``             An undamped shaft that swings for many steps, and who keeps its energy
====================  =============================================================================
"""
