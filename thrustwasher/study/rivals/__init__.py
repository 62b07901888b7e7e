"""Methods of others, to be measured beside the package's own.

====================  ===========================================================================
``compiled``          Compile rivals like the kernels, with a cache of their own
``plain2006``         The thrust washer by the method it was published with
``plain2006_fields``  Mesh, pressures and temperatures of the method of 2006
====================  ===========================================================================
"""
