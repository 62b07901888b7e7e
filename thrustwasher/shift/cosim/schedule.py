"""What a master does in a communication step: a list of actions, the same in every step."""

from typing import Any, NamedTuple

from .system import ConnectedPart, System


class Pull(NamedTuple):
    """A part takes its inputs over from the last outputs of the other parts."""

    part: ConnectedPart


class Correct(NamedTuple):
    """The inputs of a part are changed before it steps.

    ``change`` is called with start ``t`` and length ``h`` of a step; its ``words()`` are what a
    reader of the run has to know.
    """

    part: ConnectedPart
    change: Any


class Step(NamedTuple):
    """A part advances with its present inputs."""

    part: ConnectedPart


Schedule = list[Pull | Correct | Step]


def gauss_seidel(system: System) -> Schedule:
    """Return the sequential schedule: friction parts, then the transmission with fresh torques.

    A sump steps last: it gets the heats of its own step, however long that is.
    """
    parts = sorted((*system.friction_parts, system.transmission), key=lambda p: p.name == "sump")
    return [action for part in parts for action in (Pull(part), Step(part))]


def jacobi(system: System) -> Schedule:
    """Return the parallel schedule: all parts step with the outputs of the last point."""
    parts = list(system.parts.values())
    return [*map(Pull, parts), *map(Step, parts)]


def carry_out(schedule: Schedule, t: float, h: float) -> None:
    """Do what a schedule says for the step from ``t`` to ``t + h``."""
    for action in schedule:
        if isinstance(action, Step):
            action.part.step(t, h)
        elif isinstance(action, Pull):
            action.part.pull()
        else:
            action.change(t, h)
