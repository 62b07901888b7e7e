"""Compiled code of the gear mesh.

==========================  ======================================================================
``constants``               What the parameters of a gear mesh come to before any speed or torque
                            is known
``contact``                 Line contact of two flanks: Hertz, oil film, friction, thermal stress
                            and endurance
``directional_derivative``  How the outputs of the gear mesh change with its inputs: exact, from
                            the numbers of a step
``flank_temperature``       Temperature rises at a sliding line contact: friction on the flank,
                            shear of the oil film
``layout``                  Where each number of the gear mesh lies in its arrays
``line_of_action``          Rung `fine` of the gear mesh: resolved along the line of action
``mesh_point``              The mesh at one operating point: load, film, heat, stress
``step``                    One co-simulation step of the gear mesh: it follows its inputs at once
                            and remembers nothing
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
        "thrustwasher.gearmesh.kernels.constants.slide_roll",
        "thrustwasher.gearmesh.kernels.constants.start_of_contact",
        "thrustwasher.gearmesh.kernels.flank_temperature.surface_temperature",
        "thrustwasher.gearmesh.kernels.line_of_action.place_mesh",
        "thrustwasher.gearmesh.kernels.line_of_action.solve_mesh",
        "thrustwasher.gearmesh.kernels.mesh_point.mesh_point",
        "thrustwasher.gearmesh.kernels.step.sens",
        "thrustwasher.gearmesh.kernels.step.step",
    ),
}
