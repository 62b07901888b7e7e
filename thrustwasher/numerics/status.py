"""Numbers of the statuses that kernels return, equal to errors.Status."""

OK = 0
OUTSIDE_VERIFIED = 1
HOT = 2
DISTRESS = 3
STALLED = 4
CHATTER = 5
MAX_ITERATIONS = 10
SINGULAR = 11
NO_BRANCH = 12
NO_EVENT = 13
NOT_FINITE = 14
BAD_INPUT = 15
OVER_BUDGET = 16
