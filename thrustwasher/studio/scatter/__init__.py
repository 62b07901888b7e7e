"""Uncertainty of a figure: what the scatter of its inputs makes of it.

=======================  ======================================================================
``design``               which runs are made: scrambled Sobol' points, groups exchanged between them
``estimates``            quantiles, probabilities, Sobol' indices, each with its confidence
``evaluation``           from the numbers of all runs to the result
``linear``               the deviation by gradient, held against the sample
``propagate``            a whole study, from a part, a scene or a function to its result
``result``               what a study leaves: bands, indices, probabilities, files
``scene_sensitivities``  how figures of a gear shift follow numbers of its scene
``study``                the runs: in batches, on many cores or a cluster, resumable
``target``               what a study asks of an evaluator
=======================  ======================================================================
"""
