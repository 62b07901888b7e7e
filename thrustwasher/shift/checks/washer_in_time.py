"""Whether steady states stand for a washer in a run: it is followed once more in time.

Inputs are those that the run has recorded: a washer hardly feeds back. From the steady state at
the first instant its bodies store heat and give it back; what it gives then is compared with the
steady states of the run. Instants lie where straight lines between them keep to the recorded
inputs and outputs, and closer where the two differ. A quick mesh comes first; where it finds
nothing near a limit, that is enough.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import Status
from ...numerics.jit import Array
from ...units import format_quantity as say
from ...washer.follow import Follower
from ...washer.parameters import SPEC, WasherParams
from ...washer.solve import GRIDS
from ..key_figures.figure_list import FILM_SPEED
from ..scene.scene import Part

CLOSE = 0.05  # of a signal's range: what straight lines between instants may be off
LIKELY = 0.5  # of a limit: from here on instants are set closer
QUICK = (8, 20)  # nodes of the quick mesh
NEARLY = 0.8  # of a limit: what the quick mesh may find where the finer one is not asked
TURN, CLEAR = 0.5, 3.0  # of a limit: the difference may change so much then; beyond, it is clear
MOST = 100  # instants set closer
LEAST_STEPS, LEAST_TIME = 5, 5e-3  # [steps], [s]: shorter differences are passed over
SHARE, OF_GREATEST = 0.1, 0.05  # of the larger value, of the run's maximum torque
THIN = 3.0  # film ratio: above it the film carries all, whatever its thickness
WARMER = 5.0  # K
COMPARED = ("friction_torque", "film_ratio", "temperature_max")
SHOWN = {
    "friction_torque": ("friction torque", "N.m"),
    "film_ratio": ("film ratio", "1"),
    "temperature_max": ("hottest spot", "K"),
}
PLACES = [SPEC.real_outputs.index(name) for name in COMPARED]


class Difference(NamedTuple):
    """Where a quantity in time differs most from the steady states, and for how long [s]."""

    quantity: str
    time: float
    steady: float
    in_time: float
    lasts: float


class InTime(NamedTuple):
    """A washer followed in time: values at the instants, a column for each of ``COMPARED``."""

    time: Array
    values: Array
    stopped: str
    """Why it could not be followed to the end; empty if it could."""
    differences: list[Difference]
    worst: float
    """The maximum difference over its limit, however short."""

    def warnings(self, part: str, remedy: str) -> list[str]:
        """Return what must not be missed."""
        found = []
        if self.differences:
            shown = _words(self.differences)
            found.append(
                f"{part}: its steady temperatures do not hold in this run: {shown}; {remedy}"
            )
        if self.stopped:
            found.append(
                f"{part}: it could not be followed in time beyond {self.time[-1]:.4g} s "
                f"({self.stopped}): whether its steady temperatures hold is open"
            )
        return found


def _words(differences: list[Difference]) -> str:
    return ", ".join(
        f"{SHOWN[d.quantity][0]} {say(d.steady, SHOWN[d.quantity][1], digits=3)} where in time it "
        f"is {say(d.in_time, SHOWN[d.quantity][1], digits=3)} (at {d.time:.4g} s, for "
        f"{say(d.lasts, 's', digits=2)})"
        for d in differences
    )


def washer_in_time(
    part: Part, name: str, time: Array, signals: Mapping[str, Array], step: float
) -> InTime:
    """Follow a washer that was taken as steady along the record of a finished run."""
    own = {n: signals[f"{name}.{n}"] for n in (*(s.name for s in SPEC.inputs), *COMPARED)}
    level = "field" if part.fidelity == "map" else part.fidelity
    shortest = max(LEAST_STEPS * step, LEAST_TIME)
    quick = follow_recorded(part.params, QUICK, time, own, shortest)
    if quick.worst < NEARLY and not quick.stopped:
        return quick
    return follow_recorded(part.params, GRIDS[level], time, own, shortest)


def follow_recorded(
    params: WasherParams,
    grid: tuple[int, int],
    time: Array,
    signals: dict[str, Array],
    shortest: float,
) -> InTime:
    """Follow a washer along recorded inputs and compare it with the recorded steady outputs.

    Parameters
    ----------
    params : the washer
    grid : its nodes, (n_r, n_theta)
    time : (n,) points [s]
    signals : (n,) values at the points of each input and of ``COMPARED``, SI units
    shortest : what lasts no longer [s] is no difference
    """
    params = replace(params, thermal_mode="transient", thermal_start="steady")
    unset = np.zeros(len(time))  # an input that may be left out is 0 there
    inputs = np.column_stack(
        [signals.get(s.name, unset) if s.optional else signals[s.name] for s in SPEC.inputs]
    )
    steady = np.column_stack([signals[name] for name in COMPARED])
    greatest = float(np.abs(steady[:, 0]).max())
    turning = np.abs(signals["speed"]) >= FILM_SPEED
    rest = 1 + int(np.flatnonzero(signals["speed"])[-1:].sum())  # from here on it stands still

    def over(values: Array, at: NDArray[np.intp]) -> Array:
        """Return differences over their limits, a column for each of ``COMPARED``."""
        known = steady[at]
        larger = np.maximum(np.abs(values), np.abs(known))
        least = np.minimum(values[:, 1], known[:, 1])
        torque = np.maximum(SHARE * larger[:, 0], OF_GREATEST * greatest)
        film = np.where((least < THIN) & turning[at], SHARE * larger[:, 1], np.inf)
        limits = np.column_stack((torque, film, np.full(len(known), WARMER)))
        return np.asarray(np.abs(values - known) / np.maximum(limits, 1e-300))

    places, values, stopped = _walk(
        Follower(params, grid),
        time,
        inputs,
        sorted({*_instants(time, inputs, steady), min(rest, len(time) - 1)}),
        rest,
        over,
    )
    off = values - steady[places]
    after = slice(0, places[-1] + 1)
    followed = steady[after] + np.column_stack(
        [np.interp(time[after], time[places], column) for column in off.T]
    )
    share = over(followed, np.arange(places[-1] + 1))
    found = [
        _longest(name, time, steady[:, k], followed[:, k], share[:, k] > 1.0)
        for k, name in enumerate(COMPARED)
    ]
    return InTime(
        time[places],
        values,
        stopped,
        [d for d in found if d is not None and d.lasts > shortest],
        float(share.max()),
    )


def _instants(time: Array, inputs: Array, steady: Array) -> list[int]:
    """Return points between which straight lines keep to what was recorded."""
    columns = np.column_stack((inputs, steady))
    columns[:, -2] = np.minimum(columns[:, -2], THIN)
    ranges = np.ptp(columns, axis=0)
    ranges[-1] = max(ranges[-1], WARMER / CLOSE)
    return between_lines(time, columns / np.where(ranges > 0.0, ranges, 1.0), CLOSE)


def between_lines(time: Array, columns: Array, close: float) -> list[int]:
    """Return points between which straight lines are nowhere more than ``close`` off."""
    kept, open_ = {0, len(time) - 1}, [(0, len(time) - 1)]
    while open_:
        a, b = open_.pop()
        if b - a < 2:
            continue
        share = ((time[a + 1 : b] - time[a]) / (time[b] - time[a]))[:, np.newaxis]
        line = columns[a] + share * (columns[b] - columns[a])
        off = np.abs(columns[a + 1 : b] - line).max(axis=1)
        middle = a + 1 + int(off.argmax())
        if off[middle - a - 1] > close:
            kept.add(middle)
            open_ += [(a, middle), (middle, b)]
    return sorted(kept)


def _walk(
    follower: Follower,
    time: Array,
    inputs: Array,
    instants: list[int],
    rest: int,
    over: Callable[[Array, NDArray[np.intp]], Array],
) -> tuple[NDArray[np.intp], Array, str]:
    """Go from instant to instant; return the points reached, values there and why it stopped.

    Where the difference is likely and changes much on the way, it is gone again in shorter ways.
    From ``rest`` on a washer that is as warm as it shall be stays so.
    """
    status = Status(follower.go(inputs[0], inputs[0], 0.0))
    reached, rows = [0], [follower.out[PLACES].copy()]
    ahead = instants[:0:-1]
    most = MOST + len(ahead)
    while ahead and not status.is_failure:
        a, b = reached[-1], ahead[-1]
        if a >= rest and over(rows[-1][np.newaxis], np.array([a])).max() < LIKELY:
            break
        before = follower.state.copy()
        status = Status(follower.go(inputs[a], inputs[b], float(time[b] - time[a])))
        here = follower.out[PLACES].copy()
        both = np.minimum(over(np.array([rows[-1], here]), np.array([a, b])), CLEAR)
        turns = bool(both.max() > LIKELY and np.abs(both[1] - both[0]).max() > TURN)
        if b - a > 1 and len(reached) + len(ahead) < most and (status.is_failure or turns):
            follower.state[:] = before
            ahead.append(a + max(1, (b - a) // 4))
            status = Status.OK
            continue
        if not status.is_failure:
            reached.append(ahead.pop())
            rows.append(here)
    return np.array(reached), np.array(rows), status.advice if status.is_failure else ""


def _longest(
    name: str, time: Array, steady: Array, followed: Array, beyond: NDArray[np.bool_]
) -> Difference | None:
    """Return the longest interval of points beyond a limit, at its maximum difference."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], beyond, [False])).astype(int)))
    intervals = [(float(time[b - 1] - time[a]), a, b) for a, b in edges.reshape(-1, 2).tolist()]
    if not intervals:
        return None
    lasts, a, b = max(intervals)
    k = a + int(np.abs(followed[a:b] - steady[a:b]).argmax())
    return Difference(name, float(time[k]), float(steady[k]), float(followed[k]), lasts)
