"""Compiled code of the oil sump.

============  ==============================================================
``step``      One step of the oil sump: the exact solution for constant heat
``exchange``  the same for model exchange: rates of the states
============  ==============================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.sump.kernels.step": (
        "thrustwasher.sump.kernels.exchange: start rates update slopes",
        "thrustwasher.sump.kernels.step.derive",
        "thrustwasher.sump.kernels.step.sens",
        "thrustwasher.sump.kernels.step.step",
    ),
}
