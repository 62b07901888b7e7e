"""The page inside an FMU.

=====================  ===============================================================
``html_page``          the page: the template in fmu_src filled from the model's lists
``markup``             a little Markdown as HTML
``reference_results``  results of the default experiment, to compare with
=====================  ===============================================================
"""
