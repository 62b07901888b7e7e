"""FMUs that run in Python.

===================  ===========================================================================
``python_contents``  What only the Python target carries: pythonfmu's libraries and modules, and
                     the slave
``slave``            The slave of every Python FMU: the protocol of pythonfmu 0.7.0 around
                     ``Core``
===================  ===========================================================================
"""
