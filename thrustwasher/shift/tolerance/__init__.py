"""A shift with the cheapest rungs that hold a tolerance.

====================  =============================================================================
``run_to_tolerance``  ``run_auto``: trial runs, choice, run, check
``trial_run``         which inputs a part will see, and what step and finest rungs are worth
``selection``         a rung for every part, from trial runs and cards
``rung_check``        checks the rungs after the run against those above
``selection_record``  what was chosen and why, what was checked and run again
====================  =============================================================================
"""
