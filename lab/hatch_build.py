"""Put the C shell into a wheel; an editable install takes the checkout as it is."""

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class Wheel(BuildHookInterface[Any]):
    """Adds ``fmu_src``; compiles nothing and needs no compiler."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the shell."""
        if version != "editable":
            build_data["force_include"]["fmu_src"] = "thrustwasher/_fmu_src"
