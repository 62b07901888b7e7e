"""Running a model: in this process, or an FMU.

===================  ======================================================================
``core``             one running model: arrays, checks, lazy outputs, steps
``direct_instance``  the kernels of a model stepped in this process
``loading``          unpack an FMU, load its library, instantiate it with its messages kept
``protocol``         the two FMI versions as one face
``snapshot``         the complete state of an instance, and its bytes
``warnings``         what a run is warned of, once
===================  ======================================================================
"""
