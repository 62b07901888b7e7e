"""What cards are made for: parameter sets, the boxes of inputs, how many held-out points."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ParameterError
from ..models._spec import ModelSpec
from ..store.card_parts import Axis
from ..units import parse_quantity
from .models import spec_of

SCENES = Path(__file__).parents[1] / "drivetrain" / "scenes"
SEED = 7
POINTS = 500
SAMPLING = "uniform in the scaled box"


@dataclass(frozen=True)
class Case:
    """One parameter set of a model with the box that is verified."""

    spec: ModelSpec
    name: str  # of the parameter set: "default" or the scene it comes from
    params: Any
    envelope: dict[str, Axis]
    n: int
    seed: int = SEED

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


def _box(spec: ModelSpec, **spans: tuple[float, float, str]) -> dict[str, Axis]:
    """Return an envelope; the units are the inputs'."""
    units = {s.name: s.unit for s in spec.inputs}
    return {n: Axis(low, high, units[n], scale) for n, (low, high, scale) in spans.items()}


def _scene_params(spec: ModelSpec, scene: str, part: str) -> Any:
    """Return the parameters that a shipped scene gives to one of its parts."""
    given = tomllib.loads((SCENES / f"{scene}.toml").read_text("utf-8"))[part]
    meta = {f.name: f.metadata for f in fields(spec.params)}
    values = {n: v for n, v in given.items() if n != "fidelity"}
    for name, value in values.items():
        if isinstance(value, str) and meta[name]["kind"] == "real":
            values[name] = parse_quantity(value, meta[name]["unit"], name)
    return spec.params(**values)


_OIL = (290.0, 400.0, "linear")


def _washers() -> list[Case]:
    spec = spec_of("washer")
    tilt = (1e-3, 3e-3, "log")
    full = _box(spec, load=(20.0, 1850.0, "log"), speed=(50.0, 1400.0, "log"), tilt=tilt,
                oil_temperature=_OIL)  # fmt: skip
    small = _box(spec, load=(1.0, 200.0, "log"), speed=(1.0, 450.0, "log"), tilt=tilt,
                 oil_temperature=_OIL)  # fmt: skip
    return [
        Case(spec, "default", spec.params(), full, POINTS),
        Case(spec, "planetary", _scene_params(spec, "planetary", "washer"), small, POINTS),
    ]


def _gears() -> list[Case]:
    spec = spec_of("gearmesh")
    box = _box(spec, load=(1.0, 200.0, "log"), speed=(1.0, 700.0, "log"), oil_temperature=_OIL)
    return [
        Case(spec, "default", spec.params(), box, POINTS),
        Case(spec, "planetary", _scene_params(spec, "planetary", "mesh"), box, POINTS),
    ]


def _clutches() -> list[Case]:
    spec = spec_of("clutch")
    box = _box(spec, load=(50.0, 10000.0, "log"), speed=(1.0, 350.0, "log"), oil_temperature=_OIL)
    in_scene = replace(_scene_params(spec, "planetary", "clutch"), input_course="linear")
    return [
        Case(spec, "default", spec.params(), box, POINTS),
        Case(spec, "planetary", in_scene, box, POINTS),
    ]


def cases(model: str) -> list[Case]:
    """Return the cases of a model, or raise ParameterError with the models there are."""
    made = {"washer": _washers, "clutch": _clutches, "gearmesh": _gears}
    if model not in made:
        raise ParameterError(f"model = {model!r}, allowed: {' or '.join(map(repr, made))}")
    return made[model]()
