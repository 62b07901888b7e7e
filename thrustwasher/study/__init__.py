"""How the package measures itself. Nothing but the command line imports it.

======================  ==========================================================================
``card_cases``          What cards are made for: parameter sets, the boxes of inputs, how many
                        held-out points
``card_writer``         Put a card together and write its file
``charts``              Error against cost: what is measured, and the pages drawn from it
``costs``               What a call of a rung costs: its compiled step
``error_tables``        A card's tables: worst and rms error cell by cell
``macro_steps``         Error of a shift against its cost
``own_cards``           Cards for a part of one's own, while one waits
``reference_cache``     Reference values at held-out points, kept in a file
``reference_clutch``    Reference values of the wet clutch: more rings, another integrator
``reference_gearmesh``  Reference values of the gear mesh: adaptive quadrature, search
``reference_values``    Reference values: what they are, and what a rung says beside them
``reference_washer``    Reference values of the washer: three fine meshes, extrapolated
``surroundings``        What a chart or a card says about its making: the machine, versions
``verify``              Write cards: each rung's error at held-out points, and its cost
======================  ==========================================================================
"""
