"""The friction law, fitted by the method that all models share: what is its own.

================  ==============================================================================
``friction_law``  the law over its constants: values, derivatives, shear of the settled film
``friction_fit``  its constants as parameters of a fit: starts, ends of the curve, test of load
``reach``         warnings of points that no constants of the law can follow
================  ==============================================================================
"""
