"""Compiled code of the thrust washer.

==========================  ======================================================================
``branch``                  Which of several solutions: the film branch up to its fold, the
                            contact branch beyond it
``constants``               The washer's constants for the kernels: parameters by name, mesh,
                            contact tables
``continuation``            Walking along the curve of solutions at fixed speed, tilt and oil:
                            load over film thickness
``directional_derivative``  Directional derivatives of the washer's outputs, from the factored
                            heat balance
``film``                    Average-flow Reynolds equation with cavitation: conductances,
                            residual, linear system
``gap``                     Film 1 and gap 2 at the nodes: gaps, contact pressures, viscosity, and
                            what they balance
``heat``                    Heat balance of carrier, washer and gear: residual, matrix, slopes
                            over the positions
``jacobian``                Jacobian at a solution: of the heat balance and of the forces, over
                            everything they depend on
``ladder``                  Heat into and through the thickness of a body: a ladder of first-order
                            terms per node
``layout``                  Where the washer keeps its numbers: places in parameters, memory, work
                            and outputs
``map``                     Compiled look-up in a washer's map
``newton``                  One Newton iteration for everything: positions, pressure, temperature;
                            by block elimination
``outputs``                 From a converged state to the numbers a user sees, and how they change
                            with it
``regime_and_status``       What every rung of the washer makes of parameters and inputs, and what
                            it says of its result
``solve``                   One washer solve with memory: warm where it can be, on the branch that
                            the history asks for
``step``                    The washer behind the step ABI (see the package's docstring)
``transient``               Heat in time: what does not leave a body warms it, so that a lost film
                            takes its time
``workspace``               All that a washer is solved with, by name: the arrays of one washer,
                            and its work
==========================  ======================================================================
"""

# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "thrustwasher.washer.kernels.step": (
        "thrustwasher.numerics.banded._forth",
        "thrustwasher.numerics.banded._reverse",
        "thrustwasher.numerics.banded.band_solve",
        "thrustwasher.numerics.banded.cholesky",
        "thrustwasher.numerics.banded.cholesky_solve_many",
        "thrustwasher.numerics.banded.factor_solve",
        "thrustwasher.numerics.banded.factor_solve_many",
        "thrustwasher.numerics.banded.halve",
        "thrustwasher.numerics.banded.lu",
        "thrustwasher.numerics.banded.mirror",
        "thrustwasher.numerics.dense.dense_factor",
        "thrustwasher.numerics.dense.dense_solve",
        "thrustwasher.numerics.dense.dense_substitute",
        "thrustwasher.tribology.asperities.contact_pressure",
        "thrustwasher.tribology.flow_factors.flow_conductance",
        "thrustwasher.tribology.flow_factors.mean_gap",
        "thrustwasher.tribology.flow_factors.shear_flow",
        "thrustwasher.tribology.lumped_body.exponential_weights",
        "thrustwasher.tribology.viscosity.viscosity",
        "thrustwasher.washer.kernels.constants.derive_grid",
        "thrustwasher.washer.kernels.continuation.enter_curve",
        "thrustwasher.washer.kernels.continuation.find_fold",
        "thrustwasher.washer.kernels.continuation.recall",
        "thrustwasher.washer.kernels.continuation.remember",
        "thrustwasher.washer.kernels.continuation.walk_to",
        "thrustwasher.washer.kernels.map.map_rows.look_up_rows rows out found",
        "thrustwasher.washer.kernels.map.map_rows.map_folds folds",
        "thrustwasher.washer.kernels.map.map_rows.map_tilts",
        "thrustwasher.washer.kernels.map.map_rows.single_look_up",
        "thrustwasher.washer.kernels.map.map_search.map_covers",
        "thrustwasher.washer.kernels.map.map_step.look_up",
        "thrustwasher.washer.kernels.map.map_step.map_sens",
        "thrustwasher.washer.kernels.newton.evaluate_here",
        "thrustwasher.washer.kernels.newton.newton",
        "thrustwasher.washer.kernels.outputs.outputs_at",
        "thrustwasher.washer.kernels.regime_and_status.broken_rule",
        "thrustwasher.washer.kernels.solve.remember_state",
        "thrustwasher.washer.kernels.step.derive",
        "thrustwasher.washer.kernels.step.sens",
        "thrustwasher.washer.kernels.step.step",
    ),
}
