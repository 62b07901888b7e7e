"""Measurements of others against what the models say, blind and after a fit.

===================  ===============================================================
``data_set_file``    a data set's folder: source, conditions, points, what stands for it
``comparison``       computed against measured: deviations, band of the scatter, fit
``collection_page``  the page of all measured data sets
===================  ===============================================================
"""
