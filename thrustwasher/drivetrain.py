"""The former name of ``thrustwasher.shift``, kept for one minor version."""

import warnings
from typing import Any

from . import shift


def __getattr__(name: str) -> Any:
    """Return what ``shift`` has under this name."""
    found = getattr(shift, name)
    if not name.startswith("__"):
        warnings.warn(
            f"thrustwasher.drivetrain.{name} is now thrustwasher.shift.{name}",
            DeprecationWarning, stacklevel=2,
        )  # fmt: skip
    return found
