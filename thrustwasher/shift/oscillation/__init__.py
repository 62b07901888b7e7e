"""Oscillations of a shift, and whether they are the driveline's or the master's.

=======================  ==========================================================================
``judder``               the shaft's oscillation: measured, and as the eigenvalue has it
``torsion``              the driveline's torsional mode: eigenvalues, slope of a pack's friction
``damped_oscillation``   fit of a growing or decaying oscillation
``chatter``              packs whose slip flips from step to step
=======================  ==========================================================================
"""
