"""What pythonfmu loads; everything else is in the installed package."""

import ctypes

from thrustwasher.fmu.python.slave import Slave

# pythonfmu 0.7.0 drops one reference to this module's dict at every instantiation
ctypes.pythonapi.Py_IncRef(ctypes.py_object(globals()))


class OilSump(Slave):
    """Oil sump: temperature of the oil under the parts' heat, surroundings and a cooler."""

    model = "sump"
    version, digest, guid = "@VERSION@", "@DIGEST@", "@GUID@"  # filled in by the build
