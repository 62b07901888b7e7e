"""A calibration on recordings as it comes out: next to the usual, its time history."""

from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

import numpy as np

from ....numerics.jit import Array
from ....storage.digests import finite
from ...evaluators.evaluator import texts
from ..estimates import Calibration
from ..measured import output_units
from .patterns import Pattern


class HistoryOver(NamedTuple):
    """One output of one recording over time, measured and fitted."""

    name: str
    unit: str
    recording: str
    time: Array  # (n,) [s]
    measured: Array  # (n,)
    computed: Array  # (n,)
    half: Array  # (n,) half width of the confidence band; infinite where it is not told


@dataclass(frozen=True, eq=False, kw_only=True)
class TraceCalibration(Calibration):
    """Parameters fitted to recordings over time."""

    engagements: int  # how often the pack was pressed
    patterns: tuple[Pattern, ...]
    """Of each output: whether its residuals scatter, or hang together in time."""

    @property
    def notes(self) -> tuple[str, ...]:
        """What was read, and what torque can tell: the notes of ``remarks``, in words."""
        return texts(self.remarks, "note")

    @property
    def time(self) -> Array:
        """Time of each value in its recording [s], (n,)."""
        return np.asarray(self.points.time)  # type: ignore[attr-defined]

    def histories(self) -> list[HistoryOver]:
        """Return every output of every recording over time."""
        points: Any = self.points
        units = output_units(points.plan.spec)
        slopes = self._problem.slopes_of_curve(self._best)
        half = np.array([self._learned.half_width_of(row) for row in slopes])
        found = []
        for name in points.names:
            columns = (points.parts(name, x) for x in (self.time, points.value, self.fitted, half))
            for run, *values in zip(points.runs, *columns, strict=True):
                if len(values[0]):
                    found.append(HistoryOver(name, units[name], run.name, *values))
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        points: Any = self.points
        return {
            **super().to_dict(),
            "engagements": self.engagements,
            "recordings": len(points.runs),
            "recording": [points.runs[int(k)].name for k in points.run_of],
            "time": self.time.tolist(),
            "patterns": [finite(asdict(p)) | {"is_found": p.is_found} for p in self.patterns],
            "notes": list(self.notes),
        }

    def _columns(self) -> dict[str, Any]:
        """Return a row for each measured mean, with its time and the inputs there."""
        points: Any = self.points
        head = {"recording": points.run_of + 1, "time": self.time}
        return {**head, **super()._columns()}
