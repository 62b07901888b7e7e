"""The gear mesh: loss and heat along the path of contact, or at its start as in the paper.

===================  ===============================================================================
``parameters``       a pair, its surfaces, oil, steel, laws; ``interface.toml``: inputs, outputs
``choices``          the words that parameters take
``model``            its record: command, levels, sweeps
``solve``            loss, heat, temperatures, contact, thermal stress, safety
``plausibility``     what to doubt: parameters that contradict each other, points below minimum
values
``exchange``         what it shows for model exchange
``kernels``          compiled code
``law_ranges``       the ranges of the mesh's empirical laws
``pair_rules``       rules between the parameters of a gear mesh, and how they say what to change
``parameter_array``  parameters of a gear mesh as numbers
===================  ===============================================================================
"""
