"""A shift with the cheapest rungs that hold a tolerance.

====================  =============================================================================
``run_to_tolerance``  ``run_auto``: a run with the cheapest rungs, choice, check, further runs
``selection``         the rungs of every part that may serve, by the inputs of the first run
``rung_check``        compares a rung after the run with the one above
``selection_record``  what was chosen and why, what was checked and run again
====================  =============================================================================
"""
