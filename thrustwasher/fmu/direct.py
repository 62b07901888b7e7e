"""The former place of ``DirectInstance``, kept for one minor version."""

import warnings
from typing import Any

from .running import direct_instance


def __getattr__(name: str) -> Any:
    """Return what ``running.direct_instance`` has under this name."""
    if name.startswith("__"):
        raise AttributeError(name)
    found = getattr(direct_instance, name)
    now = "thrustwasher.fmu.running.direct_instance"
    warnings.warn(f"thrustwasher.fmu.direct.{name} is now in {now}", DeprecationWarning, 2)
    return found
