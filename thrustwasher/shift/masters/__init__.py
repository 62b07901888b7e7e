"""Co-simulation masters.

=====================  ============================================================================
``master``             the list of masters; ``gauss-seidel`` and ``jacobi`` are schedules alone
``linearly_implicit``  torques corrected to the end of the step by their derivatives
``step_doubling``      steps chosen by their error, with rollback and located events
=====================  ============================================================================
"""
