"""What cards are made for: parameter sets, the boxes of inputs, how many held-out points."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..ladder.card_parts import Axis
from ..model.registry import ladder_of, spec_of
from ..model.spec import ModelSpec
from ..shift.scene.scene_file import load_scene

SEED = 7
POINTS, POINTS_IN_PART = 500, 350
MOST = 50  # points drawn for each one wanted in a part of a box


@dataclass(frozen=True)
class Case:
    """One parameter set of a model with the box that points are drawn from.

    ``part`` is the part of the box that is verified, where that is less: a map may cover no more.
    """

    spec: ModelSpec
    name: str  # of the parameter set: "default" or the scene it comes from
    params: Any
    envelope: dict[str, Axis]
    n: int
    seed: int = SEED
    part: dict[str, Axis] | None = None

    @property
    def verified(self) -> dict[str, Axis]:
        """The box that a card of this case speaks for."""
        return self.part or self.envelope

    def numbers(self, n: int) -> list[int]:
        """Return the numbers of the first ``n`` points that lie in the verified box."""
        if self.part is None:
            return list(range(n))
        found: list[int] = []
        for k in range(MOST * n):
            point = self.point(k)
            if all(a.min <= point[name] <= a.max for name, a in self.part.items()):
                found.append(k)
            if len(found) == n:
                break
        return found

    def within(self, box: Mapping[str, tuple[float, float]]) -> "Case":
        """Return the case for the part of its box that lies in another one."""
        part = {}
        for name, a in self.envelope.items():
            low, high = box[name]
            part[name] = Axis(
                a.min if low <= a.min * (1.0 + 1e-9) else low,
                a.max if high >= a.max * (1.0 - 1e-9) else high,
                a.unit, a.scale,
            )  # fmt: skip
        return self if part == self.envelope else replace(self, part=part)

    def point(self, k: int) -> dict[str, float]:
        """Return held-out point number ``k``: its own random numbers, whatever ``n`` is."""
        share = np.random.default_rng([self.seed, k]).random(len(self.envelope))
        return {
            name: _at(axis, float(u))
            for (name, axis), u in zip(self.envelope.items(), share, strict=True)
        }


def _at(axis: Axis, share: float) -> float:
    """Return the value at a share of an axis, in its scale."""
    if axis.scale == "log":
        return axis.min * math.exp(share * math.log(axis.max / axis.min))
    return axis.min + share * (axis.max - axis.min)


def cases(model: str) -> list[Case]:
    """Return the cases of a model, or raise ParameterError with the models there are."""
    spec, ladder, found = spec_of(model), ladder_of(model), []
    units = {s.name: s.unit for s in spec.inputs}
    for name, box in ladder.boxes.items():
        params = spec.params()
        if name != "default":  # what a shipped scene gives to its part
            scene, _, part = name.partition(".")
            params = load_scene(scene).parts[part or ladder.part].params
        axes = {n: Axis(low, high, units[n], scale) for n, (low, high, scale) in box.items()}
        found.append(Case(spec, name, params, axes, POINTS))
    return found
