"""Compiled code of the gear train.

================  ========================================================================
``layout``        places in the arrays
``tooth_forces``  forces of teeth in space, what two bearings make of them by statics
``bearing_life``  induced axial force, equivalent load, basic rating life of a rolling bearing
``chain``         torques from shaft to shaft until losses and forces agree
``step``          one co-simulation step: it remembers the bodies of the meshes
``exchange``      the same for model exchange: rates of the bodies' heat and a bristle
================  ========================================================================
"""

# What Python calls: module of the library -> functions, by their module.
CALLED = {
    "thrustwasher.train.kernels.step": (
        "thrustwasher.train.kernels.bearing_life: equivalent_load rating_life",
        "thrustwasher.train.kernels.bearing_life: induced_share shared_thrust",
        "thrustwasher.train.kernels.exchange: start rates update slopes",
        "thrustwasher.train.kernels.step: broken_rule derive step",
        "thrustwasher.train.kernels.tooth_forces: support",
    ),
}
