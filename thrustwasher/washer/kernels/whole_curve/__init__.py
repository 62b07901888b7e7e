"""The whole curve of a washer's solutions, as Python and the pages ask for it.

==============  =================================================================================
``points``      the curve point by point with its folds, and the branches of its points
``node_store``  solutions on the curve that are kept, and guesses made of them
``over_loads``  solutions at given rising loads, on both ways of the load
==============  =================================================================================
"""
