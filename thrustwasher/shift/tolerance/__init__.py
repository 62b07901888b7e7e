"""A shift with the cheapest levels that hold a tolerance.

====================  =============================================================================
``run_to_tolerance``  ``run_auto``: a run with the cheapest levels, choice, check, further runs
``selection``         the levels of every part that may serve, by the inputs of the first run
``level_check``        compares a level after the run with the one above
``selection_record``  what was chosen and why, what was checked and run again
====================  =============================================================================
"""
