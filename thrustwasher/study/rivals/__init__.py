"""Methods of others, to be measured beside the package's own.

====================  ===========================================================================
``cavitation``        Five methods to solve a cavitating film, on a pad small enough to try them
                      all
``compiled``          Compile rivals like the kernels, with a cache of their own keyed by kernels
                      and rivals
``heat_loop``         A surface that its own oil heats: hotter oil is thinner and heats less
``lockup``            A clutch that locks: the least problem in which co-simulation goes wrong
``lockup_methods``    Methods for the clutch of ``lockup``: steps between communication points,
                      and general solvers
``plain2006``         The thrust washer by the method it was published with, to be measured
                      against
``plain2006_heat``    Settings and mesh of the method of 2006, and its temperatures of carrier,
                      washer and gear
``plain2006_kernel``  The washer solved as it was published, as compiled loops; see ``plain2006``
                      for the method
``shaft``             An undamped shaft that swings for many steps, and who keeps its energy
====================  ===========================================================================
"""
