"""The planetary set with engine, vehicle, clutch and brake.

================  =============================================================================
``closed_forms``  Exact solutions that the planetary set is compared with
``kernels``       Compiled code of the planetary set
``parameters``    Parameters, inputs and outputs of the shift transmission: the one list of all
                  interfaces
================  =============================================================================
"""
