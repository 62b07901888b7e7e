"""Parameters fitted to measurements, and what these tell of them: one method for all models.

===================  ===========================================================================
``least_squares``    what is fitted to what; several starts, bounds, profiles of one constant
``identifiability``  what the points tell about each constant
``fit``              a fit with values, intervals and verdicts
``estimates``        what comes out: numbers, sentences, plain data
``measured``         measured points of a model, checked
``model_fit``        parameters of any model that is solved at operating points
===================  ===========================================================================
"""
