"""Whether a pack can carry what its gear and its inertia phase ask for: from a run's signals."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ...numerics.jit import Array
from ...transmission.mobility import planetary
from ..key_figures.events_and_phases import GEARS, STANDSTILL
from ..scene.connections import PACKS
from ..scene.scene import Scene
from ..warning_texts import Ranked, warning
from .steady_doubts import capacity_at

SETTLED = 0.995  # of the maximum load: a pack has all the load that it gets
RESERVE = 1.1  # of the torque that is asked for
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


def weak_packs(
    scene: Scene, time: Array, signals: Mapping[str, Array], *, held: bool, handed: bool
) -> dict[str, Ranked]:
    """Return, by pack, that it slips under its full load since it cannot carry enough.

    Parameters
    ----------
    scene : what was run
    time, signals : (n,) points [s], as far as the run got
    held : the engaging pack locked and held
    handed : the inertia phase counts: the run was whole, and always one of the packs was pressed
    """
    if scene.alone:
        return {}
    lines = {
        pack: _weak(scene, pack, time, signals, handed)
        for pack in PACKS
        if not (held and pack == scene.engaging)
    }
    return {pack: line for pack, line in lines.items() if line}


def _weak(
    scene: Scene, pack: str, time: Array, signals: Mapping[str, Array], handed: bool
) -> Ranked | None:
    def own(name: str) -> Array:
        return signals[f"transmission.{name}"]

    load, slip, start = own(f"{pack}_load"), own(f"{pack}_speed"), scene.shift_start
    there, engages = time <= max(start, time[0]), pack == scene.engaging
    if engages:
        if time[-1] < start + scene.shift_duration:  # it is to be pressed harder
            return None
        there = (time >= start) & (time <= scene.required_until)
    full = there & (load > 0.0) & (load >= SETTLED * load.max())
    for other in PACKS:
        if other != pack:
            full &= own(f"{other}_load") <= 0.0
    slips = np.flatnonzero(full & (np.abs(slip) > STANDSTILL))
    most = grip(scene, pack) * float(load.max())
    if not len(slips) or np.isnan(most):
        return None
    law, gear = holding(scene.parts["transmission"].params, pack), GEARS[pack]
    torque = law.engine * own("drive_torque") + law.output * own("shaft_torque")
    keeps, need = float(np.mean(torque[slips])), float(np.abs(torque[slips]).max())
    left = float(time[slips[-1]] - time[slips[0]])
    words = {"pack": pack, "gear": gear, "load": load.max(), "capacity": most, "need": need}
    first = float(slip[max(int(np.searchsorted(time, start, side="right")) - 1, 0)])
    if engages and handed and left > 0.0:
        ends = float(np.sign(first)) * keeps + abs(first) / (law.mobility * left)
        if ends > max(need, most):
            what = gear if need > most else "the inertia phase"
            text = warning("weak", what=what, **words)
            text += warning("weak_phase", most=ends, slip=abs(first), left=left)
            return text + warning("weak_cure", times=RESERVE * max(ends, need) / most)
    if need <= most:
        return None
    return warning("weak", what=gear, **words) + warning("weak_cure", times=RESERVE * need / most)
