"""Parameters fitted to measurements, and what these tell of them: one method for all models.

A fit is a ``FitProblem``: what rows of an evaluator give, over the constants, less what was
measured. A law of a model's own, which has outputs that no solution at a point has, is computed
here (the clutch's law of friction); other such outputs the model's record computes (the washer's
folds).

===================  ===========================================================================
``least_squares``    what is fitted to what; several starts, bounds, profiles of one constant
``identifiability``  what the points tell about each constant
``fit``              a fit with values, intervals and verdicts
``estimates``        what comes out: numbers, sentences, plain data
``measured``         measured points of a model, checked
``model_fit``        rows of a model fitted to its outputs, what it cannot follow
``friction``         the clutch's friction law instead of a model's outputs
``traces``           recordings over time: what all models share
``engagement``       a pack stepped along recordings, ``calibrate_traces``
``run_calibration``  ``calibrate``
``row_groups``       rows of a long recording that say the same
``signs``            friction measured on a test rig that turns both ways
===================  ===========================================================================
"""
