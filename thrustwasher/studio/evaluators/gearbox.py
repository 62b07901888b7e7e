"""A gearbox that runs steadily in a gear as what is evaluated: efficiency and losses of points."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ...errors import ParameterError, SolveError, Status
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter
from ...shift.scene.places import scene_places, scene_scatter
from ...shift.scene.scene import Scene
from ...shift.scene.variation import scene_text, varied_scene
from ...shift.steady_points import COLUMNS, GEARS, RANGES, efficiency_map
from .evaluator import Answers, Effort, Remark, Row, digest_of

NO_FIGURES = (*RANGES, "warnings")
OIL = "oil_temperature"


@dataclass(frozen=True, kw_only=True)
class GearboxEvaluator:
    """A scene's gearbox in a gear, see ``gearbox_evaluator``."""

    scene: Scene
    gear: str
    remarks: tuple[Remark, ...] = ()
    kind: Literal["gearbox"] = "gearbox"
    reasons: Mapping[int, str] = field(
        default_factory=lambda: {int(s): s.name for s in Status if s.is_failure}
    )

    @property
    def name(self) -> str:
        """Name of the scene and the gear."""
        return f"scene {self.scene.name}, {self.gear} gear"

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """Torque and speed of its input, temperature of the oil; numbers of the scene, by path."""
        found = {
            name: Quantity(name=name, unit=unit, low=low, high=high, is_input=True)
            for name, (unit, low, high) in RANGES.items()
        }
        places = scene_places(self.scene)
        return {**found, **places, OIL: replace(places[OIL], is_input=True)}

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """What is left at the output, efficiency, the loss of every source."""
        return {n: Figure(n, *words) for n, words in COLUMNS.items() if n not in NO_FIGURES}

    @property
    def identity(self) -> dict[str, str]:
        """The scene and the gear."""
        values = {name: q.nominal for name, q in self.quantities.items()}
        return {"scene": f"{self.scene.name} {digest_of(values)}", "gear": self.gear}

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Effort | Sequence[Effort] = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return figures of rows; those that differ in torque alone are a line of a map."""
        values = np.full((len(rows), len(figures)), np.nan)
        codes = np.zeros(len(rows), np.int32)
        lines = [*_lines(rows)]
        while lines:
            places = lines.pop()
            try:
                columns = self._line([rows[i] for i in places])
                values[places] = np.column_stack([columns[name] for name in figures])
            except (ParameterError, SolveError) as problem:
                if len(places) > 1:  # the others have a solution perhaps
                    lines += [[i] for i in places]
                elif isinstance(problem, SolveError):
                    codes[places] = Status.MAX_ITERATIONS
                else:
                    codes[places] = Status.BAD_INPUT
        return Answers(values, codes)

    def gradient(self, *_: Any) -> None:
        """Return nothing: it is not known."""

    def why(self, row: Row) -> str:
        """Return why a row failed; "" if it did not."""
        try:
            self._line([row])
        except (ParameterError, SolveError) as problem:
            return str(problem)
        return ""

    def file(self, row: Row, *, draw: bool = False) -> str:
        """Return a file with the scene as its base, and the command that runs the point so."""
        at = " ".join(f"--over {name}={row.get(name, 0.0)!r}" for name in RANGES)
        head = f"thrustwasher efficiency FILE --gear {self.gear} {at}"
        return scene_text(self.scene, _of_scene(row), head)

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how it scatters, at its values or at those of a row."""
        scene = varied_scene(self.scene, _of_scene(row)) if row else self.scene
        return scene_scatter(scene, table)

    def _line(self, rows: Sequence[Row]) -> Mapping[str, Any]:
        """Return the columns of rows of one speed, in their order; ParameterError, SolveError."""
        changes = _of_scene(rows[0])
        scene = varied_scene(self.scene, changes) if changes else self.scene
        torques = [row.get("torque", 0.0) for row in rows]
        found = efficiency_map(scene, torques, [rows[0].get("speed", 0.0)], gear=self.gear)
        back = np.argsort(np.argsort(torques, kind="stable"), kind="stable")
        return {name: column[back] for name, column in found.columns.items()}


def gearbox_evaluator(scene: Scene, gear: str = "first") -> GearboxEvaluator:
    """Return a scene's gearbox as what is evaluated; ParameterError: there is no such gear.

    Parameters
    ----------
    scene : its gearbox with all parts; nothing is run before rows are asked
    gear : "first", the brake holds, or "second", the clutch holds
    """
    if gear not in GEARS:
        raise ParameterError(f"gear = {gear!r}, allowed: {', '.join(map(repr, GEARS))}")
    return GearboxEvaluator(scene=scene, gear=gear)


def _of_scene(row: Row) -> dict[str, Any]:
    """Return what a row changes of the scene."""
    return {name: value for name, value in row.items() if name not in RANGES}


def _lines(rows: Sequence[Row]) -> Iterator[list[int]]:
    """Yield the places of rows that differ in torque alone, the slowest first."""
    found: dict[Any, list[int]] = {}
    for i, row in enumerate(rows):
        rest = {name: value for name, value in row.items() if name != "torque"}
        found.setdefault(tuple(sorted(rest.items())), []).append(i)
    yield from found.values()
