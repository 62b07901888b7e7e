"""What a run looks like: pages, plots and tables.

===============  ================================================================================
``html``         One self-contained page: text, tables and plots in a single file that works
                 offline
``model_plots``  Pictures of one model
``palette``      Colours told apart by everyone, and what axis labels share
``panels``       Pictures of a shift over time
``shift``        The report of a shift, chapter by chapter
``style``        One look for all plots: colours told apart by everyone, units on axes, no global
                 state
===============  ================================================================================
"""
