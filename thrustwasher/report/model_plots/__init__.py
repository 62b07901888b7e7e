"""Pictures of one model.

=================  =====================================================================
``clutch_plot``    a wet pack: friction against slip, an engagement over time
``fit_plot``       a calibration: measured values, the fit with its confidence band, residuals
``gearmesh_plot``  temperatures of a gear mesh and what they leave of its endurance
``washer_plots``   the washer: maps over its annulus, its load curve with the folds
=================  =====================================================================
"""
