"""How right each rung of a model is, what it costs, and which one to take.

Used when solving: a rung is chosen by the cards.

======================  ==========================================================================
``models``              the models by name
``boxes``               boxes of inputs, and what is asked of one
``candidates``          rungs with fresh cards, what they promise, plans made of them
``choose``              ``choose``: the cheapest rung that holds a tolerance
``formats``             errors, times and shares as text
======================  ==========================================================================

Used to measure: nothing above imports it.

======================  ==========================================================================
``card_cases``          parameter sets, boxes and held-out points that cards are made for
``reference_values``    what a reference says, how it is extrapolated
``reference_washer``    reference values of the washer: fine meshes
``reference_clutch``    of the clutch: many rings, another integrator
``reference_gearmesh``  of the gear mesh: adaptive quadrature
``reference_cache``     reference values at held-out points, kept in files
``error_tables``        worst and rms error of a rung, cell by cell
``costs``               the clock, and what a call costs
``surroundings``        machine, versions and state of the sources
``card_writer``         cards put together and written
``verify``, ``stamp``   programs: make cards; tie them to kernels whose numbers are the same
``chart_cases``         operating points of the charts of error against cost
``methods``             rungs, meshes and rivals with one face, to be measured
``chart_series``        the series of the charts
``work_precision``      error and cost of all series
``pareto``              which of them nothing beats
``failure_cells``       what a method does at a hazard: right, slow, says so, lies
``failure_balance``     methods for the washer's balance
``failure_map``         all methods at all hazards
``coupling_limits``     steps at which coupled parts stop being stable
======================  ==========================================================================
"""
