"""The friction law fitted to measurements: what it has beside every calibration.

===================  ============================================================================
``calibration``      what is asked, checked; the fit, coefficients at both ends, whether load acts
``friction_law``     the law over its constants: derivatives, a problem of least squares, starts
``data_warnings``    points that the law cannot follow, in plain sentences
===================  ============================================================================
"""
