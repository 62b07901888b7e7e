"""What a run looks like: pages, plots and tables.

================  ================================================================================
``bundles``       scripts and styles of the pages, put together
``html``          one page that holds text, tables and plots and works offline
``model_plots``   pictures of one model
``palette``       colours told apart by everyone, and what axis labels share
``reducer_report``  of a gear train: loss map, losses by source, safeties, lives, limits
``result_plots``  the picture of a result, by its class
``shift``         the report of a shift, chapter by chapter
``style``         one look for all plots
``target``        a figure of its own, or figure or axes of the caller
``web``           styles and scripts of the pages, and the library they plot with
``web_worker``    a model's kernels in a web worker: what its scripts are and read
``scatter``       uncertainty of figures: the page of a study, and what a shift's report takes of it
================  ================================================================================
"""
