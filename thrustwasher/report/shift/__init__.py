"""The report of a shift, chapter by chapter.

=================  =======================================================================
``heat_split``     made, stored, given to the oil: the heat of a part
``how_sure``       what the scatter of inputs makes of it, and what the verdict rests on
``overview_plot``  plots of the page as one still picture
``section_texts``  what stands above the tables
``shift_data``     the run for the page's scripts; ``panels.toml``: what stands together
``shift_record``   what the report needs from a finished shift, as plain data
``shift_report``   the page: what was simulated, what came out, how far to trust it
``shift_tables``   the tables as rows of text
``summary``        the warnings
``swing_texts``    a swing of the shaft and a slip that flips, and what to change
``trust``          what the numbers are worth
``usual``          what is usual beside what came out
``what_happened``  the sentences at the top
``worst_moments``  the worst values, when they were reached, the washer solved again there
=================  =======================================================================
"""
