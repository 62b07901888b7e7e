"""How the package measures itself. Nothing but the command line imports it.

======================  ==========================================================================
``cases``               What errors are measured for: parameter sets, boxes, random points
``charts``              Error against cost: what is measured, and the pages drawn from it
``costs``               What a call of a rung costs: its compiled step
``macro_steps``         Error of a shift against its cost
``measured_chart``      From answers at random points to the largest error region by region
``realtime``           How long the longest step of an FMU takes, and what bounds it
``reference_cache``     Reference values at random points, kept in a file
``reference_clutch``    Reference values of the wet clutch: more rings, another integrator
``reference_gearmesh``  Reference values of the gear mesh: adaptive quadrature, search
``reference_values``    Reference values: what they are, and what a rung says beside them
``reference_washer``    Reference values of the washer: three fine meshes, extrapolated
``surroundings``        What a chart or a table says about its making: the machine, versions
``verify``              Measure each rung's error at random points and write the tables
======================  ==========================================================================
"""
