"""Compiled code of the wet clutch.

==========================  ======================================================================
``advance``                 A pack's memory and its way along a stretch of time over which the
                            inputs run straight
``boundary_friction``       Boundary friction of a lining: adhesion and ploughing of asperities,
                            Wang, Wei & Wu (2012)
``constants``               Constants of a pack behind its parameters, and rules between these
``directional_derivative``  How the outputs of the wet clutch change with its inputs: exact, film
                            and heat held
``layout``                  Where the wet clutch keeps its numbers: places in the arrays of
                            parameters, state and work
``pack_friction``           What resists in a pack: boundary friction of the asperities and shear
                            of the oil between them
``pack_outputs``            The outputs of a pack at a point in time, with slopes
``rates``                   How fast film and heat of an engaging pack change, with slopes for an
                            implicit step
``rosenbrock``              Film, heat and energy of an engaging pack over a stretch of time,
                            implicitly, error controlled
``rosenbrock_derivatives``  How film and heat at the end of a stretch change with the inputs there
``steady``                  A pack that slips at constant load and speed for ever: the temperature
                            where cooling wins
``step``                    One co-simulation step of the wet clutch: film, heat and friction of
                            the pack
==========================  ======================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.clutch.kernels.step": (
        "thrustwasher.clutch.kernels.advance.advance",
        "thrustwasher.clutch.kernels.advance.load_memory",
        "thrustwasher.clutch.kernels.advance.settle_film",
        "thrustwasher.clutch.kernels.pack_friction.friction",
        "thrustwasher.clutch.kernels.pack_friction.ploughing",
        "thrustwasher.clutch.kernels.constants.broken_rule",
        "thrustwasher.clutch.kernels.constants.derive",
        "thrustwasher.clutch.kernels.constants.derive_rings",
        "thrustwasher.clutch.kernels.directional_derivative.directional_derivative",
        "thrustwasher.clutch.kernels.pack_friction.coefficient_slopes",
        "thrustwasher.clutch.kernels.pack_friction.contact_share",
        "thrustwasher.clutch.kernels.pack_friction.load_share",
        "thrustwasher.clutch.kernels.pack_friction.settled_slope",
        "thrustwasher.clutch.kernels.pack_friction.shear_slopes",
        "thrustwasher.clutch.kernels.pack_friction.viscous_slopes",
        "thrustwasher.clutch.kernels.pack_outputs.fill_outputs",
        "thrustwasher.clutch.kernels.pack_outputs.mean_surface",
        "thrustwasher.clutch.kernels.pack_outputs.ring_outputs",
        "thrustwasher.clutch.kernels.pack_outputs.stored_heat",
        "thrustwasher.clutch.kernels.rates.pack_rates",
        "thrustwasher.clutch.kernels.steady.steady_cooling",
        "thrustwasher.clutch.kernels.steady.steady_temperature",
        "thrustwasher.clutch.kernels.steady.steady_torques",
        "thrustwasher.clutch.kernels.step.step",
    ),
}
