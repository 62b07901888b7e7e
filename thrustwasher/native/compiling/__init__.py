"""Kernels to object files: where nothing is shipped, and to make what is. No run needs it else.

=============  ==========================================================================
``callbacks``  each entry as a C callback, which numba makes
``emit``       kernels to one module of LLVM
``lean``       what numba need not do where only the module of all functions is wanted
``lower``      that module to an object file for one platform and processor level
``gate``       what an object may need of the machine it runs on
``objects``    an object: shipped with the package, kept from an earlier run, or compiled
``portable``   the module for browsers as C, by wasm2c
=============  ==========================================================================
"""
