"""The clutch's friction law, fitted by the method that all models share: what is its own.

================  ==============================================================================
``friction_law``  the law over its constants: values, derivatives, what is fitted to the points
``friction_fit``  what the fit says: ends of the curve, whether load acts, warnings
``reach``         warnings of points that no constants of the law can follow
================  ==============================================================================
"""
