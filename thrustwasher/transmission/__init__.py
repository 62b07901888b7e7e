"""The planetary set with engine, vehicle, clutch and brake.

================  ==============================================================
``parameters``    parameters, inputs and outputs: the one list of all interfaces
``bearings``      thrust bearings of sun and ring: parameters and rules
``vehicle``       a vehicle as inertia and load of the output
``mobility``      how slip and twist answer to torques
``kernels``       compiled code
================  ==============================================================
"""
