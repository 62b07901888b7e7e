"""Many runs of one scene: the loop with its washers' torque as recorded, then the washers apart.

A washer takes nearly all of a run's time and hardly feeds back. The loop therefore plays the torque
that the washers of another run have recorded; afterwards each is solved along the inputs that the
loop has recorded, at some 90 instants, warm from one to the next.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ...errors import SolveError, Status
from ...numerics.jit import Array
from ...shift.checks.washer_in_time import between_lines
from ...shift.cosim.recorded import Recorded
from ...shift.cosim.system import Stepping
from ...shift.run import advance_of, connected, laid_out
from ...shift.scene.scene import Part, Scene
from ...washer.follow import Follower
from ...washer.kernels import layout as L
from ...washer.parameters import SPEC
from ...washer.solve import GRIDS

CLOSE = 0.01  # of an input's range: what straight lines between instants may be off
EVEN = 50  # further instants, even in time, where inputs change
Signals = dict[str, Array]
Make = Callable[[str, Part], Any]


class Loop:
    """The instances of a scene's parts, set to other parameters from run to run.

    Parameters
    ----------
    scene : one with these parts
    make : returns an instance of a part; it has ``reset(parameters)``
    played : parts whose outputs are as recorded, by name
    """

    def __init__(self, scene: Scene, make: Make, played: Mapping[str, Recorded]) -> None:
        self.played = played
        self.instances = {n: make(n, p) for n, p in scene.parts.items() if n not in played}
        self._given = {n: scene.parts[n].params for n in self.instances}

    def run(
        self, scene: Scene, played: Mapping[str, Recorded] | None = None
    ) -> tuple[Array, Signals]:
        """Return times [s] and all signals of a run at a scene's values.

        ``played``: other records than those from the start. ParameterError, SolveError: as in
        ``cosimulate``.
        """
        now: dict[str, Stepping] = dict(self.played if played is None else played)
        for name, instance in self.instances.items():
            part = scene.parts[name]
            changed = part.params != self._given[name]
            instance.reset(part.parameters() if changed else None)
            instance.warnings.clear()  # thousands of runs would gather them
            self._given[name], now[name] = part.params, instance
        system = connected(scene, now)
        run = laid_out(scene, system, [])
        system.initialize(scene.start_time)
        run.recorder.keep(0)
        advance_of(run, None)(0, len(run.time) - 1)
        return run.time, run.recorder.signals()

    def close(self) -> None:
        """Free the instances."""
        for instance in self.instances.values():
            instance.close()


def followed(part: Part, name: str, time: Array, signals: Signals, more: Sequence[int]) -> Signals:
    """Return the outputs of a washer along its recorded inputs, by name.

    Parameters
    ----------
    part : the washer
    name : its name in the scene
    time, signals : (n,) of a run, its inputs among them
    more : points at which it is solved in any case

    Returns
    -------
    (n,) arrays, straight between the instants that were solved; ``distress`` is that of the instant
    before

    Raises
    ------
    SolveError : it could not be followed; the message says from when on
    """
    rows = np.column_stack([signals[f"{name}.{s.name}"] for s in SPEC.inputs])
    places = sorted({*_instants(time, rows), *more})
    level = "field" if part.fidelity == "map" else part.fidelity
    follower = Follower(part.params, GRIDS[level])
    values, lost, before = np.empty((len(places), len(follower.out))), np.zeros(len(places)), 0
    for k, i in enumerate(places):
        duration = float(time[i] - time[before])
        status = Status(follower.go(rows[before], rows[i], duration))
        if status.is_failure:
            raise SolveError(f"{name} at t = {time[i]:g} s: {status.advice}")
        values[k], lost[k], before = follower.out, follower.iout[L.IO_DISTRESS], i
    found = {
        f"{name}.{output}": np.interp(time, time[places], column)
        for output, column in zip(SPEC.real_outputs, values.T, strict=True)
    }
    last = np.searchsorted(places, np.arange(len(time)), side="right") - 1
    return {**found, f"{name}.distress": lost[last]}


def _instants(time: Array, rows: Array) -> set[int]:
    """Return points at which a washer is solved along its inputs (n, 5)."""
    span = np.ptp(rows, axis=0)
    found = set(between_lines(time, rows / np.where(span > 0.0, span, 1.0), CLOSE))
    even = np.linspace(0, len(time) - 1, EVEN + 1).astype(int)
    moved = (rows[even[1:]] != rows[even[:-1]]).any(1)
    return found | set(even[1:][moved].tolist())
