"""A scene (driveline, sensor, load, exchange) and its run with packs that are FMUs."""

from __future__ import annotations

import csv
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np

from .plants import Driveline, ideal_slips
from .units import Unit

FRICTION, FACES, RADIUS = 0.12, 4, 0.075  # of the pack; its capacity is their product times load
LEVER = FRICTION * FACES * RADIUS  # N m per N
CLOSED, STRIBECK, CONSTANT, TABLE = 1, 3, 2, 3  # fidelity, law of friction
PACK = {
    "fidelity": CLOSED,
    "friction_law": CONSTANT,
    "friction_temperature_slope": 0.0,  # version 0.22.0 has friction fall with temperature
    "constant_friction": FRICTION,
    "effective_radius": RADIUS,
    "steel_thickness": 0.02,  # cool, so that no other warning comes
}
HOLDING = {"identified": 1, "given": 2, "off": 3}
INPUTS = ("load", "speed")
OUTPUTS = ("friction_torque", "temperature", "torque_capacity", "energy", "slip_bound")
TELLING = (5, 7, 8, 13)  # CHATTER, UNANSWERED, REFUTED, NO_EVENT
Sensor = Callable[[float, float, float], float]  # time and both speeds -> slip seen


@dataclass
class Scene:
    """A driveline, what acts on it, and what is judged.

    ``load(t, slips)``: capacity of each pack [N m]; ``outside(t)``: torques on the shafts;
    ``age``: steps after which a torque acts; ``sensor``: of both speeds (packs' slips if None);
    ``inertia``: what each pack is told with ``holding`` = given; ``repeats``: steps of the unit
    in a step of the driveline. ``capacity``, ``first``, ``inertia`` make the slip of one step.
    """

    plant: Driveline
    times: Sequence[float]
    load: Callable[[float, Sequence[float]], Sequence[float]]
    outside: Callable[[float], Sequence[float]]
    capacity: float
    first: float
    inertia: Sequence[float]
    age: int = 0
    sensor: Sensor | None = None
    pack: dict[str, float] = field(default_factory=dict)
    repeats: int = 1
    exact: bool = False
    quantum: float = 0.0
    sigma: float = 0.0
    judged: int = -1  # the pack whose lock counts
    watched: Sequence[int] = ()  # steps from which a torque has 20 steps to settle
    torque_at: Callable[[float], float] | None = None  # right torque while held
    late: int = 0  # steps more that an engagement may take

    @property
    def per_step(self) -> float:
        """Slip that the capacity takes away in a step [rad/s]."""
        return self.capacity * (self.times[1] - self.times[0]) / self.whole

    @property
    def whole(self) -> float:
        """Inertia that the slip of the judged pack sees."""
        return sum(self.inertia) if self.judged < 0 else self.inertia[self.judged]

    @cached_property
    def ideal(self) -> tuple[np.ndarray, np.ndarray]:
        """Slips and torques of ideal packs."""
        return ideal_slips(self.plant, self.outside, self.load, self.times)


@dataclass
class Trace:
    """What came out: one row per step, one column per pack."""

    times: np.ndarray  # of the steps' starts
    steps: np.ndarray
    slip: np.ndarray  # true, at the start
    seen: np.ndarray
    torque: np.ndarray  # the unit's, after the step
    acted: np.ndarray  # what acted on the driveline in the step
    mean: np.ndarray  # mean true slip over the step
    energy: np.ndarray
    temperature: np.ndarray
    capacity: np.ndarray
    bound: np.ndarray
    locked: np.ndarray
    status: np.ndarray
    messages: list[str]
    failed: int
    final: np.ndarray = field(default_factory=lambda: np.zeros(0))

    @property
    def told(self) -> bool:
        """A status or a message named the matter."""
        return bool(self.messages) or bool(np.isin(self.status, TELLING).any()) or self.failed > 0

    def write(self, path: Path) -> None:
        """Write the first pack's columns."""
        names = "times slip seen torque acted energy temperature capacity bound locked status"
        with path.open("w", newline="") as file:
            out = csv.writer(file)
            out.writerow(names.split())
            columns = [np.asarray(getattr(self, n)) for n in names.split()]
            for k in range(len(self.times)):
                row = [c[k] if c.ndim == 1 else c[k, -1] for c in columns]
                out.writerow([f"{float(v):.9g}" for v in row])


def packs(fmu: str, scene: Scene, holding: str) -> list[Unit]:
    """Return the packs of a scene, initialized."""
    loads = [c / LEVER for c in scene.load(0.0, scene.plant.slip)]
    units = []
    for i, slip in enumerate(scene.plant.slip):
        given: dict[str, float] = {"holding": HOLDING[holding]}
        if holding == "given":
            given |= {"coupling_inertia": scene.inertia[i], "coupling_age": scene.age}
        units.append(Unit(fmu, INPUTS, OUTPUTS, **(PACK | scene.pack | given)))
        units[-1].start(load=loads[i], speed=slip)
    return units


def run(fmu: str, scene: Scene, holding: str) -> Trace:
    """Run a scene; all packs step at once, then the driveline."""
    plant, n = scene.plant.copy(), scene.plant.packs
    units = packs(fmu, scene, holding)
    start = [u.real[u.at["friction_torque"]] for u in units]
    waiting = deque([start] * scene.age)
    rows = []
    for t, end in pairwise(scene.times):
        h, slip = end - t, plant.slip
        seen = slip
        if scene.sensor:
            seen = [scene.sensor(t, float(plant.state[0]), float(plant.state[1]))] * n
        loads = scene.load(t, seen)
        torque, row = [], []
        for i, unit in enumerate(units):
            for part in range(scene.repeats):
                unit.set(loads[i] / LEVER, seen[i])
                unit.step(t + part * h / scene.repeats, h / scene.repeats)
            torque.append(unit.real[0])
            row.append((*unit.real, unit.locked, unit.status))
        waiting.append(torque)
        acted = waiting.popleft()
        plant.advance(scene.outside(t), acted, h)
        mean = 0.5 * (np.array(slip) + plant.slip)
        rows.append((t, h, slip, seen, acted, mean, row))
    return collected(rows, units, plant.slip)


def collected(rows: list, units: list[Unit], final: Sequence[float]) -> Trace:
    """Return rows as a trace and free the units."""
    columns = list(zip(*rows, strict=True))
    t, h, slip, seen, acted, mean = (np.array(column) for column in columns[:6])
    data = np.array([[list(map(float, one)) for one in row] for row in columns[6]])
    found = {name: data[..., k] for name, k in units[0].at.items()}
    bound = found.get("slip_bound", np.full(slip.shape, np.nan))
    messages = [text for unit in units for text in unit.told()]
    failed = sum(unit.failed for unit in units)
    for unit in units:
        unit.close()
    return Trace(
        times=t,
        steps=h,
        slip=slip,
        seen=seen,
        torque=found["friction_torque"],
        acted=acted,
        mean=mean,
        energy=found["energy"],
        temperature=found["temperature"],
        capacity=found["torque_capacity"],
        bound=bound,
        locked=data[..., -2] > 0,
        status=data[..., -1].astype(int),
        messages=messages,
        failed=failed,
        final=np.asarray(final),
    )
