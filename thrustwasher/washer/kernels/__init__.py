"""Compiled code of the thrust washer.

==========================  ========================================================================
``layout``                  places in parameters, memory, work and outputs
``constants``               parameters by name, mesh, contact tables
``workspace``               the arrays of one washer, and its work, by name
``gap``                     film 1 and gap 2 at the nodes: gaps, contact pressures, viscosity
``film``                    average-flow Reynolds equation with cavitation
``throughflow``             oil that flows through film 1, and the heat it carries
``heat``                    heat balance of oil film, carrier, washer and gear
``heat_factor``             factor of the heat equations: a band over the columns, bordered by rings
``newton``                  positions and temperatures by block elimination, the film settled
``continuation``            walking along the curve of solutions: load over film thickness, folds
``branch``                  which of several solutions
``solve``                   one solve with memory: warm where it can be
``ladder``                  heat into and through the thickness of a body
``transient``               heat in time: what does not leave a body warms it
``outputs``                 the numbers a user sees, and how they change
``directional_derivative``  derivatives of the outputs, from the factored heat balance
``parameter_derivative``    the same over parameters
``regime_and_status``       rules between parameters, inputs that are bad, regime and status
``map``                     look-up in a map; as a model of its own
``whole_curve``             all solutions over load with the folds; solutions at many loads
``step``                    the washer behind the step ABI
``exchange``                the same for model exchange: a bristle, solutions kept from step to step
==========================  ========================================================================
"""

# What Python calls: module of the library -> functions, by their module or full name; behind
# one of these its arrays of two dimensions.
CALLED = {
    "thrustwasher.washer.kernels.step": (
        "thrustwasher.numerics.banded: _forth _reverse band_solve cholesky cholesky_solve_many",
        "thrustwasher.numerics.banded: factor_solve factor_solve_many halve lu mirror",
        "thrustwasher.numerics.dense: dense_factor dense_solve dense_substitute",
        "thrustwasher.tribology.asperities: contact_pressure",
        "thrustwasher.tribology.flow_factors: flow_conductance mean_gap shear_flow",
        "thrustwasher.tribology.lumped_body: exponential_weights",
        "thrustwasher.tribology.viscosity: viscosity",
        "thrustwasher.washer.kernels.constants: derive_grid",
        "thrustwasher.washer.kernels.continuation: enter_curve find_fold go_to_film locate_fold",
        "thrustwasher.washer.kernels.continuation: note recall remember start_at walk_to",
        "thrustwasher.washer.kernels.exchange.unit: start rates update finish slopes",
        "thrustwasher.washer.kernels.map.map_rows: map_tilts single_look_up",
        "thrustwasher.washer.kernels.map.map_search: map_covers",
        "thrustwasher.washer.kernels.map.map_step: look_up map_sens",
        "thrustwasher.washer.kernels.newton: evaluate_here newton smooth_film",
        "thrustwasher.washer.kernels.outputs: fill_fields outputs_at",
        "thrustwasher.washer.kernels.parameter_derivative: factor_for_parameters follow_parameter",
        "thrustwasher.washer.kernels.parameter_derivative: residuals_here",
        "thrustwasher.washer.kernels.regime_and_status: broken_rule",
        "thrustwasher.washer.kernels.solve: remember_state",
        "thrustwasher.washer.kernels.step: derive sens step",
        "thrustwasher.washer.kernels.whole_curve.over_loads: follow_loads",
        "thrustwasher.washer.kernels.whole_curve.points: follow_curve name_branches",
        "thrustwasher.washer.kernels.map.map_rows.look_up_rows rows out found",
        "thrustwasher.washer.kernels.map.map_rows.map_folds folds",
        "thrustwasher.washer.kernels.step.step_rows inputs out whole",
    ),
    "thrustwasher.washer.kernels.map.alone": (
        "thrustwasher.washer.kernels.map.alone: derive sens step",
    ),
}
