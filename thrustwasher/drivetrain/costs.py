"""What every rung of every part cost in a run: counts and clocks of the instances."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .guard import Guard
from .guard_plan import Plan
from .result import Cost
from .scene import Scene
from .system import Stepping, System


class _Entry(NamedTuple):
    part: str
    model: str
    rung: str
    instance: Stepping
    calls: int
    wall_time: float


class Meter:
    """Reads the instances' own counts once at the start and once at the end."""

    def __init__(self, scene: Scene, system: System, guards: Mapping[str, Plan]) -> None:
        self._entries: list[_Entry] = []
        for name, part in system.parts.items():
            plan, model = guards.get(name), part.spec.name
            rung = plan.base if plan else scene.parts[name].fidelity
            self._add(name, model, rung, part.instance)
            if plan:
                self._add(name, model, plan.above, plan.instance)

    def _add(self, part: str, model: str, rung: str, instance: Stepping) -> None:
        counted = instance.calls, instance.wall_time
        self._entries.append(_Entry(part, model, rung, instance, *counted))

    def costs(self, wall: float, guard: Guard | None) -> list[Cost]:
        """Return what was spent since the start, without the guard's looks.

        A rung that never served is left out, unless it is the part's own.
        """
        looks = {s.part.name: s.looks for s in guard.sentries} if guard else {}
        found: list[Cost] = []
        for e in self._entries:
            calls, seconds = looks.get(e.part, {}).get(e.rung, (0, 0.0))
            steps = e.instance.calls - e.calls - int(calls)
            spent = e.instance.wall_time - e.wall_time - seconds
            if not steps and any(c.part == e.part for c in found):
                continue
            found.append(Cost(
                part=e.part, model=e.model, fidelity=e.rung, steps=steps, wall_time=spent,
                instantiate=e.instance.instantiate_time, initialize=e.instance.initialize_time,
                share=spent / wall,
            ))  # fmt: skip
        return found
