"""Run a shift: connect the instances of a scene, step them to the end, and read the result."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import ceil
from time import perf_counter

import numpy as np

from ..errors import ParameterError, SolveError
from ..model.parameters import as_numbers
from ..numerics.jit import Array
from .checks.run_doubts import doubts, failed_because
from .cosim.loop import Recorder, Run, advance_in_python
from .cosim.schedule import Correct
from .cosim.system import ConnectedPart, Stepping, System, capable
from .key_figures.events_and_phases import find_events, find_phases
from .key_figures.key_figures import energy_balance, key_figures
from .masters.master import MASTERS
from .oscillation.chatter import find_chatter
from .oscillation.judder import find_judder
from .scene.connections import PACK_INPUTS, wired
from .scene.scene import Scene
from .shift_result import Cost, ShiftResult

Progress = Callable[[int, int], None]
INTERVAL = 0.02  # s between two looks at the progress, at least


def cosimulate(
    scene: Scene,
    instances: Mapping[str, Stepping],
    *,
    step: float | None = None,
    master: str | None = None,
    progress: Progress | None = None,
    compiled: bool | None = None,
    guard: bool = False,
) -> ShiftResult:
    """Simulate a shift with living instances and return everything about it.

    Parameters
    ----------
    scene : what to simulate; ``scene.with_options`` first if step or master are to differ, since
        the transmission's parameters depend on the master
    instances : one per part of the scene, made with ``scene.parts[name].parameters()`` and not
        initialized since they were made or reset; they are not closed here and, but for
        ``guard``, not reset
    step, master : other values than the scene's
    progress : called as ``progress(done, total)`` a hundred times at most, and at the end
    compiled : step the instances in one compiled function; default: if all of them are FMUs. The
        numbers are the same to the bit
    guard : check the run afterwards, as ``run_auto`` does: the same instances, reset, run once more
        with shorter steps, and washers that were taken as steady are followed in time

    Raises
    ------
    ParameterError, SolveError : the message names part and time; among them instances that were
        made with other parameters than the scene's, or stepped before
    """
    if scene.sequence is not None:
        raise ParameterError(f"scene {scene.name!r}: it has a [sequence], allowed: run_sequence")
    made_for, scene = scene, scene.with_options(step=step, master=master)
    messages, found = remarks(scene), _of_other_masters(made_for, scene)
    system = connected(scene, instances)
    run = laid_out(scene, system, messages)
    system.initialize(scene.start_time)
    check_instances(made_for, instances)
    before = {n: (part.instance.calls, part.instance.wall_time) for n, part in system.parts.items()}
    run.recorder.keep(0)
    advance = advance_of(run, compiled)
    begin = perf_counter()
    try:
        _drive(advance, len(run.time) - 1, progress)
    except (ParameterError, SolveError) as problem:
        why = failed_because(scene, run.time, run.recorder)
        message = f"{str(problem).rstrip('.')}; {why}" if why else str(problem)
        raise type(problem)(message) from (problem.__cause__ or problem)
    wall = perf_counter() - begin
    cost = _costs(scene, system, before, wall)
    messages += [
        line
        for action in run.schedule
        if isinstance(action, Correct)
        for line in action.change.words()
    ]
    signals = run.recorder.signals()
    result = result_of(scene, run.time, signals, run.h, wall, cost, messages, found)
    if not guard:
        return result
    from .checks.guard import guarded, reset

    return guarded(result, reset(instances), partial(cosimulate, compiled=compiled))


def laid_out(scene: Scene, system: System, messages: list[str]) -> Run:
    """Return times, commands, schedule and rows of a run; say it if the step had to be adapted."""
    span = scene.stop_time - scene.start_time
    n = max(1, ceil(span / scene.step - 1e-9))  # none is longer than requested
    h = span / n
    if abs(h / scene.step - 1.0) > 1e-9:
        messages.append(f"the step is {h:.9g} s so that {n} steps end at the stop time")
    time = scene.start_time + h * np.arange(n + 1, dtype=np.float64)
    commands = np.array([scene.command(t) for t in time.tolist()])
    schedule = MASTERS[scene.master].schedule(system)
    return Run(system, schedule, time, h, commands, Recorder(system, n + 1))


def _costs(
    scene: Scene, system: System, before: Mapping[str, tuple[int, float]], wall: float
) -> list[Cost]:
    """Return what every part's steps cost, by its own counts since those ``before``."""
    found = []
    for name, part in system.parts.items():
        instance, (calls, seconds) = part.instance, before[name]
        spent = instance.wall_time - seconds
        found.append(
            Cost(
                part=name,
                model=part.spec.name,
                fidelity=scene.parts[name].fidelity,
                steps=instance.calls - calls,
                wall_time=spent,
                share=spent / wall,
                instantiate=instance.instantiate_time,
                initialize=instance.initialize_time,
            )
        )
    return found


def result_of(
    scene: Scene,
    time: Array,
    signals: dict[str, Array],
    step: float,
    wall: float,
    cost: Sequence[Cost] = (),
    messages: Sequence[str] = (),
    found: Sequence[str] = (),
) -> ShiftResult:
    """Read everything from the signals of a finished run."""
    events = find_events(scene, time, signals)
    judder = find_judder(scene, time, signals)
    figures = key_figures(scene, time, signals, events, judder)
    return ShiftResult(
        scene=scene,
        step=step,
        master=scene.master,
        time=time,
        signals=signals,
        events=events,
        phases=find_phases(scene, signals, events),
        energy=energy_balance(signals),
        key_figures=figures,
        cost=list(cost),
        wall_time=wall,
        overhead=wall - sum(c.wall_time for c in cost),
        real_time_factor=(scene.stop_time - scene.start_time) / wall,
        messages=[*messages, *thrust_remarks(scene, signals)],
        found=(*found, *doubts(scene, step, time, signals, events, figures)),
        judder=judder,
        chatter=find_chatter(scene, time, signals, step),
    )


def _drive(advance: Callable[[int, int], None], n: int, progress: Progress | None) -> None:
    """Carry the run to its end in intervals that a person at a terminal does not notice."""
    done, interval = 0, max(1, n // 100)
    while done < n:
        begin, stop = perf_counter(), min(done + interval, n)
        advance(done, stop)
        done = stop
        if progress is not None:
            progress(done, n)
        if perf_counter() - begin < INTERVAL:
            interval *= 2


def advance_of(run: Run, compiled: bool | None) -> Callable[[int, int], None]:
    """Return what steps a run from one point to another: compiled where that can run."""
    if compiled is not False:
        from .cosim.compiled_layout import CompiledLoop, can_compile

        if can_compile(run):
            return CompiledLoop(run).advance
    if compiled:
        raise ParameterError(
            "compiled = True, allowed: with FMUs for all parts and master 'gauss-seidel' or "
            "'jacobi', on a 64-bit machine where numba compiles"
        )
    return partial(advance_in_python, run)


def connected(scene: Scene, instances: Mapping[str, Stepping]) -> System:
    """Return the parts of a scene wired up, with the command of the start; not yet initialized."""
    missing = [name for name in scene.parts if name not in instances]
    if missing:
        raise ParameterError(f"instances: {', '.join(missing)} missing, the scene has them")
    parts = {n: ConnectedPart(n, p.spec, instances[n]) for n, p in scene.parts.items()}
    gearbox = scene.parts["transmission"].params
    carries_on = gearbox.coupling == "capacity" and gearbox.capacity_extrapolation
    # A stand-in for a model may lack a signal: it is then not connected.
    wires = [
        k
        for k in wired(scene.parts)
        if k.input in parts[k.target].input_names and k.output in parts[k.source].output_names
    ]
    system = System(parts, wires, carries_on=PACK_INPUTS if carries_on else ())
    system.set_command(scene.command(scene.start_time))
    return system


def check_instances(scene: Scene, instances: Mapping[str, Stepping]) -> None:
    """Refuse initialized instances whose parameters are not those of the scene's parts.

    Inputs and outputs of a model are the same in every scene: an instance of another one would run
    without a complaint and answer another question. Instances without a ``get`` (stand-ins for a
    model) are taken as they are.
    """
    for name, part in scene.parts.items():
        instance = instances[name]
        if not hasattr(instance, "get"):
            continue
        names = [n for n in part.parameters() if n != "fidelity"]
        expected = dict(zip(names, as_numbers(part.params), strict=True))
        expected |= {n: x for n, x in part.parameters().items() if isinstance(x, float)}
        expected["fidelity"] = list(part.spec.fidelities).index(part.fidelity) + 1.0  # from 1 on
        found = capable(instance).get(list(expected))
        for key, has in zip(expected, found, strict=True):
            if has != expected[key]:
                raise ParameterError(
                    f"{name}: the instance was made with {key} = {has:.9g}, scene "
                    f"{scene.name!r} has {expected[key]:.9g}; make it with "
                    f"scene.parts[{name!r}].parameters()"
                )


def remarks(scene: Scene) -> list[str]:
    """Return what a reader has to know before looking at any number."""
    remarks = list(scene.notes)
    gearbox = scene.parts["transmission"].params
    if "mesh" not in scene.parts and gearbox.planet_teeth:
        remarks.append("there is no gear mesh model in this scene: the meshes run without loss")
    if "washer" not in scene.parts and gearbox.washers:
        remarks.append("there is no washer model in this scene: the washers run without drag")
    return remarks


def thrust_remarks(scene: Scene, signals: Mapping[str, Array]) -> list[str]:
    """Say which thrusts of a finished run rest on no bearing in the model."""
    free = [name for name, there in scene.bearings.items() if not there]
    thrust = float(np.max(signals["transmission.sun_thrust"]))
    if not free or thrust == 0.0:
        return []
    gears, tables = (" and ".join(form.format(n) for n in free) for form in ("the {}'s", "[{}]"))
    gears = gears.replace("_bearing", "")
    return [
        f"{gears} thrust of up to {thrust:.4g} N rests on no bearing in the model, whose friction "
        f"is left out; {tables} in the scene would add it"
    ]


def _of_other_masters(made_for: Scene, scene: Scene) -> list[str]:
    """Return a warning if instances were made for another master."""
    one, other = (s.parts["transmission"].params.torque_age for s in (made_for, scene))
    if one == other:
        return []
    return [
        f"The instances were made for master {made_for.master!r} and ran with {scene.master!r}: "
        "capacities are extrapolated over the wrong time; make them from "
        "scene.with_options(master=...)"
    ]
