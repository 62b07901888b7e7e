"""The C files of a native FMU, and calling it.

======================  =========================================================================
``c_tables``            The tables of a model as C source: everything the shell knows about it
``call_table``          Which FMI function may be called when: one table, as data
``platform_libraries``  The shared libraries inside native FMUs: the C shell linked with kernels,
                        one per platform
======================  =========================================================================
"""
