"""The planetary set with engine, vehicle, clutch and brake.

================  ==============================================================
``model``         its record
``parameters``    parameters, inputs and outputs: the one list of all interfaces
``vehicle``       a vehicle as inertia and load of the output
``closed_forms``  exact solutions that it is compared with
``kernels``       compiled code
================  ==============================================================
"""
