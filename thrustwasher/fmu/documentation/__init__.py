"""The page inside an FMU.

=====================  ===========================================================================
``html_page``          documentation/index.html of an FMU: the template in fmu_src filled from the
                       model's lists
``markup``             Tables, lists and the little of Markdown that the models' own pages use, as
                       HTML
``reference_results``  Reference results inside an FMU: a user runs the default experiment and
                       compares
``wiring``             How to wire an FMU: feedthrough, steps that stay stable, and what a model
                       wants of a host
=====================  ===========================================================================
"""
