"""What is simulated: the parts of a shift with their parameters, times, oil and master."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

from ..errors import ParameterError
from ..models._spec import ModelSpec
from .master import MASTERS

MAX_STEPS = 500_000  # all signals of so many steps still fit into memory
STEP_RANGE = (1e-6, 1.0)  # s


@dataclass(frozen=True, kw_only=True)
class Part:
    """One part of a scene: its model, fidelity and parameters."""

    spec: ModelSpec
    fidelity: str
    params: Any

    def parameters(self) -> dict[str, Any]:
        """Return all parameters by name, the fidelity among them, as an FMU takes them."""
        values = {f.name: getattr(self.params, f.name) for f in fields(self.params)}
        return {**values, "fidelity": self.fidelity}


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A shift to be simulated; times in s, temperature in K."""

    name: str
    title: str
    description: str
    start_time: float
    stop_time: float
    step: float
    master: str
    oil_temperature: float
    shift_start: float
    shift_duration: float
    parts: dict[str, Part]

    def command(self, time: float) -> float:
        """Return the shift command: a ramp from 0 to 1."""
        if time <= self.shift_start:
            return 0.0
        if time >= self.shift_start + self.shift_duration:
            return 1.0
        return (time - self.shift_start) / self.shift_duration

    def with_options(
        self,
        *,
        step: float | None = None,
        master: str | None = None,
        stop_time: float | None = None,
    ) -> Scene:
        """Return the scene with another step, master or end; what hangs on them is adapted."""
        scene = replace(
            self,
            step=self.step if step is None else step,
            master=self.master if master is None else master,
            stop_time=self.stop_time if stop_time is None else stop_time,
        )
        return scene.checked()

    def checked(self) -> Scene:
        """Check what concerns several values; hand oil and master on to the transmission."""
        where = f"scene {self.name!r}"
        if self.master not in MASTERS:
            options = " or ".join(repr(n) for n in MASTERS)
            raise ParameterError(f"{where}: master = {self.master!r}, allowed: {options}")
        if not STEP_RANGE[0] <= self.step <= STEP_RANGE[1]:
            low, high = STEP_RANGE
            raise ParameterError(f"{where}: step = {self.step!r} s, allowed: {low:g} .. {high:g} s")
        span = self.stop_time - self.start_time
        if not self.step <= span <= MAX_STEPS * self.step:
            raise ParameterError(
                f"{where}: stop_time = {self.stop_time!r} s, allowed: start_time + 1 .. "
                f"{MAX_STEPS} steps of {self.step!r} s (start_time = {self.start_time!r} s)"
            )
        gearbox = self.parts["transmission"]
        params = replace(
            gearbox.params,
            oil_temperature=self.oil_temperature,
            torque_age=MASTERS[self.master].torque_age,
        )
        return replace(self, parts={**self.parts, "transmission": replace(gearbox, params=params)})
