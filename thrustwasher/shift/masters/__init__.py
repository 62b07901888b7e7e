"""Co-simulation masters.

=====================  ============================================================================
``master``             the list of masters; ``gauss-seidel`` and ``jacobi`` are schedules alone
``linearly_implicit``  torques corrected to the end of the step by their derivatives
=====================  ============================================================================
"""
