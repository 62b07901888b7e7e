"""Pictures of one model.

=================  ===============================================================================
``clutch_plot``    A wet pack: friction against slip with its shares, and an engagement over time
``fit_plot``       A calibration: measured points, the fitted law with its confidence band,
                   residuals
``gearmesh_plot``  Temperatures of a gear mesh and what they leave of its endurance, against tooth
                   number
``washer_plots``   The washer: maps over its annulus, and its load curve with the folds
=================  ===============================================================================
"""
