"""The friction law fitted to measurements, and what they tell of it.

======================  ==================================================================
``calibration``         what is asked, checked; the fit and what the points tell of it
``calibration_result``  what comes out: numbers, sentences, plain data
``friction_law``        the law as a function of its own constants, with exact derivatives
``least_squares``       several starts, bounds, profiles of one constant
``identifiability``     what the points tell about each constant, and whether load acts
``data_warnings``       points that the law cannot follow, in plain sentences
======================  ==================================================================
"""
