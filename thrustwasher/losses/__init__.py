"""Losses of a drivetrain that are there without sliding teeth: bearings, churning, pump, seals.

===============  ==============================================================================
``parameters``   bearings, churning gears, seals, pump, oil; ``interface.toml``: inputs, outputs
``model``        its record
``solve``        torques, powers and heat at one operating point
``kernels``      compiled code
``loss_ranges``  the ranges of the empirical laws of churning, bearings and seals
===============  ==============================================================================
"""
