"""The report of a shift, chapter by chapter.

=================  =======================================================================
``shift_record``   what the report needs from a finished shift, as plain data
``shift_report``   the page: what was simulated, what came out, how far to trust it
``shift_tables``   the tables as rows of text
``summary``        the sentences; they stand in ``words.jinja``
``worst_moments``  the worst values, when they were reached, the washer solved again there
=================  =======================================================================
"""
