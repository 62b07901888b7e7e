"""The source of a shift command: a ramp over time.

==============  ===============================================================
``model``       its record
``parameters``  the ramp as a part of its own, for systems that other tools run
``kernels``     compiled code
==============  ===============================================================
"""
