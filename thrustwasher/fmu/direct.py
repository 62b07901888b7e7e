"""The former place of ``DirectInstance``, kept for one minor version."""

import warnings
from typing import Any

from .running import direct_instance


def __getattr__(name: str) -> Any:
    """Return what ``running.direct_instance`` has under this name."""
    found = getattr(direct_instance, name)
    if not name.startswith("__"):
        warnings.warn(
            f"thrustwasher.fmu.direct.{name} is now in thrustwasher.fmu.running.direct_instance",
            DeprecationWarning, stacklevel=2,
        )  # fmt: skip
    return found
