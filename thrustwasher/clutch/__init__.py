"""The wet clutch: a pack of friction plates in oil.

================  =========================================================================
``parameters``    parameters; with ``interface.toml`` the one list all interfaces come from
``model``         its record: command, rungs, sweeps
``solve``         boundary friction, and a pack that slips at a constant speed
``engagement``    load and slip are given over time, torque and heat follow
``calibration``   the friction law fitted to measurements, and what they tell of it
``kernels``       compiled code
================  =========================================================================
"""
