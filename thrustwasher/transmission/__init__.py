"""The planetary set with engine, vehicle, clutch and brake.

================  ==============================================================
``parameters``    parameters; with ``signals`` the one list of all interfaces
``model``         its record
``signals``       inputs, outputs and plugs
``bearings``      thrust bearings of sun and ring: parameters and rules
``vehicle``       a vehicle as inertia and load of the output
``mobility``      how slip and twist answer to torques
``kernels``       compiled code
================  ==============================================================
"""
