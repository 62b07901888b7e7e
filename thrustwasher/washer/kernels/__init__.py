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
``layout``                  Where the washer keeps its numbers: places in parameters, memory, work
                            and outputs
``lumped``                  The washer as a wedge with one film temperature: what `closed` and
                            `stribeck` have in common
``map``                     Compiled look-up in a washer's map
``newton``                  One Newton iteration for everything: positions, pressure, temperature;
                            by block elimination
``outputs``                 From a converged state to the numbers a user sees, and how they change
                            with it
``regime_and_status``       What every rung of the washer makes of parameters and inputs, and what
                            it says of its result
``simple``                  The rungs of the washer without a mesh, see washer_lumped: a step, and
                            its derivatives
``solve``                   One washer solve with memory: warm where it can be, on the branch that
                            the history asks for
``step``                    The washer behind the step ABI (see the package's docstring)
``transient``               Heat in time: what does not leave a body warms it, so that a lost film
                            takes its time
``wedge``                   The washer's film as a plain wedge: lift, shear and contact at one
                            least gap and one tilt
``workspace``               All that a washer is solved with, by name: the arrays of one washer,
                            and its work
==========================  ======================================================================
"""
