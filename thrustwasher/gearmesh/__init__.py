"""The gear mesh: loss and heat along the path of contact, or at its start as in the paper.

================  ===========================================================================
``parameters``    a pair, its surfaces, oil, steel, laws; ``interface.toml``: inputs, outputs
``model``         its record: command, rungs, sweeps
``solve``         loss, heat, temperatures, contact, thermal stress, safety
``plausibility``  what to doubt: parameters that contradict each other, points below least values
``kernels``       compiled code
================  ===========================================================================
"""
