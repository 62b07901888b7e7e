"""What a pack can carry, and what its gear asks for."""

from typing import Any, NamedTuple

import numpy as np

from ...transmission.mobility import planetary
from ..scene.scene import Scene
from .steady_doubts import capacity_at

REFERENCE = 1e3  # N


class Holding(NamedTuple):
    """The torque that keeps the slip of a pack as it is, the other one open, without losses.

    It is ``engine`` T_engine + ``output`` T_output; another torque changes the slip by ``mobility``
    [1/(kg m2)] times the difference.
    """

    engine: float
    output: float
    mobility: float


def holding(gearbox: Any, pack: str) -> Holding:
    """Return what the equations of motion say of a pack of a transmission's parameters."""
    inertias = gearbox.input_inertia, gearbox.drum_inertia, gearbox.carrier_inertia
    m = planetary(gearbox.ratio, *inertias, gearbox.vehicle_inertia, pack)
    return Holding(m.drive / m.slip, -m.cross / m.slip, m.slip)


def grip(scene: Scene, pack: str) -> float:
    """Return the torque that a pack holds at rest, per load [N m/N]; NaN: none is known."""
    found = capacity_at(scene, pack, REFERENCE) / REFERENCE
    return found if 0.0 < found < np.inf else np.nan
