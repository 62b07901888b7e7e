"""What is said of a finished shift, in numbers and sentences; pages and pictures lie above.

=================  =======================================================================
``shift_record``   a finished shift as plain data
``summary``        the warnings
``swing_texts``    a swing of the shaft and a slip that flips, and what to change
``what_happened``  the sentences at the top
``worst_moments``  the worst values, when they were reached, the washer solved again there
=================  =======================================================================
"""
