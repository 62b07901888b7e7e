"""Error against cost: what is measured, and the pages drawn from it.

==================  ==============================================================================
``chart_cases``     The fixed lists of operating points that errors and costs are measured on,
                    hard corners included
``chart_cost``      Error against cost: every way a model can be solved, on logarithmic axes
``chart_page``      All charts as one page, as Markdown, and as drawings; made from the JSON
                    record alone
``chart_series``    The series of the charts: every rung, meshes and tolerances, rivals at their
                    best setting
``chart_text``      The words beside the charts: who won, where it flips, what failed, what set-up
                    costs
``methods``         Methods to solve a model that can be measured: the package's rungs and meshes,
                    and rivals
``pareto``          Which samples nothing beats, with ties: noise of a clock decides nothing
``work_precision``  Work-precision: error and cost of methods on the same cases, by the same clock
==================  ==============================================================================
"""
