"""The chart of the clutch: engagements at every level and over the communication step."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from lab.charts.chart_series import Chart, Configuration, Quantity
from lab.charts.methods import ChartCase, KernelMethod, MethodAnswer
from thrustwasher.clutch.kernels.layout import O_ENERGY, O_TEMPERATURE
from thrustwasher.clutch.parameters import SPEC
from thrustwasher.errors import Status
from thrustwasher.model.spec import ModelSpec
from thrustwasher.studio.verification.reference_clutch import TIMES, engagement_corners

USUAL_STEP = 1e-3
STEPS = (2e-2, 1e-2, 5e-3, 2e-3, 5e-4)
LEAST_STEP = 1e-9  # s


class ClutchMethod(KernelMethod):
    """An engagement: the force rises within 0.1 s, the slip falls from 0.2 s to 0.6 s."""

    def __init__(self, fidelity: str, step: float) -> None:
        super().__init__(SPEC, fidelity, input_profile="linear")
        self._n = round(TIMES[-1] / step)
        self._h = TIMES[-1] / self._n

    def _inputs(self, case: ChartCase) -> Any:
        """Return force, slip, oil temperature and drum speed at all points (n + 1, 4)."""
        time, force, slip = engagement_corners(*case.point[:2])
        t = self._h * np.arange(self._n + 1)
        oil = np.full_like(t, case.point[2])
        force_at, slip_at = np.interp(t, time, force), np.interp(t, time, slip)
        return np.column_stack([force_at, slip_at, oil, np.zeros_like(t)])

    def _engage(self, inputs: Any, step: Any) -> int:
        """Step over the inputs, the last step next to nothing; return the worst status."""
        par, work, out, iout, h = self._par, self._work, self._out, self._iout, self._h
        state, status = np.zeros(self._n_state), 0
        for k, point in enumerate(inputs[:-1]):
            status = max(status, step(par, point, state, work, out, iout, k * h, h))
        # A step first brings the pack to its own time, then looks ahead: here the end counts.
        return max(
            status, int(step(par, inputs[-1], state, work, out, iout, TIMES[-1], LEAST_STEP))
        )

    def solve(self, case: ChartCase) -> MethodAnswer:
        """Engage once."""
        status = self._engage(self._inputs(case), self._kernel.step)
        values = {
            "slip_energy": float(self._out[O_ENERGY]),
            "end_temperature": float(self._out[O_TEMPERATURE]),
        }
        return MethodAnswer(values, Status(status), float(self._n))

    def _call(self, case: ChartCase, step: Any) -> Callable[[], object]:
        """Return a call that engages once."""
        inputs = self._inputs(case)
        return lambda: self._engage(inputs, step)


def _clutch(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every level, and those with a moving film over the communication step."""
    levels = [
        Configuration(
            "fidelity levels", name, "level", name, partial(ClutchMethod, name, USUAL_STEP), "steps"
        )
        for name in spec.levels
    ]
    steps = [
        Configuration(
            f"{name} over the step",
            f"{name}, {1e3 * h:g} ms",
            "step",
            f"{1e3 * h:g} ms",
            partial(ClutchMethod, name, h),
            "steps",
        )
        for name in ("field", "fine")
        for h in (STEPS[::2] if quick else STEPS)
    ]
    return levels + steps


CLUTCH = Chart(
    (Quantity("slip_energy", True), Quantity("end_temperature", False, unit="K")),
    "engagement of 0.6 s [s]",
    _clutch,
)
