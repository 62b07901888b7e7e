"""The former name of ``thrustwasher.shift``, kept for one minor version."""

import warnings
from typing import Any

from . import shift


def __getattr__(name: str) -> Any:
    """Return what ``shift`` has under this name."""
    if name.startswith("__") and name != "__all__":
        raise AttributeError(name)
    found = getattr(shift, name)
    if name == "__all__":
        return found
    warnings.warn(
        f"thrustwasher.drivetrain.{name} is now thrustwasher.shift.{name}", DeprecationWarning, 2
    )
    return found
