"""Tie-up: for a while both packs of a shift work against each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .figure_list import Found
from .scene import Scene

Array = NDArray[np.float64]
Signals = dict[str, Array]
LEAST_SHARE = 0.1  # of the torque held before: less is a handover that overlaps a little


def tie_up_figures(scene: Scene, time: Array, signals: Signals) -> Found:
    """Return duration, torque and heat of a tie-up; nothing where the packs hand over cleanly.

    It begins when the torque of the pack that lets go changes its sign, and ends when that pack is
    no longer pressed. The heat is what it takes up meanwhile.
    """
    other, start = scene.releasing, scene.shift_start
    torque = signals[f"transmission.{other}_reaction"]
    held = float(np.interp(start, time, torque))
    against = -np.sign(held) * torque
    pressed = signals[f"transmission.{other}_load"] > 0.0
    during = np.flatnonzero((time > start) & pressed & (against > 0.0))
    if not len(during) or np.max(against[during]) <= LEAST_SHARE * abs(held):
        return {}
    first = int(during[0])
    begin = float(np.interp(0.0, against[first - 1 : first + 1], time[first - 1 : first + 1]))
    free = np.flatnonzero((time > time[first]) & ~(pressed & (against > 0.0)))
    last = int(free[0]) if len(free) else len(time) - 1
    most = first + int(np.argmax(against[first : last + 1]))
    heat = signals[f"transmission.{other}_heat"]
    return {
        "tie_up_duration": (float(time[last]) - begin, begin),
        "tie_up_torque": (float(torque[most]), float(time[most])),
        "tie_up_heat": (float(heat[last] - heat[first - 1]), None),
    }
