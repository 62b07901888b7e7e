"""The one compilation: kernels become machine code that Python, the command line and FMUs share.

``entries``      which kernel functions can be called from outside, and with what
``digest``       the name of a compilation: a digest of the sources it is made from
``callbacks``    each entry as a C callback, which numba makes
``emit``         kernels to one module of LLVM; ``lean`` leaves out what it does not use
``lower``        that module to an object file for one platform and processor level
``gate``         what an object may need of the machine it runs on
``binaries``     what objects and libraries need and show; a finished library is checked
``targets``      the platforms and levels
``objects``      an object: shipped with the package, kept from an earlier run, or compiled
``shipped``      the compiled files inside the package; ``lab.ship`` in the checkout makes them
``link``         C files and objects to a shared library; which platform this machine is
``files``        files written at once, in folders that are the user's alone
``drafts``       files and folders on their way: locked, flushed, those of dead processes removed
``ownership``    who could change a folder
``library``      the library of this machine that Python loads
``load``         a kernel function of that library as a Python function
``lean``         what numba need not do where only the module of all functions is wanted
``mathematics``  the mathematical functions that kernels call: musl's
``portable``     A kernel module as C for any compiler: its module of WebAssembly
===============  ================================================================================
=======
=============  ==========================================================================
``entries``    which kernel functions can be called from outside, and with what
``digest``     the name of a compilation: a digest of the sources it is made from
``binaries``   what objects and libraries need and show; a finished library is checked
``targets``    the platforms and levels
``shipped``    the compiled files inside the package; ``lab.ship`` in the checkout makes them
``kept``       where compiled code is kept from an earlier run
``compiling``  where nothing is shipped: kernels to object files, by numba and LLVM
``link``       C files and objects to a shared library; which platform this machine is
``files``      files written at once, in folders that are the user's alone
``drafts``     files and folders on their way: locked, flushed, those of dead processes removed
``ownership``  who could change a folder
``library``    the library of this machine that Python loads
``load``       a kernel function of that library as a Python function
=============  ==========================================================================
"""
