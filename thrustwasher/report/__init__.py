"""What a run looks like: pages, plots and tables.

================  ============================================================
``html``          one page that holds text, tables and plots and works offline
``model_plots``   pictures of one model
``palette``       colours told apart by everyone, and what axis labels share
``result_plots``  the picture of a result, by its class
``shift``         the report of a shift, chapter by chapter
``style``         one look for all plots
``web``           styles and scripts of the pages, and the library they plot with
``web_worker``    a model's kernels in a web worker: what its scripts are and read
================  ============================================================
"""
