"""What errors are measured for: parameter sets, the boxes of inputs, how many random points."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...errors import ParameterError
from ...ladder.error_table import OWN, Axis, Box
from ...model.parameters import check_number
from ...model.prepare import tables_of
from ...model.registry import ladder_of
from ...model.spec import ModelSpec
from ...storage.digests import params_digest

SEED = 7
POINTS = 500
ALLOWED = (12, 5000)  # points of your own part
LEAST_SHARE = 2e-3  # of the upper end: there a logarithmic axis begins that would begin at zero


@dataclass(frozen=True)
class Case:
    """One parameter set of a model with the box that points are drawn from."""

    spec: ModelSpec
    name: str  # "default", a scene, a scene's part, or own-...
    params: Any
    box: Mapping[str, Axis]
    n: int = POINTS
    seed: int = SEED

    def point(self, k: int) -> dict[str, float]:
        """Return random point number ``k``: its own random numbers, whatever ``n`` is."""
        shares = np.random.default_rng([self.seed, k]).random(len(self.box))
        pairs = zip(self.box.items(), shares.tolist(), strict=True)
        return {name: _at(axis, share) for (name, axis), share in pairs}


def _at(axis: Axis, share: float) -> float:
    """Return the value at a share of an axis, in its scale."""
    if axis.scale == "log":
        return axis.min * math.exp(share * math.log(axis.max / axis.min))
    return axis.min + share * (axis.max - axis.min)


def own_case(spec: ModelSpec, params: Any, box: Box, n: int) -> Case:
    """Return the case of a part and the box that it is meant for; inputs left out are as shipped.

    ParameterError: the box leaves the model's range, or the number of points is not allowed.
    """
    if not ALLOWED[0] <= n <= ALLOWED[1]:
        raise ParameterError(f"points = {n}, allowed: {ALLOWED[0]} .. {ALLOWED[1]}")
    usual, tables = ladder_of(spec.key).boxes["default"], tables_of(spec)
    axes = {}
    for s in spec.inputs:
        if s.name not in usual:
            continue
        low, high = box.get(s.name, usual[s.name][:2])
        for end, least in ((low, s.low or 0.0), (high, low)):
            check_number(f"box: {s.name}", end, s.unit, least, s.high or 0.0)
        scale = usual[s.name][2]
        if scale == "log":
            low = max(low, LEAST_SHARE * high, tables.least(s.name, (low, high)) if tables else 0.0)
            scale = "log" if low > 0.0 else "linear"
        axes[s.name] = Axis(low, high, s.unit, scale)
    return Case(spec, f"{OWN}{params_digest(params)[:8]}", params, axes, n)
