"""Scatter of a slip that was found by the recorded torque: the torque's own, summed up."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....numerics.jit import Array
from ..traces.binned import Run
from ..traces.traced import Traced

TORQUE = "friction_torque"
STEPS = 12  # of slip in each engagement, between which responses are straight


def slip_scatter(
    points: Traced, changes: Mapping[str, Any], *, inertia: float
) -> tuple[Array, Array]:
    """Return what scatter of the recorded torque does, by the slip and by itself.

    A mean of torque that lies higher by its standard deviation makes all slip behind it lower, and
    is itself one of the values that are fitted: the two do not scatter independently.

    Parameters
    ----------
    points : runs whose slip ``slip_by_torque`` found
    changes : parameters [SI] next to those of the part
    inertia : [kg m2] that the torque slows

    Returns
    -------
    (changes of the computed values, changes of the measured ones), (n, means) each, a column for
    one standard deviation of each mean of torque
    """
    moved, known = [], []
    here = points.computed(changes)[0]
    for k, run in enumerate(points.runs):
        deviation = run.scatter[TORQUE] / np.sqrt(np.maximum(run.counts[TORQUE], 1.0))
        own = points.run_of == k
        row = points.row - points.starts[k]
        for number in range(1, int(run.engaged.max(initial=0)) + 1):
            members = np.flatnonzero(run.engaged == number)
            falls = deviation[members] * _widths(run.time[members]) / inertia
            step = float(np.sqrt(np.sum(falls**2)))
            if not step:
                continue
            steps = members[np.unique(np.linspace(0, len(members) - 1, STEPS).astype(int))]
            slower = (_slower(run, members[members >= i], step) for i in steps)
            found = np.array(
                [(points.with_run(k, r).computed(changes)[0] - here) / step for r in slower]
            )
            found = np.where(np.isfinite(found), found, 0.0)
            moved.append(falls * _between(run.time[members], run.time[steps], found).T)
            hit = own[:, None] & (row[:, None] == members)
            known.append(np.sign(points.value)[:, None] * np.where(hit, deviation[members], 0.0))
    if not moved:
        return np.zeros((len(here), 0)), np.zeros((len(here), 0))
    return np.hstack(moved), np.hstack(known)


def _widths(time: Array) -> Array:
    """Return the part of time that each torque counts for, by the trapezoidal rule."""
    half = 0.5 * np.diff(time)
    return np.asarray(np.append(half, 0.0) + np.append(0.0, half))


def _slower(run: Run, after: NDArray[np.int64], fall: float) -> Run:
    """Return a run with less slip [rad/s] at some of its means, not through 0."""
    slip = run.inputs["speed"].copy()
    slip[after] = np.sign(slip[after]) * np.maximum(np.abs(slip[after]) - fall, 0.0)
    return replace(run, inputs={**run.inputs, "speed": slip})


def _between(time: Array, steps: Array, rows: Array) -> Array:
    """Return rows at times between those of ``rows``, straight in between."""
    right = np.clip(np.searchsorted(steps, time, "right"), 1, max(len(steps) - 1, 1))
    if len(steps) < 2:
        return np.repeat(rows, len(time), axis=0)
    share = ((time - steps[right - 1]) / (steps[right] - steps[right - 1]))[:, None]
    return np.asarray((1.0 - share) * rows[right - 1] + share * rows[right])
