"""How the package measures itself. Nothing but the command line imports it.

======================  ==========================================================================
``card_cases``          What cards are made for: parameter sets, the boxes of inputs, how many
                        held-out points
``card_writer``         Put a card together and write its file
``charts``              Error against cost: what is measured, and the pages drawn from it
``costs``               What a call of a rung costs: its compiled step, inputs moving a little
                        from call to call
``error_tables``        From answers at held-out points to a card's tables: worst and rms error
                        cell by cell
``failures``            Where methods fail, and the limits of co-simulation
``macro_steps``         Error of a shift against its cost, and where masters fail: over step,
                        master, coupling and rung
``reference_cache``     Reference values at held-out points, kept in a file: all rungs are
                        compared with the same
``reference_clutch``    Reference values of the wet clutch: more rings, another integrator at
                        tight tolerance
``reference_gearmesh``  Reference values of the gear mesh: the line of action by adaptive
                        quadrature and search
``reference_values``    Reference values: what they are, at held-out points too, and what a rung
                        says beside them
``reference_washer``    Reference values of the washer: three fine meshes of one family,
                        extrapolated
``rivals``              Methods of others, to be measured beside the package's own
``stamp``               Tie cards to the kernels as they are now: ``python -m
                        thrustwasher.study.stamp``
``surroundings``        What a chart or a card says about its making: the machine, versions, state
                        of the sources
``verify``              Write cards: each rung's error at random held-out points against a
                        reference, and its cost
======================  ==========================================================================
"""
