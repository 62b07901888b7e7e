"""Compiled code of the driveline losses.

================  ========================================================================
``loss_laws``     size of the torque of a rolling bearing, of a dipping gear, of a shaft seal
``skf_friction``  torque of a rolling bearing by SKF's model
``skf_series``    its constants by type and series
``exchange``      the same for model exchange: a bristle on each shaft
``step``          torques of all shafts, their powers and heat, how they change: exact; regimes
================  ========================================================================
"""

# What Python calls: module of the library -> functions, by their module.
CALLED = {
    "thrustwasher.losses.kernels.step": (
        "thrustwasher.losses.kernels.exchange: start rates update slopes",
        "thrustwasher.losses.kernels.loss_laws: bearing_drag churning_constants churning_drag",
        "thrustwasher.losses.kernels.loss_laws: seal_drag starved thinned",
        "thrustwasher.losses.kernels.skf_friction: skf_drag",
        "thrustwasher.losses.kernels.step: broken_rule derive sens step",
    ),
}
