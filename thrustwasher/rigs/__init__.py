"""Measurements of others beside what the models say, blind and after a fit.

==================  ==============================================================
``rig_file``        a rig's folder: source, conditions, part or scene, points
``rig_comparison``  computed beside measured: deviations, band of the scatter, fit
``shelf_page``      the page of all rigs
==================  ==============================================================
"""
