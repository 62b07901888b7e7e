"""Designs that are found: the best part, load curve or gear shift under limits, or a front.

====================  ==========================================================================
``design_problem``    What is varied, what is wanted, under which limits: from words to numbers
``designs``           What a search needs to know of what it varies
``part_designs``      A part at a point, and the folds of a washer's load curve
``scene_designs``     A gear shift
``local_search``      One search from one start: SLSQP with exact slopes, COBYQA without
``crew``              Work in pieces: from a journal, here, or on all cores
``front``             Which designs no other one beats, and where the next searches aim
``under_scatter``     Designs by the worst of a few draws of their scatter
``robustness``        The draws that decide, and the share of fresh ones that meet all limits
``optimum``           What was found, and its files
``whole_search``        The whole search: sample, local searches, the ends solved again
====================  ==========================================================================
"""
