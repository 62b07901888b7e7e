"""The one compilation: kernels become machine code that Python, the command line and FMUs share.

``entries``      which kernel functions can be called from outside
``signatures``   what such a function takes and returns, read off its annotations
``code``         what a source says once it is parsed: without comments and docstrings
``digest``       the name of a compilation: a digest of the code it is made from
``targets``      the platforms and levels, how hard the compiler works
``compiling``    where nothing is shipped: kernels to object files, by numba and LLVM
``binaries``     what objects and libraries need and show; a finished library is checked
``shipped``      the compiled files inside the package; ``lab.ship`` in the checkout makes them
``kept``         where compiled code is kept from an earlier run
``link``         C files and objects to a shared library; which platform this machine is
``library``      the library of this machine that Python loads
``load``         a kernel function of that library as a Python function
``mathematics``  the mathematical functions that kernels call: musl's
``files``        files written at once, in folders that are the user's alone
``drafts``       files and folders on their way: locked, flushed, those of dead processes removed
``ownership``    who could change a folder
"""
