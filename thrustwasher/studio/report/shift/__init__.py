"""The report of a shift, chapter by chapter; sentences and record are those of ``shift.account``.

===================  =============================================================================
``heat_split``       made, stored, given to the oil: the heat of a part
``how_sure``         what the scatter of inputs makes of it, and what the verdict rests on
``overview_plot``    plots of the page as one still picture
``section_texts``    what stands above the tables
``shift_data``       the run for the page's scripts; ``panels.toml``: what stands together
``shift_report``     the page: what was simulated, what came out, how far to trust it
``shift_tables``     the tables as rows of text
``trust``            what the numbers are worth
``usual``            what is usual next to what came out
``live_washer``      the washer's kernels as the page's scripts call them
``sequence_report``  the report of several shifts in one run: a row per shift
===================  =============================================================================
"""
