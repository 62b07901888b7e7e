"""A gear shift as what is varied: the loop with washers as recorded, at the end all of it."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ..model.scatter import Place, Scatter
from ..scatter.scene_runs import Loop
from ..scatter.scene_target import SceneTarget, scene_target
from ..scatter.target import Figure
from ..shift.scene.places import scene_places, scene_scatter
from ..shift.scene.scene import Scene
from ..shift.scene.variation import scene_text, varied_scene
from .designs import Array, Effort, Row

HEAD = "A design of scene {!r}, found by a search"
NOTE = (
    "searched with the washers' torque as the scene's own run has it; designs that are shown are "
    "run again with their washers"
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
    def places(self) -> Mapping[str, Place]:
        """Numbers of the scene, by path."""
        return scene_places(self.scene)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Key figures of its own run."""
        return {f.name: f for f in self.target.figures}

    @property
    def identity(self) -> dict[str, str]:
        """The scene, its rungs and figures."""
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

    def text(self, row: Row) -> str:
        """Return a file with the scene as its base and the design's values."""
        return scene_text(self.scene, row, HEAD)
