"""After a run: a level that was chosen for it, compared with the one above.

The level above is solved at some thirty recorded points: those with the extremes of inputs and of
what is compared, those after changes of regime, and others spread over the run. A model whose
outputs follow from the inputs of the moment is solved at these points only; one with a past of its
own, such as a pack's film and temperature, follows the whole record, since it would have another
past in strides.
"""

from collections.abc import Callable, Sequence
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, SolveError, Status
from ...model.prepare import tables_of
from ...numerics.jit import Array
from ..cosim.system import Stepping
from ..scene.connections import SPEED, WITHOUT_PAST
from ..scene.scene import Part
from ..shift_result import ShiftResult
from .selection_record import Check, Difference, Selected

Places = NDArray[np.intp]
POINTS = 30
CHANGES = 8  # of those at most are points after a change of regime
NEAR = 5  # steps
REGIMES = ("regime", "solver_status", "distress")  # outputs whose change is a change of regime


def check_part(
    run: int, chosen: Selected, result: ShiftResult, take: Callable[[str, Part], Stepping]
) -> Check | None:
    """Compare the level of one part in a finished run with the one above; None: there is none.

    ``take`` returns an instance of a part by its name.
    """
    begin, part = perf_counter(), result.scene.parts[chosen.part]
    higher = chosen.after(part.fidelity)
    if higher is None:
        return None
    names = [s.name for s in part.spec.inputs]
    inputs = np.column_stack([result.signals[f"{chosen.part}.{name}"] for name in names])
    moving = _moving(names, inputs)
    looks_up = tables_of(part.spec, part.fidelity) is not None
    outside = _outside(chosen, result, moving) if looks_up else ""
    places = _points(chosen, result, inputs, moving)
    solved, failed = _solved(
        lambda: take(chosen.part, part.at(higher)),
        result.time,
        inputs,
        places,
        part.spec.key in WITHOUT_PAST,
    )
    worst = _farthest(chosen, part, result, solved)
    return Check(
        run,
        chosen.part,
        part.fidelity,
        higher,
        chosen.tolerance,
        len(solved),
        tuple(failed),
        worst,
        outside,
        perf_counter() - begin,
    )


def _moving(names: Sequence[str], inputs: Array) -> Places:
    """Return the points that can be compared: without speed no level has a torque, nor any heat."""
    if SPEED not in names:
        return np.arange(len(inputs))
    return np.flatnonzero(inputs[:, names.index(SPEED)])


def _outside(chosen: Selected, result: ShiftResult, moving: Places) -> str:
    """Say when a level that looks up left what it is verified for; empty if it did not."""
    status = result.signals.get(f"{chosen.part}.solver_status")
    left = moving[status[moving] == Status.OUTSIDE_VERIFIED] if status is not None else moving[:0]
    if not len(left):
        return ""
    return f"it says itself from t = {result.time[left[0]]:.4g} s that it is not verified"


def _points(chosen: Selected, result: ShiftResult, inputs: Array, moving: Places) -> list[int]:
    """Return the recorded points to compare at, in the order of time.

    None lies within ``NEAR`` steps of a change of regime, where outputs may jump: in another level
    they do so a step earlier or later.
    """
    signals = {name: result.signals.get(f"{chosen.part}.{name}") for name in REGIMES}
    regimes = [values for values in signals.values() if values is not None]
    changes = np.flatnonzero(np.any([np.diff(values) != 0.0 for values in regimes], axis=0)) + 1
    near = np.zeros(len(inputs) + NEAR, bool)
    for i in changes.tolist():
        near[max(i - NEAR, 0) : i + NEAR] = True
    calm = moving[~near[moving]]
    if not len(calm):
        return sorted(_spread(moving, POINTS))
    found = _spread(np.intersect1d(changes + NEAR, calm), CHANGES)
    judged = [result.signals[f"{chosen.part}.{scale.output}"] for scale in chosen.scales]
    for values in (*inputs.T, *judged):
        seen = values[calm]
        found |= {int(calm[seen.argmin()]), int(calm[seen.argmax()])}
    return sorted(found | _spread(calm, max(POINTS - len(found), POINTS // 2)))


def _spread(places: Places, n: int) -> set[int]:
    """Return at most ``n`` of the places, first and last included."""
    chosen = np.linspace(0, len(places) - 1, min(n, len(places))).round().astype(int)
    return set(places[chosen].tolist())


def _solved(
    take: Callable[[], Stepping], time: Array, inputs: Array, places: list[int], strides: bool
) -> tuple[dict[int, list[float]], list[str]]:
    """Return an instance's outputs at recorded points, and where it gave none.

    ``strides``: it may go from one of the places to the next; else it takes every recorded step.
    """
    outputs: dict[int, list[float]] = {}
    failed: list[str] = []
    reached, required = None, set(places)
    for i in places if strides else range(max(places, default=-1) + 1):
        try:
            if reached is None:
                instance = take()
                known = dict(zip(instance.input_names, inputs[i].tolist(), strict=True))
                instance.initialize(float(time[i]), known)
            else:
                instance.set_inputs(inputs[i].tolist())
                instance.step(float(time[reached]), float(time[i] - time[reached]))
            reached = i
            if i in required:
                outputs[i] = instance.outputs()
        except (ParameterError, SolveError) as problem:
            failed.append(f"at t = {time[i]:.4g} s: {problem}")
            if reached is None and not strides:
                break
    return outputs, failed


def _farthest(
    chosen: Selected, part: Part, result: ShiftResult, solved: dict[int, list[float]]
) -> Difference:
    """Return the largest difference of the two levels, the first that is no number if there is."""
    worst, names = Difference(0.0), [signal.name for signal in part.spec.outputs]
    for i, outputs in solved.items():
        for scale in chosen.scales:
            served = float(result.signals[f"{chosen.part}.{scale.output}"][i])
            other = outputs[names.index(scale.output)]
            share = scale.between(served, other)
            if share > worst.share:
                worst = Difference(share, scale.output, float(result.time[i]), served, other)
    return worst
