"""Parameters fitted to measurements, and what these tell of them: one method for all models.

A model whose law has a fit of its own hands down a class of ``ModelProblem`` (the clutch's law of
friction), and outputs that no solution at a point has as ``OwnOutputs`` (the washer's folds).

===================  ===========================================================================
``least_squares``    what is fitted to what; several starts, bounds, profiles of one constant
``identifiability``  what the points tell about each constant
``fit``              a fit with values, intervals and verdicts
``estimates``        what comes out: numbers, sentences, plain data
``measured``         measured points of a model, checked
``model_fit``        a model's outputs over its parameters, what it cannot follow, ``calibrate``
===================  ===========================================================================
"""
