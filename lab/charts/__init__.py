"""Error against cost: what is measured, and the pages drawn from it.

====================  ============================================================================
``chart_cost``        Error against cost: every way a model can be solved, on logarithmic axes
``chart_page``        All charts as one page, as Markdown, and as drawings; where methods fail
``chart_series``      What a chart is: the series of ways to solve, the points of ``cases.toml``
``chart_text``        Which samples nothing beats, and the words next to the charts
``clutch_chart``      The chart of the clutch: engagements at every level and over the step
``methods``           Methods to solve a model that can be measured
``surroundings``        What a chart says about its making: machine, versions, state of the sources
``washer_chart``      The chart of the washer: levels and meshes
``work_precision``    Work-precision: error and cost of methods on the same cases, by the same clock
====================  ============================================================================
"""
