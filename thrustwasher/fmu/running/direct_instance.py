"""The kernels of a model stepped in this process: the same face as an FMU instance, without FMU."""

from collections.abc import Mapping, Sequence
from time import perf_counter
from typing import Any, Self

import numpy as np

from ...errors import FIRST_FAILURE, ParameterError, SolveError, Status, suggestion
from ...model.registry import kernel_of
from ...model.spec import ModelSpec
from ..description.interface import Variable, interface
from ..model_kernels import seed_length
from .core import Core
from .snapshot import from_bytes


class Stepped:
    """What all instances have: counters, and their end at that of a ``with``."""

    calls, wall_time, initialize_time = 0, 0.0, 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def free_state(self, state: object) -> None:
        """Do nothing: a state is an ordinary object."""

    def close(self) -> None:
        """Do nothing: the memory goes with the object."""


class DirectInstance(Stepped):
    """The kernels of a model in this process, without an FMU."""

    def __init__(self, spec: ModelSpec, *, parameters: Mapping[str, object] | None = None) -> None:
        start = perf_counter()
        self.spec = spec
        self.shown = interface(spec)
        self._inputs = [v.reference for v in self.shown.inputs]
        self._outputs = [v.reference for v in self.shown.outputs]
        self.input_names = [s.name for s in spec.inputs]
        self.output_names = [s.name for s in spec.outputs]
        self._parameters = dict(parameters or {})
        self._sens = getattr(kernel_of(spec), "sens", None)
        self.saves_state, self.gives_derivatives = True, self._sens is not None
        self.reset()
        self.instantiate_time = perf_counter() - start

    def reset(self) -> None:
        """Go back to the start values and the parameters given at construction."""
        self.core = Core(self.shown)
        items = self.shown.enumerations
        for name, value in self._parameters.items():
            v = self._find(name, "parameter")
            numbers = {i.name: i.value for i in items.get(v.type_name or "", ())}
            self.core.set([v.reference], [number(name, value, numbers)], v.type)

    def initialize(
        self, start_time: float = 0.0, inputs: Mapping[str, float] | None = None
    ) -> None:
        """Set the inputs at the start and solve there; after steps only if ``reset``."""
        start = perf_counter()
        if self.core.state.any():  # an FMU would refuse; here the memory would go on silently
            raise ParameterError(
                f"{self.spec.name} was stepped before and stands at t = {self.core.time:g} s; "
                "call reset() before it is initialized again"
            )
        self.core.begin(start_time)
        for name, value in (inputs or {}).items():
            self.core.set([self._find(name, "input").reference], [float(value)], "Real")
        self.core.leave_initialization()
        self.initialize_time = perf_counter() - start

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set the inputs in their order; those that ``values`` does not reach stay as they are."""
        start = perf_counter()
        self.core.set(self._inputs[: len(values)], values, "Real")
        self.wall_time += perf_counter() - start

    def set_rates(self, rates: Sequence[float]) -> None:
        """Let the inputs, in their order, move straight in the next step [their unit/s]."""
        self.core.set_rates(self._inputs[: len(rates)], rates)

    def step(self, t: float, h: float) -> None:
        """Advance from ``t`` to ``t + h``; SolveError if there is no solution."""
        start = perf_counter()
        self.calls += 1
        try:
            self.core.advance(t, h)
        finally:
            self.wall_time += perf_counter() - start

    def outputs(self) -> list[float]:
        """Return all outputs."""
        start = perf_counter()
        self.core.refresh()
        values = list(map(float, self.core.stored(self._outputs)))
        self.wall_time += perf_counter() - start
        return values

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name."""
        found = [self._find(name) for name in names]
        return [float(self.core.get([v.reference], v.type)[0]) for v in found]

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return how real outputs change along a direction, memory held.

        ``knowns`` are inputs, and tunable parameters that the model differentiates over.
        """
        if self._sens is None:
            raise SolveError(f"{self.spec.name} has no derivatives")
        core = self.core
        along, slopes = np.zeros(seed_length(kernel_of(self.spec))), np.zeros_like(core.out)
        tuned = [v.name for v in self.shown.parameters if v.variability == "tunable"]
        seeded = {name: len(core.inp) + k for k, name in enumerate(tuned)}
        for name, value in zip(knowns, seed, strict=True):
            place = seeded.get(name, len(along))
            along[place if place < len(along) else self._find(name, "input").slot] += value
        places = [self._find(name, "output").slot for name in unknowns]
        core.refresh()
        # What a derivative starts from lies in `work`, which any other solve may have overwritten.
        core.solve_aside()
        rc = self._sens(core.par, core.inp, core.state, core.work, along, slopes)
        if rc >= FIRST_FAILURE:
            raise SolveError(f"{self.spec.name} has no derivative here: {Status(rc).advice}")
        return [float(slopes[place]) for place in places]

    def _find(self, name: str, causality: str | None = None) -> Variable:
        """Return a variable by name, of any causality or of one."""
        known = {v.name: v for v in self.shown.variables if causality in (None, v.causality)}
        return known.get(name) or unknown(name, list(known))

    def get_state(self) -> Any:
        """Return the complete state."""
        return self.core.snapshot()

    def set_state(self, state: Any) -> None:
        """Go back to a state."""
        self.core.restore(state)

    def serialize(self, state: Any) -> bytes:
        """Return a state as bytes."""
        data: bytes = state.to_bytes()
        return data

    def deserialize(self, data: bytes) -> Any:
        """Return the state in bytes of ``serialize``."""
        return from_bytes(data)


def unknown(name: str, known: list[str]) -> Any:
    """Raise ParameterError for a name that is not among the known ones."""
    hint = suggestion(name, known, "; did you mean {}?", f", allowed: {', '.join(known)}")
    raise ParameterError(f"there is no variable {name!r} here{hint}")


def number(name: str, value: Any, items: Mapping[str, int]) -> float:
    """Return a value as a number; an enumeration may be given by the name of its item."""
    if isinstance(value, str):
        if value not in items:
            raise ParameterError(f"{name} = {value!r}, allowed: {', '.join(items) or 'a number'}")
        return items[value]
    return float(value)
