"""Connected instances: what is asked of them, their inputs, and where these come from.

An instance is anything with the methods of ``Stepping``: an FMU that is kept alive, or the kernels
called in this process. Both kinds save their state and give slopes; ``saves_state`` and
``gives_derivatives`` tell if an FMU can. An FMU also gives the addresses of its C functions, for
the compiled loop.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, Protocol, cast

from ...errors import ParameterError, SolveError
from ...model.spec import ModelSpec
from ..scene.connections import COMMAND, Link

INITIAL_SWEEPS = 4


class Stepping(Protocol):
    """What a master needs from an instance."""

    input_names: list[str]
    output_names: list[str]
    calls: int
    wall_time: float
    instantiate_time: float
    initialize_time: float

    def initialize(self, start_time: float, inputs: Mapping[str, float]) -> None:
        """Set the inputs at the start and solve there."""

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set all inputs, in the order of ``input_names``."""

    def step(self, t: float, h: float) -> None:
        """Advance from ``t`` to ``t + h``."""

    def outputs(self) -> list[float]:
        """Return all outputs, in the order of ``output_names``."""


class Capable(Stepping, Protocol):
    """All that an instance may be able to do; ask before: ``saves_state`` and the like."""

    def reset(self) -> None:
        """Go back to the parameters of the start, to be initialized again."""

    def get_state(self) -> Any:
        """Return a handle of the complete state."""

    def set_state(self, state: object) -> None:
        """Go back to a state."""

    def free_state(self, state: object) -> None:
        """Give a state back."""

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return how outputs change along a direction of the inputs, memory held."""

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name, parameters among them."""

    def machine(self) -> Any:
        """Return the addresses of the C functions, as ``fmu.running.protocol`` lists them."""

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call with this status means; ``stage``: "set", "step" or "get"."""


def can(instance: Stepping, ability: str) -> bool:
    """Tell if an instance has an ability: "saves_state" or "gives_derivatives"."""
    return bool(getattr(instance, ability, False))


def capable(instance: Stepping) -> Capable:
    """Return the same instance as one that can do all of it."""
    return cast(Capable, instance)


class ConnectedPart:
    """One instance, its present inputs and outputs, and the sources of its inputs."""

    def __init__(self, name: str, spec: ModelSpec, instance: Stepping) -> None:
        self.name, self.spec, self.instance = name, spec, instance
        self.input_names = [s.name for s in spec.inputs]
        self.output_names = [s.name for s in spec.outputs]
        for kind in ("input", "output"):
            found, expected = (getattr(one, f"{kind}_names") for one in (instance, self))
            if list(found) != expected:
                raise ParameterError(
                    f"{name}: the instance has the {kind}s {', '.join(found)}, "
                    f"{spec.name} of this version has {', '.join(expected)}; build it again"
                )
        self.inputs = [float(s.start or 0.0) for s in spec.inputs]
        self.outputs = [0.0] * len(self.output_names)
        self.sources: list[tuple[int, ConnectedPart, int]] = []

    def connect(self, link: Link, source: "ConnectedPart") -> None:
        """Take an input from an output of another part."""
        self.sources.append(
            (self.input_names.index(link.input), source, source.output_names.index(link.output))
        )

    def pull(self) -> None:
        """Take the inputs over from the last outputs of the other parts."""
        inputs = self.inputs
        for slot, source, output in self.sources:
            inputs[slot] = source.outputs[output]

    def initialize(self, time: float) -> None:
        """Start the instance with the present inputs."""
        with _named(self.name, time):
            self.instance.initialize(time, dict(zip(self.input_names, self.inputs, strict=True)))
            self.outputs = self.instance.outputs()

    def refresh(self, time: float) -> None:
        """Set the present inputs without a step and read the outputs."""
        with _named(self.name, time):
            self.instance.set_inputs(self.inputs)
            self.outputs = self.instance.outputs()

    def step(self, t: float, h: float) -> None:
        """Advance with the present inputs and read the outputs."""
        try:
            self.instance.set_inputs(self.inputs)
            self.instance.step(t, h)
            self.outputs = self.instance.outputs()
        except (ParameterError, SolveError) as problem:
            raise renamed(problem, self.name, t) from problem


def renamed(problem: Exception, part: str, time: float) -> SolveError:
    """Return the same problem with part and time in front."""
    return SolveError(f"{part} at t = {time:g} s: {problem}")


@contextmanager
def _named(part: str, time: float) -> Iterator[None]:
    """Name part and time if something fails inside."""
    try:
        yield
    except (ParameterError, SolveError) as problem:
        raise renamed(problem, part, time) from problem


class System:
    """All parts of a shift, connected; the shift command comes from outside.

    ``hub`` is the part that moves, ``transmission`` here; all others answer its speeds with
    torques. ``carries_on``: its inputs that it carries on over a step as they changed in the last.
    """

    def __init__(
        self,
        parts: Mapping[str, ConnectedPart],
        links: Sequence[Link],
        *,
        hub: str = "transmission",
        carries_on: Sequence[str] = (),
    ) -> None:
        self.parts = dict(parts)
        self.transmission = self.parts[hub]
        self.friction_parts = [p for n, p in self.parts.items() if n != hub]
        self.carries_on = frozenset(carries_on)
        names = self.transmission.input_names
        self._command = names.index(COMMAND) if COMMAND in names else None
        for link in links:
            self.parts[link.target].connect(link, self.parts[link.source])

    def set_command(self, value: float) -> None:
        """Set the shift command for the end of the coming step."""
        if self._command is not None:
            self.transmission.inputs[self._command] = value

    def initialize(self, time: float) -> None:
        """Start all parts and pass signals round until loads and torques belong together."""
        self.transmission.initialize(time)
        for part in self.friction_parts:
            part.pull()
            part.initialize(time)
        for _ in range(INITIAL_SWEEPS):
            self.transmission.pull()
            self.transmission.refresh(time)
            for part in self.friction_parts:
                part.pull()
                part.refresh(time)
