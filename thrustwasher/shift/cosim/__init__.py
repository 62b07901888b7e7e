"""Co-simulation: connected instances and the loop over communication points.

===================  ==============================================================================
``system``           what is asked of an instance; instances with their present inputs and outputs
``schedule``         what is done in a communication step, in which order
``loop``             a run, its record, and the loop in Python
``recorded``         a part that plays what another run has recorded of it
``compiled_layout``  the same loop laid out for compiled code: operations, C addresses, buffers
``compiled_loop``    that code
===================  ==============================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.shift.cosim.compiled_loop": (
        "thrustwasher.shift.cosim.compiled_loop.run_operations operations rows recorded",
    ),
}
