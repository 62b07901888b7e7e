"""A clutch engaged at a rung and a communication step: what its charts are made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from ..errors import Status
from ..kernels import clutch_step as kernel
from ..kernels.clutch_layout import O_ENERGY, O_TEMPERATURE
from ..models._prepare import filled
from ..models.clutch_params import SPEC, ClutchParams
from .cases import Case
from .measure import Answer
from .timing import empty_step

RISE, FALL_FROM, END = 0.1, 0.2, 0.6  # s; as in an upshift
LEFT = 0.05  # of the slip at the end
LEAST_STEP = 1e-9  # s
_empty_step = cache(empty_step)


def corners(case: Case) -> tuple[list[float], list[float], list[float]]:
    """Return the points [s] between which force [N] and slip [rad/s] are straight, and both."""
    force, slip, _ = case.point
    return [0.0, RISE, FALL_FROM, END], [0.0, force, force, force], [slip, slip, slip, LEFT * slip]


class ClutchWay:
    """An engagement: the force rises within 0.1 s, the slip falls from 0.2 s to 0.6 s."""

    def __init__(self, fidelity: str, step: float) -> None:
        params = replace(ClutchParams(), input_course="linear")
        self._par = filled(SPEC, params, fidelity, kernel.NPAR, kernel.derive)
        self._n = round(END / step)
        self._h = END / self._n
        self._work = np.zeros(kernel.NWORK)
        self._out, self._iout = np.empty(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)

    def _course(self, case: Case) -> Any:
        """Return force, slip and oil temperature at all points (n + 1, 3)."""
        time, force, slip = corners(case)
        t = self._h * np.arange(self._n + 1)
        oil = np.full_like(t, case.point[2])
        return np.column_stack([np.interp(t, time, force), np.interp(t, time, slip), oil])

    def _engage(self, course: Any, step: Any) -> int:
        """Step over the course, the last step next to nothing; return the worst status."""
        par, work, out, iout, h = self._par, self._work, self._out, self._iout, self._h
        state, status = np.zeros(kernel.NSTATE), 0
        for k, point in enumerate(course[:-1]):
            status = max(status, step(par, point, state, work, out, iout, k * h, h))
        # A step first brings the pack to its own time, then looks ahead: here the end counts.
        return max(status, int(step(par, course[-1], state, work, out, iout, END, LEAST_STEP)))

    def solve(self, case: Case) -> Answer:
        """Engage once."""
        status = self._engage(self._course(case), kernel.step)
        values = {
            "slip_energy": float(self._out[O_ENERGY]),
            "end_temperature": float(self._out[O_TEMPERATURE]),
        }
        return Answer(values, Status(status), float(self._n))

    def warm(self, case: Case) -> Callable[[], object]:
        """Return a call that engages once."""
        course = self._course(case)
        return lambda: self._engage(course, kernel.step)

    def idle(self, case: Case) -> Callable[[], object]:
        """Return the same with an empty step."""
        course = self._course(case)
        return lambda: self._engage(course, _empty_step())
