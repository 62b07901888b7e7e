"""Compiled code of the planetary set.

==========================  ======================================================================
``directional_derivative``  How the outputs of the shift transmission change with its inputs:
                            exact, modes as they are
``dynamics``                Dynamics of the planetary set: torques and accelerations for given
                            modes of clutch and brake
``integrate_step``          The course of one step: stretches of smooth motion between the
                            instants where something changes
``layout``                  Where every number of the shift transmission lies in the arrays of its
                            step
``piston``                  The pistons that press the packs: courses of pressure, filling, lag,
                            centrifugal head
``step``                    One co-simulation step of the shift transmission: received torques in,
                            speeds and loads out
``stick_slip``              Stick and slip of two packs: which modes are consistent, and when they
                            end
==========================  ======================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.transmission.kernels.step": (
        "thrustwasher.transmission.kernels.directional_derivative.directional_derivative",
        "thrustwasher.transmission.kernels.dynamics.broken_rule",
        "thrustwasher.transmission.kernels.dynamics.derive",
        "thrustwasher.transmission.kernels.step.step",
    ),
}
