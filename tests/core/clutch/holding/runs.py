"""What a host records of a driveline and its unit, and the judges of it.  SI units."""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Run:
    """Arrays over the steps; slip, work and states are those at the end of a step."""

    first: float  # the largest slip at the start, the measure of the judges
    time: np.ndarray
    slip: np.ndarray
    acting: np.ndarray
    given: np.ndarray
    capacity: np.ndarray
    work: np.ndarray  # done on the pack since the start
    locked: np.ndarray
    energy: np.ndarray
    warned: np.ndarray
    states: np.ndarray | None = None


def as_run(first, rows, states=None):
    return Run(abs(first), *np.frombuffer(rows).reshape(-1, 9).T.copy(), states)


def reversals(run: Run, begin=0, end=None, level=1e-3) -> int:
    """How often the slip changes sign, with slips up to level * first left out."""
    slip = run.slip[begin:end]
    signs = np.sign(slip[np.abs(slip) > level * run.first])
    return int(np.count_nonzero(signs[1:] != signs[:-1]))


def lock_step(run, instant, end=None, level=1e-6):
    """The step at whose end the slip is zero to level * first, and stays so until step `end`."""
    moving = np.flatnonzero(np.abs(run.slip[:end]) >= level * run.first)
    step = int(moving[-1]) + 1 if moving.size else 0
    step = max(step, int(np.searchsorted(run.time, instant)))
    return step if step < len(run.slip[:end]) else None


def steps_to_lock(run, instant, end=None, level=1e-6):
    """Step ends from the exact instant to lock: 1 where the step it is in ends locked."""
    step = lock_step(run, instant, end, level)
    before = int(np.searchsorted(run.time, instant))
    return math.inf if step is None else step - before + 1


def late_errors(run, instant, holding, after=20):
    """Errors `after` steps past the exact lock: torque over capacity, slip over the first one."""
    n = int(np.searchsorted(run.time, instant)) + after
    wanted = np.broadcast_to(holding, run.acting.shape)[n]
    return abs(run.acting[n] - wanted) / run.capacity[n], abs(run.slip[n]) / run.first


def max_late_slip(run, instant, after=20, end=None):
    """The largest slip from `after` steps past the exact lock on, over the first slip."""
    n = int(np.searchsorted(run.time, instant)) + after
    return float(np.max(np.abs(run.slip[n:end]))) / run.first


def work_error(run, work):
    """The error of the work on the pack at the end, as a share of the exact work."""
    return abs(float(run.work[-1]) - work) / abs(work)


def energy_error(run):
    """The error of the unit's energy at the end, as a share of the work on the pack."""
    return abs(float(run.energy[-1] - run.work[-1])) / abs(float(run.work[-1]))
