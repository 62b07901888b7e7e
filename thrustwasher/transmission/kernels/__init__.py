"""Compiled code of the planetary set.

==========================  =======================================================================
``layout``                  places in the arrays of a step
``dynamics``                torques and accelerations for given modes of clutch and brake
``thrust_bearings``         what the bearings of sun and ring take from their shafts
``planet_bearing``          where a planet settles on its needles; the couple left to the washers
``shaft_losses``            what losses from outside take from the shafts
``stick_slip``              which modes are consistent, and when they end
``integrate_step``          intervals of smooth motion between the instants where something changes
``piston``                  profiles of pressure, filling, lag, centrifugal head
``shift_figures``           what a finished shift is judged by: lock-up, jerk, flare, torque hole
``directional_derivative``  how the outputs change with the inputs: exact, modes as they are
``step``                    one co-simulation step: received torques in, speeds and loads out
==========================  =======================================================================
"""

# What Python calls: module of the library -> functions, by their module or full name; behind
# one of these its arrays of two dimensions.
CALLED = {
    "thrustwasher.transmission.kernels.step": (
        "thrustwasher.transmission.kernels.directional_derivative: directional_derivative",
        "thrustwasher.transmission.kernels.dynamics: broken_rule derive",
        "thrustwasher.transmission.kernels.shift_figures: comfort held_from shift_heat slip_end",
        "thrustwasher.transmission.kernels.shift_figures: standstill",
        "thrustwasher.transmission.kernels.step: step",
    ),
}
