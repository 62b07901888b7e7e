"""Designs that are found: the best part, load curve or gear shift under limits, or a front.

===================  ===========================================================================
``design_problem``   What is varied, what is requested, under which limits: from words to numbers
``designs``          What a search asks of an evaluator, and how much it does with it
``whole_search``     The whole search, from what is requested to the result
``archive``          All designs tried: costs, constraint violation, order
``multistart``       A sample of the box, local searches from its best, along a front
``local_search``     One search from one start: SLSQP with exact slopes, COBYQA without
``confirmation``     Designs that are shown, solved again on the finest means
``robust_search``    The scenarios that decide, the best design evaluated by fresh draws
``robustness``       The draws that decide, and the share of fresh ones that meet all limits
``under_scatter``    Designs by the worst of a few draws of their scatter
``worker_pool``      Work in pieces: from a journal, here, or on all cores
``front``            Which designs no other one beats, and where the next searches aim
``optimum``          What was found, and its files
===================  ===========================================================================
"""
