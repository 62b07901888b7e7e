"""Compiled code of the gear mesh.

==========================  ========================================================================
``layout``                  places in the arrays
``constants``               what the parameters come to before any speed or torque is known
``working_pair``            distance of the axes, pressure angle, tips of gears with profile shift
``tooth_root``              bending stress at the root of the teeth
``path_of_contact``         where the pairs touch, what each bears, what its sliding costs and heats
``load_sharing``            load shared by the stiffness of the pairs in contact, tip relief
``contact``                 line contact: Hertz, oil film, friction, thermal stress, endurance
``flank_temperature``       rises at a sliding line contact: friction, shear of the oil film
``path_friction``           friction along the path of contact, and how it changes
``micropitting``            film along the path by the standard against micropitting
``loss_heat``               the mesh heated by all of its loss
``mesh_point``              the mesh at one operating point with the paper's heat
``line_of_action``          level `fine` with the paper's heat: resolved along the line of action
``directional_derivative``  how the outputs change with the inputs: exact
``operating_point``         heat of the loss or of the paper; pitting, scuffing, micropitting
``step``                    one co-simulation step: it remembers the temperature of the bodies
``exchange``                the same for model exchange: rates of the bodies' heat and a bristle
==========================  ========================================================================
"""

# What Python calls: module of the library -> functions, by their module or full name; behind
# one of these its arrays of two dimensions.
CALLED = {
    "thrustwasher.gearmesh.kernels.step": (
        "thrustwasher.gearmesh.kernels.constants: broken_rule derive effective_roughness",
        "thrustwasher.gearmesh.kernels.constants: least_teeth path_lengths path_of",
        "thrustwasher.gearmesh.kernels.constants: slide_roll start_of_contact",
        "thrustwasher.gearmesh.kernels.exchange: start rates update slopes",
        "thrustwasher.gearmesh.kernels.flank_temperature: heated_flank",
        "thrustwasher.gearmesh.kernels.line_of_action: place_mesh",
        "thrustwasher.gearmesh.kernels.load_sharing: pitch_of share_load single_stiffness",
        "thrustwasher.gearmesh.kernels.path_of_contact: derive_path",
        "thrustwasher.gearmesh.kernels.mesh_point: mesh_point",
        "thrustwasher.gearmesh.kernels.micropitting: buttress film_constant film_ratio_at",
        "thrustwasher.gearmesh.kernels.micropitting: local_film",
        "thrustwasher.gearmesh.kernels.operating_point: solve_point",
        "thrustwasher.gearmesh.kernels.step: sens step",
        "thrustwasher.gearmesh.kernels.tooth_root: corner_left root_factors root_section",
        "thrustwasher.gearmesh.kernels.working_pair: distance_of_shifts gear_shift is_standard",
        "thrustwasher.gearmesh.kernels.working_pair: section tip_thickness tips working_section",
        "thrustwasher.gearmesh.kernels.step.step_rows inputs out whole",
    ),
}
