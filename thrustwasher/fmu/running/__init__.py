"""Running a model: in this process, or an FMU.

===================  =============================================================================
``core``             One running model: arrays, checks, lazy outputs, steps; knows no protocol and
                     no FMU
``direct_instance``  The kernels of a model stepped in this process: the same face as an FMU
                     instance, without FMU
``loading``          Unpack an FMU once, load its library once, instantiate it with its messages
                     kept
``protocol``         The two FMI versions as one face: how values travel, what a step is, at which
                     addresses
``snapshot``         The complete state of an instance, and its bytes: checked in full before
                     anything is used
===================  =============================================================================
"""
