"""Methods to solve a model that can be measured: the package's rungs and meshes, and rivals."""

import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol

import numpy as np

from ...clutch.kernels import step as clutch_step
from ...clutch.kernels.layout import O_ENERGY, O_TEMPERATURE
from ...clutch.parameters import SPEC as CLUTCH
from ...clutch.parameters import ClutchParams
from ...command.kernels import step as command_step
from ...errors import Status
from ...model.prepare import fill_table, filled
from ...model.record import resolve
from ...model.registry import kernel_of
from ...model.spec import ModelSpec
from ...washer.kernel_arguments import constants
from ...washer.kernels.layout import N_HEAD
from ...washer.kernels.workspace import size_of_state, size_of_work
from ...washer.map.look_up import map_for
from ..reference_clutch import TIMES, engagement_corners
from ..rivals.plain2006 import Plain2006

STEP = 0.01  # how far apart warm calls are in the first input, relative
LEAST_STEP = 1e-9  # s


@dataclass(frozen=True)
class ChartCase:
    """An operating point in the order of the model's inputs, and the way to it.

    It is reached as a user would reach it: from rest over the points of ``before``, so that the
    branch is that of the history.
    """

    name: str
    point: tuple[float, ...]
    before: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True)
class MethodAnswer:
    """What a method says about a case."""

    values: Mapping[str, float]
    status: Status
    count: float  # of what the method counts


class Method(Protocol):
    """A method to solve a model, set up and with a memory of its own."""

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Solve a case on the way it is reached."""

    def warm(self, case: ChartCase) -> Callable[[], object]:
        """Return a call that solves one per cent away from the last such call."""

    def idle(self, case: ChartCase) -> Callable[[], object] | None:
        """Return the same call without the solving, or None if that is nothing beside it."""


def path_to(case: ChartCase) -> tuple[tuple[float, ...], ...]:
    """Return the points to walk over: those before, one per cent beside the case, the case.

    The last step is as long as those whose cost is measured: error and cost are of the same call.
    """
    first, *others = case.point
    return (*case.before, (first * (1.0 - STEP), *others), case.point)


def _neighbours(case: ChartCase) -> list[tuple[float, ...]]:
    """Return points half a per cent above and below a case in the first input."""
    first, *others = case.point
    return [(first * (1.0 + side * 0.5 * STEP), *others) for side in (1.0, -1.0)]


class KernelMethod:
    """The kernel of a model at a rung, or the washer's on a mesh of one's own."""

    def __init__(self, spec: ModelSpec, fidelity: str, grid: tuple[int, int] | None = None) -> None:
        kernel = self._kernel = kernel_of(spec)
        self._n_state, self._nodes, self.build_s = kernel.NSTATE, 1, 0.0
        if grid is None:
            self._par = filled(spec, spec.params(), fidelity, kernel.NPAR, kernel.derive)
            self._work = np.zeros(kernel.NWORK)
            fill_table(spec, spec.params(), self._par, self._work)
        else:
            self._par, self._n_state = constants(spec.params(), grid), size_of_state(*grid)
            self._work = np.zeros(N_HEAD + size_of_work(*grid))
            self._nodes = grid[0] * grid[1]
        if fidelity == "map":
            self.build_s = float(map_for(spec.params()).card["build_s"])
        self._out, self._iout = np.empty(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        self._real = spec.real_outputs
        # where the kernel leaves the first of its counts in ``work``
        self._count = int(resolve(spec.counts[0][1])) if spec.counts else None

    def _walk(self, case: ChartCase) -> tuple[Any, int, float]:
        """Return state, status and count after walking to a case from nothing."""
        state, count, status = np.zeros(self._n_state), 0.0, 0
        for point in path_to(case):
            status = self._kernel.step(
                self._par, np.array(point), state, self._work, self._out, self._iout, 0.0, 1.0
            )
            count = 1.0 if self._count is None else float(self._work[self._count])
        return state, status, count

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Solve a case, warm at the last."""
        _, status, count = self._walk(case)
        advice = int(self._iout[-1])
        values = dict(zip(self._real, self._out.tolist(), strict=True))
        return MethodAnswer(values, Status(status or advice), count * self._nodes)

    def warm(self, case: ChartCase) -> Callable[[], object]:
        """Return a call that goes back and forth over one per cent of the first input."""
        state, _, _ = self._walk(case)
        return self._call(case, state, self._kernel.step)

    def idle(self, case: ChartCase) -> Callable[[], object]:
        """Return the call with an empty function in the kernel's place."""
        return self._call(case, np.zeros(self._n_state), command_step.step)

    def _call(self, case: ChartCase, state: Any, step: Any) -> Callable[[], object]:
        points = itertools.cycle(map(np.array, _neighbours(case)))
        par, work, out, iout = self._par, self._work, self._out, self._iout
        return lambda: step(par, next(points), state, work, out, iout, 0.0, 1.0)


class Method2006:
    """The washer by the method of 2006."""

    def __init__(self, **settings: Any) -> None:
        self._make: Callable[[], Any] = partial(Plain2006, **settings)
        nodes = settings.get("grid", (9, 67))
        self._nodes = nodes[0] * nodes[1]

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Solve a case, warm at the last."""
        washer, status = self._at(case)
        values = {
            "friction_torque": washer.friction_torque, "temperature": washer.temperature,
            "film_thickness": washer.film_thickness,
        }  # fmt: skip
        return MethodAnswer(values, status, float(washer.sweeps * self._nodes))

    def _at(self, case: ChartCase) -> tuple[Any, Status]:
        washer, status = self._make(), Status.OK
        for point in path_to(case):
            status = washer.solve(*point)
        return washer, status

    def warm(self, case: ChartCase) -> Callable[[], object]:
        """Return a call that goes back and forth over one per cent of the load."""
        washer, _ = self._at(case)
        points = itertools.cycle(_neighbours(case))
        return lambda: washer.solve(*next(points))

    def idle(self, case: ChartCase) -> None:
        """Return nothing: a call from Python is nothing beside a solve."""


class ClutchMethod:
    """An engagement: the force rises within 0.1 s, the slip falls from 0.2 s to 0.6 s."""

    def __init__(self, fidelity: str, step: float) -> None:
        params = replace(ClutchParams(), input_course="linear")
        self._par = filled(CLUTCH, params, fidelity, clutch_step.NPAR, clutch_step.derive)
        self._n = round(TIMES[-1] / step)
        self._h = TIMES[-1] / self._n
        self._work = np.zeros(clutch_step.NWORK)
        self._out, self._iout = np.empty(clutch_step.NOUT), np.zeros(clutch_step.NIOUT, np.int32)

    def _inputs(self, case: ChartCase) -> Any:
        """Return force, slip and oil temperature at all points (n + 1, 3)."""
        time, force, slip = engagement_corners(*case.point[:2])
        t = self._h * np.arange(self._n + 1)
        oil = np.full_like(t, case.point[2])
        return np.column_stack([np.interp(t, time, force), np.interp(t, time, slip), oil])

    def _engage(self, inputs: Any, step: Any) -> int:
        """Step over the inputs, the last step next to nothing; return the worst status."""
        par, work, out, iout, h = self._par, self._work, self._out, self._iout, self._h
        state, status = np.zeros(clutch_step.NSTATE), 0
        for k, point in enumerate(inputs[:-1]):
            status = max(status, step(par, point, state, work, out, iout, k * h, h))
        # A step first brings the pack to its own time, then looks ahead: here the end counts.
        return max(
            status, int(step(par, inputs[-1], state, work, out, iout, TIMES[-1], LEAST_STEP))
        )

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Engage once."""
        status = self._engage(self._inputs(case), clutch_step.step)
        values = {
            "slip_energy": float(self._out[O_ENERGY]),
            "end_temperature": float(self._out[O_TEMPERATURE]),
        }
        return MethodAnswer(values, Status(status), float(self._n))

    def warm(self, case: ChartCase) -> Callable[[], object]:
        """Return a call that engages once."""
        inputs = self._inputs(case)
        return lambda: self._engage(inputs, clutch_step.step)

    def idle(self, case: ChartCase) -> Callable[[], object]:
        """Return the same with an empty step."""
        inputs = self._inputs(case)
        return lambda: self._engage(inputs, command_step.step)
