"""The errors of a level next to a reference: of the package's own parameters, your own and part.

======================  ========================================================================
``measure_errors``      Each level's error at random points: a table of a part
``cases``               What errors are measured for: parameters, boxes, random points
``costs``               What a call of a level costs: its compiled step
``measured_chart``      From answers at random points to the largest error region by region
``reference_cache``     Reference values at random points, kept in a file
``reference_clutch``    Reference values of the wet clutch: more rings, another integrator
``reference_gearmesh``  Reference values of the gear mesh: adaptive quadrature, search
``reference_values``    Reference values: what they are, and what a level computes for comparison
``reference_washer``    Reference values of the washer: three fine meshes, extrapolated
======================  ========================================================================
"""
