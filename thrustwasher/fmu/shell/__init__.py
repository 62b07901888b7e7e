"""The C files of a native FMU, and calling it.

======================  =========================================================
``c_tables``            the tables of a model as C source, and part.bin
``call_table``          which FMI function may be called when
``c_sources``           the same in C99 for any compiler: the folder sources
``platform_libraries``  the C shell linked with kernels, one library per platform
======================  =========================================================
"""
