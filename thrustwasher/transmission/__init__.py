"""The planetary set with engine, vehicle, clutch and brake.

================  ==============================================================
``parameters``    parameters, inputs and outputs: the one list of all interfaces
``vehicle``       a vehicle as inertia and load of the output
``mobility``      how slip and twist answer to torques
``kernels``       compiled code
================  ==============================================================
"""
