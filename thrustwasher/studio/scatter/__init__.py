"""Uncertainty of a figure: what the scatter of its inputs makes of it.

=======================  ======================================================================
``design``               which runs are made: scrambled Sobol' points, groups exchanged between them
``estimates``            quantiles, probabilities, Sobol' indices, each with its confidence
``evaluation``           from the numbers of all runs to the result
``linear``               the deviation by gradient, held against the sample
``function_target``      a Python function that is studied
``part_target``          a part that is studied
``propagate``            a whole study, from a part, a scene or a function to its result
``result``               what a study leaves: bands, indices, probabilities, files
``scene_figures``        what a study reads from a run of a scene
``scene_runs``           many runs of one scene: the loop, then its washers apart
``scene_sensitivities``  how figures of a gear shift follow numbers of its scene
``scene_target``         a gear shift that is studied
``study``                the runs: in batches, on many cores or a cluster, resumable
``target``               what a study needs to know of what it studies
=======================  ======================================================================
"""
