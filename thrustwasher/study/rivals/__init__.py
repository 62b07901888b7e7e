"""Methods of others, to be measured beside the package's own.

====================  ===========================================================================
``cavitation``        Five methods to solve a cavitating film, on a small pad
``compiled``          Compile rivals like the kernels, with a cache of their own
``heat_loop``         A surface that its own oil heats: hotter oil is thinner and heats less
``lockup``            A clutch that locks: the least problem in which co-simulation goes wrong
``plain2006``         The thrust washer by the method it was published with
``plain2006_fields``  Mesh, pressures and temperatures of the method of 2006
``shaft``             An undamped shaft that swings for many steps, and who keeps its energy
====================  ===========================================================================
"""
