"""What pythonfmu loads; everything else is in the installed package."""

import ctypes

from thrustwasher.fmu.python.slave import Slave

# pythonfmu 0.7.0 drops one reference to this module's dict at every instantiation
ctypes.pythonapi.Py_IncRef(ctypes.py_object(globals()))


class GearMesh(Slave):
    """One pair of involute gears: mesh loss, temperatures, stresses, safety factors."""

    model = "gearmesh"
    version, digest, guid = "@VERSION@", "@DIGEST@", "@GUID@"  # filled in by the build
