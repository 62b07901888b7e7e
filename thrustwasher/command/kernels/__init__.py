"""Compiled code of the command source.

========  ==================================================================================
``step``  The profile of a shift command: a ramp between two values, a function of time alone
========  ==================================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.command.kernels.step": (
        "thrustwasher.command.kernels.step.derive",
        "thrustwasher.command.kernels.step.step",
    ),
}
