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
_empty_step = cache(empty_step)


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
        force, slip, oil = case.point
        t = self._h * np.arange(self._n + 1)
        fallen = np.clip((t - FALL_FROM) / (END - FALL_FROM), 0.0, 1.0)
        return np.column_stack([
            force * np.minimum(t / RISE, 1.0), slip * (1.0 - (1.0 - LEFT) * fallen),
            np.full_like(t, oil),
        ])  # fmt: skip

    def _engage(self, course: Any, step: Any) -> tuple[int, float]:
        """Step over the course; return the worst status and the highest temperature."""
        par, work, out, iout, h = self._par, self._work, self._out, self._iout, self._h
        state, status, peak = np.zeros(kernel.NSTATE), 0, 0.0
        for k, point in enumerate(course):
            status = max(status, step(par, point, state, work, out, iout, k * h, h))
            peak = max(peak, out[O_TEMPERATURE])
        return status, float(peak)

    def solve(self, case: Case) -> Answer:
        """Engage once."""
        course = self._course(case)
        # the last step looks ahead beyond the end: what is shown is the heat up to it
        status, peak = self._engage(course[:-1], kernel.step)
        values = {"slip_energy": float(self._out[O_ENERGY]), "peak_temperature": peak}
        return Answer(values, Status(status), float(self._n))

    def warm(self, case: Case) -> Callable[[], object]:
        """Return a call that engages once."""
        course = self._course(case)
        return lambda: self._engage(course, kernel.step)

    def idle(self, case: Case) -> Callable[[], object]:
        """Return the same with an empty step."""
        course = self._course(case)
        return lambda: self._engage(course, _empty_step())
