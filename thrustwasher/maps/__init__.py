"""The washer's map: charts of solutions for look-up.

======  ====================================================================
plan    what a map covers and how finely: box, patches, pieces; its header
line    one line: the curve of solutions at a speed, tilt and oil temperature
build   from parameters to a map file
check   a map against solutions at random points of its box
======  ====================================================================
"""
