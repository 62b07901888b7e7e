"""Parameters of a gear mesh as numbers."""

from typing import Any

from ..model.parameters import as_numbers


def as_array(p: object) -> Any:
    """Return the parameters as the kernels take them, without the constants behind."""
    import numpy as np

    return np.array(as_numbers(p))
