"""FMUs: description, packing, documentation, the Python target, running them.

=================  =======================================================================
``build``          from a model's list, binaries and documents to an FMU file
``description``    the model description
``diagnosis``      what works on this machine, and why not
``documentation``  the page inside an FMU
``fmu_cache``      FMUs built when needed, in the user's cache
``model_kernels``  the kernels of a model, and the digest that ties an FMU to this package
``package``        the files inside an FMU and their sources
``packages``       which packages are here, and the versions of each that were tried
``python``         FMUs that run in Python
``running``        running a model: in this process, or an FMU
``shell``          the C files of a native FMU, and calling it
``stepper``        FMU instances that stay alive and are stepped, through FMPy
=================  =======================================================================
"""
