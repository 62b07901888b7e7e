"""The oil sump: what the parts' heat does to the temperature of their oil.

==============  ===============================================================
``parameters``  parameters, inputs and outputs: the one list of all interfaces
``model``       its record
``kernels``     compiled code
==============  ===============================================================
"""
