"""Run a shift: connect the instances of a scene, step them to the end, and read the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from . import book, course
from .adaptive import check_adaptive, run_adaptive
from .agreement import check_agreement
from .chatter import find_chatter
from .costs import Meter
from .figures import key_figures
from .guard import Guard
from .guard_plan import Plan
from .judder_search import find_judder
from .loop import Loop, PythonLoop, Run
from .master import MASTERS
from .moves import Correct
from .parts import PACK_INPUTS, links
from .recorder import Recorder
from .result import Cost, ShiftResult
from .scene import Scene
from .steps import Steps, fixed
from .system import ConnectedPart, Stepping, System
from .thermal_need import thermal_need

Progress = Callable[[int, int], None]
STRETCH = 0.02  # s between two looks at the progress, at least


def run_shift(
    scene: Scene,
    instances: Mapping[str, Stepping],
    *,
    step: float | None = None,
    master: str | None = None,
    guards: Mapping[str, Plan] | None = None,
    progress: Progress | None = None,
    compiled: bool | None = None,
) -> ShiftResult:
    """Simulate a shift with living instances and return everything about it.

    Parameters
    ----------
    scene : what to simulate; ``scene.with_options`` first if step or master are to differ, since
        the transmission's parameters depend on the master
    instances : one per part of the scene, made with ``scene.parts[name].parameters()`` and not
        initialized since they were made or reset; they are neither closed nor reset here
    step, master : other values than the scene's
    guards : part -> how its rung is watched and what may take over (``run_auto`` makes them)
    progress : called as ``progress(done, total)`` a hundred times at most, and at the end
    compiled : step the instances in one compiled function; default: if all of them are FMUs. The
        numbers are the same to the bit

    Raises
    ------
    ParameterError, SolveError : the message names part and time; among them instances that were
        made with other parameters than the scene's, or stepped before
    """
    made_for, scene = scene, scene.with_options(step=step, master=master)
    messages = _remarks(made_for, scene)
    system = connected(scene, instances)
    plans = guards or {}
    if MASTERS[scene.master].adaptive:
        check_adaptive(scene, bool(plans), compiled)
        system.initialize(scene.start_time)
        check_agreement(made_for, instances)
        meter, begin = Meter(scene, system, {}), perf_counter()
        run, steps = run_adaptive(scene, system, progress)
        wall = perf_counter() - begin
        return _result(scene, run, steps, wall, meter.costs(wall, None), messages, None)
    run = _laid_out(scene, system, messages)
    system.initialize(scene.start_time)
    check_agreement(made_for, instances)
    run.recorder.keep(0)
    guard = Guard(run, plans, lambda now: loop_for(now, compiled)) if plans else None
    advance = guard.advance if guard else loop_for(run, compiled).advance
    meter, n = Meter(scene, system, plans), len(run.time) - 1
    begin = perf_counter()
    _drive(advance, n, progress)
    wall = perf_counter() - begin
    costs = meter.costs(wall, guard)
    return _result(scene, run, fixed(n, run.h), wall, costs, messages, guard)


def _laid_out(scene: Scene, system: System, messages: list[str]) -> Run:
    """Return times, commands, moves and rows of a run; say it if the step had to be adapted."""
    span = scene.stop_time - scene.start_time
    n = max(1, round(span / scene.step))
    h = span / n
    if abs(h / scene.step - 1.0) > 1e-9:
        messages.append(f"the step is {h:.9g} s so that {n} steps end at the stop time")
    time = scene.start_time + h * np.arange(n + 1, dtype=np.float64)
    commands = np.array([scene.command(t) for t in time.tolist()])
    schedule = MASTERS[scene.master].schedule(system)
    return Run(system, schedule, time, h, commands, Recorder(system, n + 1))


def _result(
    scene: Scene, run: Run, steps: Steps, wall: float, cost: list[Cost], messages: list[str],
    guard: Guard | None,
) -> ShiftResult:  # fmt: skip
    """Read everything from the rows of a finished run."""
    time, signals = run.time, run.recorder.signals()
    found = course.events(scene, time, signals)
    swing = find_judder(scene, time, signals)
    log = guard.log() if guard else None
    spent = sum(c.wall_time for c in cost) + (log.seconds if log else 0.0)
    return ShiftResult(
        scene=scene,
        step=run.h,
        steps=steps,
        master=scene.master,
        time=time,
        signals=signals,
        events=found,
        phases=course.phases(scene, signals, found),
        energy=book.energy(signals),
        key_figures=key_figures(scene, time, signals, found, swing),
        cost=cost,
        wall_time=wall,
        overhead=wall - spent,
        real_time_factor=(scene.stop_time - scene.start_time) / wall,
        messages=[
            *messages,
            *_said(run),
            *steps.words(),
            *_advice(time, signals),
            *_thermal(scene, time, signals),
        ],
        guard=log,
        judder=swing,
        chatter=find_chatter(scene, time, signals, run.h),
    )


def _said(run: Run) -> list[str]:
    """Return what the master itself has to say."""
    return [line for m in run.schedule if isinstance(m, Correct) for line in m.change.words()]


def _drive(advance: Callable[[int, int], int], n: int, progress: Progress | None) -> None:
    """Carry the run to its end in stretches that a person at a terminal does not notice."""
    done, stretch = 0, max(1, n // 100)
    while done < n:
        begin, stop = perf_counter(), min(done + stretch, n)
        while done < stop:
            done = advance(done, stop)
        if progress is not None:
            progress(done, n)
        if perf_counter() - begin < STRETCH:
            stretch *= 2


def loop_for(run: Run, compiled: bool | None) -> Loop:
    """Return the compiled loop where it can run, else the one in Python."""
    if compiled is False:
        return PythonLoop(run)
    from .program import CompiledLoop, can_compile

    if can_compile(run):
        return CompiledLoop(run)
    if compiled:
        raise ParameterError(
            "compiled = True, allowed: with FMUs for all parts and master 'gauss-seidel' or "
            "'jacobi', on a 64-bit machine where numba compiles"
        )
    return PythonLoop(run)


def connected(scene: Scene, instances: Mapping[str, Stepping]) -> System:
    """Return the parts of a scene wired up, with the command of the start; not yet initialized."""
    missing = [name for name in scene.parts if name not in instances]
    if missing:
        raise ParameterError(f"instances: {', '.join(missing)} missing, the scene has them")
    parts = {n: ConnectedPart(n, p.spec, instances[n]) for n, p in scene.parts.items()}
    gearbox = scene.parts["transmission"].params
    carries_on = gearbox.coupling == "capacity" and gearbox.capacity_extrapolation
    system = System(
        parts, links(gearbox.coupling, set(parts)), carries_on=PACK_INPUTS if carries_on else ()
    )
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
    if "washer" not in scene.parts and gearbox.washers:
        remarks.append("there is no washer model in this scene: the washers run without drag")
    return remarks


def _thermal(
    scene: Scene, time: NDArray[np.float64], signals: dict[str, NDArray[np.float64]]
) -> list[str]:
    """Say which thermal mode the washer needs, if there is one."""
    need = thermal_need(scene, time, signals)
    return [] if need is None else [need]


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
