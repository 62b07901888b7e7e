"""A gear shift as what is varied: the loop with washers as recorded, at the end all of it."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter
from ...shift.checks.step_error import rounded
from ...shift.checks.step_estimate import excess
from ...shift.scene.places import scene_places, scene_scatter
from ...shift.scene.scene import Scene
from ...shift.scene.variation import scene_text, varied_scene
from ...units import format_quantity
from ..scatter.scene_runs import Loop
from ..scatter.scene_target import SceneTarget, scene_target
from .designs import Array, Effort, Row

NOTABLE = 2.0  # errors of the step that a gain is to exceed
HEAD = "A design of scene {!r}, found by a search"
NOTE = (
    "while searching the washers have the torque of the scene's own run; the designs shown here "
    "are run again with their washers solved"
)


class SceneDesigns:
    """A scene as what is varied."""

    kind: Literal["scene"] = "scene"

    def __init__(self, scene: Scene) -> None:
        """``scene``: one shift; ParameterError otherwise, SolveError if it cannot be run."""
        self.target: SceneTarget = scene_target(scene, Scatter())
        self.scene, self.name = self.target.scene, scene.name
        self._whole: Loop | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to workers: instances are made where they run."""
        return self.__dict__ | {"_whole": None}

    @cached_property
    def places(self) -> Mapping[str, Quantity]:
        """Numbers of the scene, by path."""
        return scene_places(self.scene)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Key figures of its own run."""
        return {f.name: f for f in self.target.figures}

    @property
    def identity(self) -> dict[str, str]:
        """The scene, its levels and figures."""
        return self.target.identity

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed of the scene."""
        return self.target.warnings

    @property
    def notes(self) -> tuple[str, ...]:
        """How designs are judged."""
        return (NOTE,) if self.target.played else ()

    def effort(self, figures: Sequence[str], variables: int) -> Effort:
        """Return a search without slopes: a figure such as the jerk has corners."""
        return Effort(sample=64 * variables, starts=4, rounds=2, tries=12 + 5 * variables)

    def solve(self, rows: Sequence[Row], figures: Sequence[str], whole: bool = False) -> Array:
        """Return figures of designs (n, m); ``whole``: the washers solved in every step."""
        columns = [list(self.figures).index(name) for name in figures]
        if whole:
            self._whole = self._whole or self.target.new_loop({})
            return self.target.answers(self._whole, rows)[:, columns]
        costly = any(name in self.target.costly for name in figures)
        found, _ = self.target.solve([dict(row) for row in rows], np.full(len(rows), costly))
        chosen: Array = found[:, columns]
        return chosen

    def slopes(
        self, row: Row, figures: Sequence[str], names: Sequence[str], whole: bool = False
    ) -> None:
        """Return nothing: lock-up and peaks move with every step."""

    def scatter(self, row: Row) -> Scatter:
        """Return how the scene scatters about a design."""
        return scene_scatter(varied_scene(self.scene, row))

    def shorter_step(
        self, rows: Sequence[Row], figures: Sequence[str], gain: float
    ) -> tuple[float | None, str]:
        """Return the communication step that designs need, None if the scene's does; and a note.

        A search finds the designs in which an error of the step is in its favour.
        """
        jerk = any("jerk" in name for name in figures)
        errors = []
        for row in rows:
            with suppress(ParameterError, SolveError):
                found = self.target.step_error(row)
                errors.append(found if jerk else found._replace(peak_jerk=None))
        if not errors:
            return None, "the error of the communication step could not be estimated"
        worst = max(errors, key=lambda e: excess(e.errors()))
        at = format_quantity(worst.step, "s", digits=4)
        text = f"with communication steps of {at} the best design errs by about {worst.words()}"
        if lacking := [e.advice for e in errors if not e.suffices]:
            return min(lacking), text
        if 0.0 < gain < NOTABLE * max(worst.errors().values()):
            return rounded(0.5 * self.scene.step), text
        return None, text

    def with_step(self, step: float) -> "SceneDesigns":
        """Return the scene with another communication step [s]."""
        return SceneDesigns(self.scene.with_options(step=step))

    def text(self, row: Row) -> str:
        """Return a file with the scene as its base and the design's values."""
        return scene_text(self.scene, row, HEAD)
