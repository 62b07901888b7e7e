"""What the report needs from a finished shift."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray[Any, Any]


class Phase(NamedTuple):
    """A stretch of the shift [s]."""

    name: str
    start: float
    end: float


class Event(NamedTuple):
    """Something that happened at one time [s]."""

    time: float
    text: str


@dataclass(frozen=True, kw_only=True)
class Record:
    """A finished shift as plain data."""

    name: str
    description: str
    time: Array
    signals: Mapping[str, Array]  # "component.variable" -> values at ``time``
    phases: Sequence[Phase]
    events: Sequence[Event]
    energy: Mapping[str, float]
    figures: Mapping[str, Any]
    cost: Mapping[str, Any]
    messages: Sequence[str] = ()
    parameters: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def series(self, name: str) -> Array | None:
        """Return a signal, or None if this run has none of that name."""
        values = self.signals.get(name)
        return None if values is None else np.asarray(values, dtype=float)

    @property
    def oil_temperature(self) -> float:
        """Temperature of the oil [K]."""
        values = self.series("transmission.oil_supply_temperature")
        return 297.15 if values is None else float(values[0])
