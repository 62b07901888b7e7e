"""Error against cost: what is measured, and the pages drawn from it.

==================  ==============================================================================
``chart_cost``      Error against cost: every way a model can be solved, on logarithmic axes
``chart_page``      All charts as one page, as Markdown, and as drawings
``chart_series``    What is charted: fixed operating points and the series of ways to solve
``chart_text``      Which samples nothing beats, and the words beside the charts
``methods``         Methods to solve a model that can be measured
``work_precision``  Work-precision: error and cost of methods on the same cases, by the same clock
==================  ==============================================================================
"""
