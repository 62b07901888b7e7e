"""The wet clutch: a pack of friction plates in oil.

================  ==============================================================================
``calibration``   The friction law fitted to measurements, and what they tell of it
``closed_forms``  Exact solutions that the clutch is compared with
``engagement``    An engagement of the wet clutch over time: load and slip are given, torque and
                  heat follow
``kernels``       Compiled code of the wet clutch
``parameters``    Parameters, inputs and outputs of the wet clutch: the one list all interfaces
                  come from
``solve``         Wet clutch: coefficient of boundary friction, and a pack that slips at a
                  constant speed
================  ==============================================================================
"""
