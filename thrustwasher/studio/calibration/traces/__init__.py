"""Parameters fitted to recordings over time: what all models share.

A model hands over what steps it along a recording (the clutch's ``calibration.pack_history``).

=================  =============================================================================
``recording``      rows over time, checked; the pieces between gaps and returns of time
``binned``         a piece as means of neighbouring rows, closer where more happens
``traced``         measured means, and the model stepped along the recordings
``patterns``       whether residuals scatter, or hang together in time
``trace_problem``  what is fitted to what, and what is said of it
``trace_result``   what comes out: a calibration with its time history
``trace_file``     recordings in files
=================  =============================================================================
"""
