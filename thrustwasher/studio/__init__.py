"""What lies around the models, their FMUs and shifts, which run without it.

================  =========================================================================
``commands``      the commands ``calibrate fidelity compare efficiency explore optimise scatter
                  sweep``, and the files of ``shift``
``measured``          published measurements against the models
``optimisation``  designs that are found
``scatter``       uncertainty of figures
``explore``       a model or a shift in one page for the browser
``report``        pages and plots
``calibration``   parameters fitted to measurements
``evaluators``    what is studied in one form: values by path in, figures by name out
``sweep``         a model over ranges of inputs
``verification``  the errors of a part's levels, measured
``jobs``          many jobs on all cores or a cluster, resumable
================  =========================================================================

Nothing below imports it: ``thrustwasher.plugins`` names what is called from there.
"""
