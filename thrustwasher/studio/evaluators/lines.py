"""Solve lines of operating points; this is what runs in the workers.

A line starts without memory and is walked row by row: each point is solved warm from the one
before it. Where several solutions exist the path stays on its branch while that exists, as a
loaded washer does: going up in load the film is kept to its fold, coming down again it is
regained at the other one. A point that fails leaves the memory as it was.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from threading import get_ident
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FIRST_FAILURE, ParameterError, Status
from ...model.prepare import fill_table, filled, wants_table
from ...model.registry import find_model, kernel_of, spec_of
from ...model.spec import ModelSpec, Signal
from ...native.load import bound

Array = NDArray[np.float64]
Flags = NDArray[np.int32]


@dataclass(frozen=True)
class Task:
    """Some consecutive lines, complete with all that a worker needs to know."""

    model: str
    fidelity: str
    first_row: int
    inputs: Array  # (n, n_inputs)
    starts: tuple[int, ...]  # of the lines, from 0, and the end
    params: tuple[Any, ...]  # of each line; None: broken rule


def output_signals(spec: ModelSpec) -> tuple[tuple[Signal, ...], tuple[Signal, ...]]:
    """Return the real outputs of a row, and the whole-number ones with the status last."""
    left_out = find_model(spec.key).sweep.not_shown
    real = tuple(s for s in spec.outputs if s.kind == "real" and s.name not in left_out)
    whole = [s for s in spec.outputs if s.kind != "real" and s.name not in left_out]
    whole.sort(key=lambda s: s.name == "solver_status")
    return real, tuple(whole)


def solve_task(task: Task) -> tuple[Array, Flags]:
    """Return the real and the whole-number outputs of the rows; NaN where a row failed."""
    spec = spec_of(task.model)
    real, whole = output_signals(spec)
    numbers = np.empty((len(task.inputs), len(real)))
    flags = np.zeros((len(task.inputs), len(whole)), np.int32)
    walk = find_model(spec.key).sweep.walk or _walk_kernel
    for first, last, params in _alike(task):
        a, b = task.starts[first], task.starts[last]
        if params is None:
            flags[a:b, -1] = Status.BAD_INPUT
        else:
            rows = task.inputs[a:b], numbers[a:b], flags[a:b]
            try:
                starts = [s - a for s in task.starts[first : last + 1]]
                walk(spec, params, task.fidelity, *rows, starts)
                absent = spec.absent(params)
                numbers[a:b, [i for i, s in enumerate(real) if s.name in absent]] = np.nan
            except ParameterError:  # parameters that only the kernel's constants refuse
                flags[a:b, -1] = Status.BAD_INPUT
    numbers[flags[:, -1] >= FIRST_FAILURE] = np.nan
    return numbers, flags


def _alike(task: Task) -> Iterator[tuple[int, int, Any]]:
    """Give the first line, the one after the last and the parameters of lines that share them."""
    ends = [*np.flatnonzero([a is not b for a, b in pairwise(task.params)]) + 1, len(task.params)]
    for first, last in pairwise([0, *ends]):
        yield first, last, task.params[first]


def _walk_kernel(
    spec: ModelSpec, params: object, fidelity: str, inputs: Array, numbers: Array, flags: Flags,
    starts: Sequence[int],
) -> None:  # fmt: skip
    """Fill the rows of lines by steps of the model's kernel; each line starts without memory."""
    steps, n = _steps(spec, fidelity, params), len(inputs)
    inputs = np.ascontiguousarray(inputs)
    outs, statuses = np.empty((n, len(steps.out))), np.empty(n, np.int32)
    iouts = np.empty((n, len(steps.iout)), np.int32)
    for a, b in pairwise(starts):
        steps.state[:], steps.iout[:] = 0.0, 0
        steps.over(inputs[a:b], outs[a:b], iouts[a:b], statuses[a:b])
    real, whole = _places(spec.key)
    numbers[:], flags[:] = outs[:, real], iouts[:, whole]
    failed = statuses >= FIRST_FAILURE
    flags[failed, -1] = statuses[failed]


@lru_cache(maxsize=64)
def _places(model: str) -> tuple[list[int], list[int]]:
    """Return where in the kernel's ``out`` and ``iout`` the columns of a row stand."""
    spec = spec_of(model)
    every = (
        [s.name for s in spec.outputs if s.kind == "real"],
        [s.name for s in spec.outputs if s.kind != "real"],
    )
    real, whole = output_signals(spec)
    return [every[0].index(s.name) for s in real], [every[1].index(s.name) for s in whole]


@lru_cache(maxsize=64)
def _constants(model: str, fidelity: str, params: object) -> Array:
    """Return the kernel's ``par``; many lines share their parameters."""
    spec = spec_of(model)
    kernel = kernel_of(spec)
    par: Array = filled(spec, params, fidelity, kernel.NPAR, kernel.derive)
    return par


class _Steps:
    """A kernel's step on arrays that stay: looking at them takes longer than a step."""

    def __init__(self, spec: ModelSpec, fidelity: str | None, params: object) -> None:
        kernel = kernel_of(spec)
        self.par, self.state = np.zeros(kernel.NPAR), np.zeros(kernel.NSTATE)
        self.point, self.work = np.zeros(len(spec.inputs)), np.zeros(kernel.NWORK)
        self.out, self.iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        if fidelity is not None:
            fill_table(spec, params, _constants(spec.key, fidelity, params), self.work)
        self.kernel = kernel

    @cached_property
    def step(self) -> Callable[[float, float], int]:
        """The step on these arrays."""
        arrays = {"par": self.par, "inp": self.point, "state": self.state, "work": self.work}
        return bound(self.kernel.step, **arrays, out=self.out, iout=self.iout)

    def over(self, inputs: Array, outs: Array, iouts: Flags, statuses: Flags) -> None:
        """Step over rows of inputs; fill the outputs and statuses of each."""
        rows = getattr(self.kernel, "step_rows", None)
        if rows and len(inputs) > 1:
            rows(self.par, inputs, self.state, self.work, self.iout, outs, iouts, statuses)
            return
        point, step, out, iout = self.point, self.step, self.out, self.iout
        for i, row in enumerate(inputs):
            point[:] = row
            statuses[i] = step(0.0, 1.0)
            outs[i], iouts[i] = out, iout


def _steps(spec: ModelSpec, fidelity: str, params: object) -> _Steps:
    """Return this thread's step of a part; ParameterError: the level's table is missing."""
    par = _constants(spec.key, fidelity, params)
    table = (fidelity, params) if wants_table(spec, par) else (None, None)
    steps = _kept_steps(spec.key, *table, get_ident())
    steps.par[:] = par
    return steps


@lru_cache(maxsize=16)
def _kept_steps(model: str, fidelity: str | None, params: object, _thread: int) -> _Steps:
    """Return a step, with its table if it has one; no two threads have the same."""
    return _Steps(spec_of(model), fidelity, params)


def check_level(spec: ModelSpec, fidelity: str, params: object) -> None:
    """Raise ParameterError if a level lacks what it needs for the first parameters of a sweep."""
    if not find_model(spec.key).sweep.walk and params is not None:
        _steps(spec, fidelity, params)
