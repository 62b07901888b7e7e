"""Other methods for the same equations, written as plainly as their users write them.

They are here to be measured against: no solver of the package calls them. Each says what it keeps
of the original and what was set as favourably as can be.

===============  =================================================================================
``plain2006``    the washer as published in 2006: uniform mesh, over-relaxation, difference Newton
``cavitation``   five methods to solve a cavitating film, some of which lie
``lockup``       eight methods to step a clutch through lock-up, some of which lie
``shaft``        six methods to step a shaft that swings, most of which lose or make energy
``heat_loop``    four methods to find the temperature of a surface that its own oil heats
===============  =================================================================================
"""
