"""The source of a shift command: a ramp over time.

==============  ==============================================================================
``kernels``     Compiled code of the command source
``parameters``  Parameters and outputs of the command source: the ramp of a shift command as a
                part of its own
==============  ==============================================================================
"""
