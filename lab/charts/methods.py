"""Methods to solve a model that can be measured, and the package's own: its compiled levels."""

import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from thrustwasher.errors import Status
from thrustwasher.model.prepare import fill_table, filled, tables_of
from thrustwasher.model.registry import kernel_of
from thrustwasher.model.spec import ModelSpec
from thrustwasher.studio.verification.costs import idle_step

STEP = 0.01  # how far apart warm calls are in the first input, relative


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
        """Return the same call without the solving, or None if that is nothing compared with it."""


def path_to(case: ChartCase) -> tuple[tuple[float, ...], ...]:
    """Return the points to walk over: those before, one per cent next to the case, the case.

    The last step is as long as those whose cost is measured: error and cost are of the same call.
    """
    first, *others = case.point
    return (*case.before, (first * (1.0 - STEP), *others), case.point)


def neighbours(case: ChartCase) -> list[tuple[float, ...]]:
    """Return points half a per cent above and below a case in the first input."""
    first, *others = case.point
    return [(first * (1.0 + side * 0.5 * STEP), *others) for side in (1.0, -1.0)]


class KernelMethod:
    """The kernel of a model at a level."""

    def __init__(self, spec: ModelSpec, fidelity: str, **changes: Any) -> None:
        params, kernel = spec.params(**changes), kernel_of(spec)
        self._kernel, self._n_state, self._nodes = kernel, kernel.NSTATE, 1
        self._par = filled(spec, params, fidelity, kernel.NPAR, kernel.derive)
        self._work = np.zeros(kernel.NWORK)
        fill_table(spec, params, self._par, self._work)
        tables = tables_of(spec, fidelity)
        self.build_s = float(tables.find(params).metadata["build_s"]) if tables else 0.0
        self._out, self._iout = np.empty(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        self._real = spec.real_outputs
        # where the kernel leaves the first of its counts in ``work``
        self._count = next((place for _, place in spec.counted()), None)

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
        return self._call(case, self._kernel.step)

    def idle(self, case: ChartCase) -> Callable[[], object]:
        """Return the call with an empty function in the kernel's place."""
        return self._call(case, idle_step())

    def _call(self, case: ChartCase, step: Any) -> Callable[[], object]:
        state, _, _ = self._walk(case)
        points = itertools.cycle(map(np.array, neighbours(case)))
        par, work, out, iout = self._par, self._work, self._out, self._iout
        return lambda: step(par, next(points), state, work, out, iout, 0.0, 1.0)
