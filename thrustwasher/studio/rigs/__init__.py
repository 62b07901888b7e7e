"""Measurements of others against what the models say, blind and after a fit.

==================  ==============================================================
``rig_file``        a data set's folder: source, conditions, part or scene, points
``rig_comparison``  computed against measured: deviations, band of the scatter, fit
``shelf_page``      the page of all measured data sets
==================  ==============================================================
"""
