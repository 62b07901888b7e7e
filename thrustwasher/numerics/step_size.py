# mypy: disable-error-code="no-any-return"
"""The step at which an error would be as large as it may be, from the error of the last step."""

from .jit import kernel

LEAST, MOST = 0.2, 5.0  # of the last step


@kernel
def advised_step(last: float, error: float, allowed: float, order: float) -> float:
    """Return a step [s] between a fifth and five times the ``last`` one [s].

    The last one made ``error``, which falls with the power ``order`` of the step; ``allowed`` is
    of the same unit.
    """
    if error * MOST**order <= allowed:
        return MOST * last
    return last * max(LEAST, (allowed / error) ** (1.0 / order))
