"""Tag a wheel whose libraries are for one platform; every other build goes on as it would."""

import os
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

TAG = "THRUSTWASHER_WHEEL_TAG"  # set by build_wheels.py


class PlatformTag(BuildHookInterface[Any]):
    """Takes the wheel's tag from the environment; compiles nothing and needs no compiler."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Set the tag."""
        tag = os.environ.get(TAG)
        if tag and version != "editable":
            build_data["tag"], build_data["pure_python"] = tag, False
