"""The source of a shift command: a ramp over time.

==============  ===============================================================
``parameters``  the ramp as a part of its own, for systems that other tools run
``model``       its record
``kernels``     compiled code
==============  ===============================================================
"""
