"""Two rungs of one part for the step in which one takes over from the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..models._spec import ModelSpec
from .system import Stepping


class Blend:
    """Steps two instances with the same inputs and returns a mix of their outputs.

    Real outputs are ``(1 - share) x old + share x new``: torques of one sign, each of which takes
    energy out, mix to one that does so too. Everything else is the new one's.
    """

    def __init__(self, spec: ModelSpec, old: Stepping, new: Stepping, share: float = 0.5) -> None:
        self.input_names, self.output_names = new.input_names, new.output_names
        self.old, self.new, self.share = old, new, share
        self._real = [signal.kind == "real" for signal in spec.outputs]
        pair: tuple[Any, Any] = old, new
        self._pair = pair
        self.saves_state, self.gives_derivatives = (
            all(getattr(i, able, False) for i in pair)
            for able in ("saves_state", "gives_derivatives")
        )
        self.calls, self.wall_time = 0, 0.0
        self.instantiate_time = self.initialize_time = 0.0

    def initialize(self, start_time: float, inputs: Mapping[str, float]) -> None:
        """Start both."""
        for instance in (self.old, self.new):
            instance.initialize(start_time, inputs)

    def set_inputs(self, values: Sequence[float]) -> None:
        """Hand the inputs to both."""
        for instance in (self.old, self.new):
            instance.set_inputs(values)

    def step(self, t: float, h: float) -> None:
        """Let both step."""
        for instance in (self.old, self.new):
            instance.step(t, h)

    def outputs(self) -> list[float]:
        """Return the mix."""
        s = self.share
        return [
            (1.0 - s) * a + s * b if real else b
            for a, b, real in zip(self.old.outputs(), self.new.outputs(), self._real, strict=True)
        ]

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return the mix of the derivatives of real outputs."""
        old, new = (i.directional_derivative(unknowns, knowns, seed) for i in self._pair)
        return [(1.0 - self.share) * a + self.share * b for a, b in zip(old, new, strict=True)]

    def get_state(self) -> tuple[Any, Any]:
        """Return the states of both."""
        old, new = self._pair
        return old.get_state(), new.get_state()

    def set_state(self, state: tuple[Any, Any]) -> None:
        """Let both go back."""
        for instance, its in zip(self._pair, state, strict=True):
            instance.set_state(its)

    def free_state(self, state: tuple[Any, Any]) -> None:
        """Give both states back."""
        for instance, its in zip(self._pair, state, strict=True):
            instance.free_state(its)
