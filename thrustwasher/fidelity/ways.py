"""Ways to solve a model that can be measured: the package's rungs and meshes, and rivals."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from importlib import import_module
from typing import Any

import numpy as np

from ..errors import Status
from ..models._prepare import filled
from ..models._spec import ModelSpec
from ..models._tables import fill_table
from .cases import Case
from .measure import Answer
from .timing import empty_step

STEP = 0.01  # how far apart warm calls are in the first input, relative


_empty_step = cache(empty_step)


def way_to(case: Case) -> tuple[tuple[float, ...], ...]:
    """Return the points to walk over: those before, one per cent beside the case, the case.

    The last step is as long as those whose cost is measured: error and cost are of the same call.
    """
    first, *others = case.point
    return (*case.before, (first * (1.0 - STEP), *others), case.point)


class KernelWay:
    """The kernel of a model at a rung, or the washer's on a mesh of one's own."""

    def __init__(self, spec: ModelSpec, fidelity: str, grid: tuple[int, int] | None = None) -> None:
        kernel: Any = import_module(f"thrustwasher.kernels.{spec.kernel}")
        self._kernel, self._spec = kernel, spec
        self._n_state, self._n_work = kernel.NSTATE, kernel.NWORK
        if grid is None:
            self._par = filled(spec, spec.params(), fidelity, kernel.NPAR, kernel.derive)
        else:
            from ..kernels.washer_layout import N_HEAD
            from ..kernels.washer_workspace import size_of_state, size_of_work
            from ..models.washer_constants import constants

            self._par = constants(spec.params(), grid)
            self._n_state = size_of_state(*grid)
            self._n_work = N_HEAD + size_of_work(*grid)
        self._work = np.zeros(self._n_work)
        self.build_s = 0.0
        if grid is None:
            fill_table(spec, spec.params(), self._par, self._work)
            if fidelity == "map":
                from ..models.washer_map import map_for

                self.build_s = float(map_for(spec.params()).card["build_s"])
        self._out, self._iout = np.empty(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        self._real = [s.name for s in spec.outputs if s.kind == "real"]
        places = [(t, *where.split(":")) for t, where in spec.counts[:1]]
        self._place = [
            int(getattr(import_module(f"thrustwasher.kernels.{module}"), name))
            for _, module, name in places
        ]
        self._nodes = 1 if grid is None else grid[0] * grid[1]

    def _walk(self, case: Case) -> tuple[Any, int, float]:
        """Return state, status and count after walking to a case from nothing."""
        state, count, status = np.zeros(self._n_state), 0.0, 0
        for point in way_to(case):
            status = self._kernel.step(
                self._par, np.array(point), state, self._work, self._out, self._iout, 0.0, 1.0
            )
            count = float(self._work[self._place[0]]) if self._place else 1.0
        return state, status, count

    def solve(self, case: Case) -> Answer:
        """Solve a case, warm at the last."""
        _, status, count = self._walk(case)
        advice = int(self._iout[-1])
        values = dict(zip(self._real, self._out.tolist(), strict=True))
        return Answer(values, Status(status or advice), count * self._nodes)

    def warm(self, case: Case) -> Callable[[], object]:
        """Return a call that goes back and forth over one per cent of the first input."""
        state, _, _ = self._walk(case)
        return self._call(case, state, self._kernel.step)

    def idle(self, case: Case) -> Callable[[], object]:
        """Return the call with an empty function in the kernel's place."""
        return self._call(case, np.zeros(self._n_state), _empty_step())

    def _call(self, case: Case, state: Any, step: Any) -> Callable[[], object]:
        first, *others = case.point
        points = [np.array((first * (1.0 + s * 0.5 * STEP), *others)) for s in (-1.0, 1.0)]
        par, work, out, iout = self._par, self._work, self._out, self._iout
        turn = 0

        def call() -> None:
            nonlocal turn
            turn = 1 - turn
            step(par, points[turn], state, work, out, iout, 0.0, 1.0)

        return call


class Way2006:
    """The washer by the method of 2006."""

    def __init__(self, **settings: Any) -> None:
        from ..rivals.plain2006 import Plain2006

        self._make: Callable[[], Any] = partial(Plain2006, **settings)
        nodes = settings.get("grid", (9, 67))
        self._nodes = nodes[0] * nodes[1]

    def solve(self, case: Case) -> Answer:
        """Solve a case, warm at the last."""
        washer, status = self._at(case)
        values = {
            "friction_torque": washer.friction_torque, "temperature": washer.temperature,
            "film_thickness": washer.film_thickness,
        }  # fmt: skip
        return Answer(values, status, float(washer.sweeps * self._nodes))

    def _at(self, case: Case) -> tuple[Any, Status]:
        washer, status = self._make(), Status.OK
        for point in way_to(case):
            status = washer.solve(*point)
        return washer, status

    def warm(self, case: Case) -> Callable[[], object]:
        """Return a call that goes back and forth over one per cent of the load."""
        washer, _ = self._at(case)
        load, *others = case.point
        turn = -1.0

        def call() -> None:
            nonlocal turn
            turn = -turn
            washer.solve(load * (1.0 + turn * 0.5 * STEP), *others)

        return call

    def idle(self, case: Case) -> None:
        """Return nothing: a call from Python is nothing beside a solve."""
