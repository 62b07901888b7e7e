"""Compiled code of the gear mesh.

==========================  ======================================================================
``constants``               What the parameters of a gear mesh come to before any speed or torque
                            is known
``path_of_contact``         The path of contact: where the pairs touch, what each bears, what its
                            sliding costs and heats
``contact``                 Line contact of two flanks: Hertz, oil film, friction, thermal stress
                            and endurance
``path_friction``           Friction along the path of contact, and how it changes
``loss_heat``               The mesh heated by all of its loss
``operating_point``         The mesh at one operating point, with the heat of its loss or that of
                            the paper; safety against pitting, scuffing and micropitting
``step``                    One co-simulation step: it remembers the temperature of the bodies
``flank_temperature``       Temperature rises at a sliding line contact: friction on the flank,
                            shear of the oil film
``mesh_point``              The mesh at one operating point with the paper's heat
``line_of_action``          Rung `fine` with the paper's heat: resolved along the line of action
``directional_derivative``  How the outputs change with the inputs: exact, from the numbers of a
                            step
``layout``                  Where each number of the gear mesh lies in its arrays
==========================  ======================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.gearmesh.kernels.step": (
        "thrustwasher.gearmesh.kernels.constants.broken_rule",
        "thrustwasher.gearmesh.kernels.constants.derive",
        "thrustwasher.gearmesh.kernels.constants.effective_roughness",
        "thrustwasher.gearmesh.kernels.constants.least_teeth",
        "thrustwasher.gearmesh.kernels.constants.path_lengths",
        "thrustwasher.gearmesh.kernels.constants.path_of",
        "thrustwasher.gearmesh.kernels.constants.section",
        "thrustwasher.gearmesh.kernels.constants.slide_roll",
        "thrustwasher.gearmesh.kernels.constants.start_of_contact",
        "thrustwasher.gearmesh.kernels.flank_temperature.surface_temperature",
        "thrustwasher.gearmesh.kernels.line_of_action.place_mesh",
        "thrustwasher.gearmesh.kernels.mesh_point.mesh_point",
        "thrustwasher.gearmesh.kernels.operating_point.solve_point",
        "thrustwasher.gearmesh.kernels.step.sens",
        "thrustwasher.gearmesh.kernels.step.step",
    ),
}
