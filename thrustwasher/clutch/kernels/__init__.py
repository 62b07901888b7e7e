"""Compiled code of the wet clutch.

==========================  =====================================================================
``layout``                  places in the arrays of parameters, state and work
``constants``               constants of a pack behind its parameters, and rules between these
``pack_friction``           boundary friction of the asperities and shear of the oil between them
``rates``                   how fast film and heat of an engaging pack change, with slopes
``rosenbrock``              film, heat and energy over an interval of time, implicitly
``rosenbrock_derivatives``  how they change with the inputs at the end of an interval
``advance``                 a pack's memory and its way along an interval of time
``pack_outputs``            the outputs at a point in time, with slopes
``coupling``                a pack in a driveline that it does not know: its torque, its heat
``exchange``                a pack for model exchange: rates of film, heat and a bristle
``steady``                  a pack that slips for ever: the temperature where cooling wins
``directional_derivative``  how the outputs change with the inputs: exact, film and heat held
``step``                    one co-simulation step
==========================  =====================================================================
"""

# What Python calls: module of the library -> functions, by their module or full name; behind
# one of these its arrays of two dimensions.
CALLED = {
    "thrustwasher.clutch.kernels.step": (
        "thrustwasher.clutch.kernels.advance: advance load_memory settle_film",
        "thrustwasher.clutch.kernels.pack_friction: friction ploughing coefficient_slopes",
        "thrustwasher.clutch.kernels.pack_friction: contact_share load_share settled_slope",
        "thrustwasher.clutch.kernels.pack_friction: shear_slopes temperature_factor viscous_slopes",
        "thrustwasher.clutch.kernels.exchange: start rates update slopes",
        "thrustwasher.clutch.kernels.constants: broken_rule derive derive_rings",
        "thrustwasher.clutch.kernels.directional_derivative: directional_derivative",
        "thrustwasher.clutch.kernels.pack_outputs: fill_outputs mean_surface ring_outputs",
        "thrustwasher.clutch.kernels.pack_outputs: stored_heat",
        "thrustwasher.clutch.kernels.rates: pack_rates",
        "thrustwasher.clutch.kernels.steady: steady_pack steady_row",
        "thrustwasher.clutch.kernels.steady.steady_rows inputs out",
        "thrustwasher.clutch.kernels.step: step",
    ),
}
