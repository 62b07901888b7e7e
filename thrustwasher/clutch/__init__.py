"""The wet clutch: a pack of friction plates in oil.

================  =========================================================================
``parameters``    parameters; with ``interface.toml`` the one list all interfaces come from
``exchange``      what it shows for model exchange
``model``         its record: command, levels, sweeps
``solve``         boundary friction, and a pack that slips at a constant speed
``engagement``    load and slip are given over time, torque and heat follow
``kernels``       compiled code
``profile``       a pack along given profiles of load and slip, by its kernels
``run_out``       the slip of an inertia runs out under a given load
``release``       what a pack drags after it was let go: a cold release against a warm one
================  =========================================================================
"""
