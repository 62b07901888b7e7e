"""Run a shift: connect the instances of a scene, step them to the end, and read the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from . import book, course
from .figures import key_figures
from .master import MASTERS
from .parts import links
from .result import Cost, ShiftResult
from .scene import Scene
from .system import ConnectedPart, Stepping, System

Progress = Callable[[int, int], None]


class _Recorder:
    """Rows for all inputs and outputs of one part, allocated once."""

    def __init__(self, part: ConnectedPart, n: int) -> None:
        self.part = part
        self.inputs = np.empty((n, len(part.input_names)))
        self.outputs = np.empty((n, len(part.output_names)))

    def keep(self, i: int) -> None:
        """Copy the present values to row ``i``."""
        self.inputs[i] = self.part.inputs
        self.outputs[i] = self.part.outputs

    def signals(self) -> dict[str, NDArray[np.float64]]:
        """Return the columns by name."""
        name = self.part.name
        columns = {f"{name}.{n}": self.inputs[:, i] for i, n in enumerate(self.part.input_names)}
        return columns | {
            f"{name}.{n}": self.outputs[:, i] for i, n in enumerate(self.part.output_names)
        }


def run_shift(
    scene: Scene,
    instances: Mapping[str, Stepping],
    *,
    step: float | None = None,
    master: str | None = None,
    progress: Progress | None = None,
) -> ShiftResult:
    """Simulate a shift with living instances and return everything about it.

    Parameters
    ----------
    scene : what to simulate; ``scene.with_options`` first if step or master are to differ, since
        the transmission's parameters depend on the master
    instances : one per part of the scene, made with ``scene.parts[name].parameters()``; they are
        neither closed nor reset here
    step, master : other values than the scene's
    progress : called as ``progress(done, total)`` about a hundred times

    Raises
    ------
    ParameterError, SolveError : the message names part and time
    """
    asked = scene.with_options(step=step, master=master)
    messages = _remarks(scene, asked)
    scene = asked
    system = connected(scene, instances)
    parts = system.parts
    span = scene.stop_time - scene.start_time
    n = max(1, round(span / scene.step))
    h = span / n
    if abs(h / scene.step - 1.0) > 1e-9:
        messages.append(f"the step is {h:.9g} s so that {n} steps end at the stop time")
    time = scene.start_time + h * np.arange(n + 1, dtype=np.float64)
    recorders = [_Recorder(part, n + 1) for part in parts.values()]
    system.initialize(scene.start_time)
    for recorder in recorders:
        recorder.keep(0)
    spent_before = {name: p.instance.wall_time for name, p in parts.items()}
    calls_before = {name: p.instance.calls for name, p in parts.items()}

    advance = MASTERS[scene.master].advance
    every = max(1, n // 100)
    begin = perf_counter()
    for i in range(n):
        t = float(time[i])
        system.set_command(scene.command(float(time[i + 1])))
        advance(system, t, h)
        for recorder in recorders:
            recorder.keep(i + 1)
        if progress is not None and ((i + 1) % every == 0 or i + 1 == n):
            progress(i + 1, n)
    wall = perf_counter() - begin

    signals: dict[str, NDArray[np.float64]] = {}
    for recorder in recorders:
        signals |= recorder.signals()
    found = course.events(scene, time, signals)
    messages += _advice(time, signals)
    cost = []
    for name, part in parts.items():
        spent = part.instance.wall_time - spent_before[name]
        cost.append(
            Cost(
                part=name,
                model=part.spec.name,
                fidelity=scene.parts[name].fidelity,
                instantiate=part.instance.instantiate_time,
                initialize=part.instance.initialize_time,
                steps=part.instance.calls - calls_before[name],
                wall_time=spent,
                share=spent / wall,
            )
        )
    return ShiftResult(
        scene=scene,
        step=h,
        master=scene.master,
        time=time,
        signals=signals,
        events=found,
        phases=course.phases(scene, signals, found),
        energy=book.energy(signals),
        key_figures=key_figures(scene, time, signals, found),
        cost=cost,
        wall_time=wall,
        overhead=wall - sum(c.wall_time for c in cost),
        real_time_factor=span / wall,
        messages=messages,
    )


def connected(scene: Scene, instances: Mapping[str, Stepping]) -> System:
    """Return the parts of a scene wired up, with the command of the start; not yet initialized."""
    missing = [name for name in scene.parts if name not in instances]
    if missing:
        raise ParameterError(f"instances: {', '.join(missing)} missing, the scene has them")
    parts = {n: ConnectedPart(n, p.spec, instances[n]) for n, p in scene.parts.items()}
    coupling = scene.parts["transmission"].params.coupling
    system = System(parts, links(coupling, set(parts)))
    system.set_command(scene.command(scene.start_time))
    return system


def _remarks(made_for: Scene, scene: Scene) -> list[str]:
    """Return what a reader has to know before looking at any number."""
    remarks = []
    gearbox = scene.parts["transmission"].params
    if made_for.parts["transmission"].params.torque_age != gearbox.torque_age:
        remarks.append(
            f"the instances were made for master {made_for.master!r} and ran with "
            f"{scene.master!r}: capacities are extrapolated over the wrong time; "
            "make them from scene.with_options(master=...)"
        )
    if "mesh" not in scene.parts and gearbox.planet_teeth:
        remarks.append("there is no gear mesh model in this scene: the meshes run without loss")
    if "washer" in scene.parts:
        remarks.append(
            "washer temperatures are steady values at every instant; a washer needs 0.1 s to 6 s "
            "to warm up, so during a shift they are an upper bound"
        )
    elif gearbox.washers:
        remarks.append("there is no washer model in this scene: the washers run without drag")
    return remarks


def _advice(time: NDArray[np.float64], signals: dict[str, NDArray[np.float64]]) -> list[str]:
    """Return the advice behind every solver status that occurred, with its first time."""
    advice = []
    for name, values in signals.items():
        if not name.endswith(".solver_status"):
            continue
        for code in np.unique(values[values > 0.0]):
            i = int(np.argmax(values == code))
            status = Status(int(code))
            part = name.partition(".")[0]
            advice.append(f"{part} from t = {time[i]:.4g} s: {status.advice} ({status.name})")
    return advice
