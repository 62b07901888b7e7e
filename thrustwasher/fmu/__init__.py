"""FMUs: description, packing, documentation, the Python target, running them.

=================  ==============================================================================
``build``          From a model's list, binaries and documents to an FMU file
``description``    The model description of an FMU
``diagnosis``      What works on this machine, and why not: the first thing to read when an FMU
                   does not run
``documentation``  The page inside an FMU
``model_kernels``  Which models there are, their kernels, and the digest that ties an FMU to this
                   package
``package``        The files inside an FMU and their sources
``python``         FMUs that run in Python
``running``        Running a model: in this process, or an FMU
``shell``          The C files of a native FMU, and calling it
``stepper``        FMU instances that stay alive and are stepped, through FMPy
=================  ==============================================================================
"""
