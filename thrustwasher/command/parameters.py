"""Parameters and outputs of the command source: the ramp of a shift command as a part of its own.

A run of this package has its shift command from the scene; a system that another tool runs needs a
part that sends it.
"""

from dataclasses import dataclass

from ..model.parameters import check_ranges, quantity
from ..model.toml_tables import spec_beside


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandParams:
    """A ramp from ``before`` to ``after``."""

    start: float = quantity(
        0.1, "s", -1e6, 1e6, "time the ramp starts, from the run's start", instant=True
    )
    duration: float = quantity(0.3, "s", 0.0, 1e3, "duration of the ramp (0: a step)")
    before: float = quantity(0.0, "1", 0.0, 1.0, "command before the ramp")
    after: float = quantity(1.0, "1", 0.0, 1.0, "command after the ramp")
    lead: float = quantity(0.0, "s", 0.0, 1.0, "time the command is sent ahead of the ramp")

    def __post_init__(self) -> None:
        check_ranges(self)


SPEC = spec_beside(__file__, CommandParams)
