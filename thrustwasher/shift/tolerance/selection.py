"""Which levels of a part may serve in a run, cheapest first.

The inputs are those that a first run with the cheapest levels has recorded. Where a table of
measured errors speaks of a washer or a mesh, levels that it shows to be too coarse are left out. Of
packs it does not decide: it knows one kind of engagement, and the check compares the level with the
next one in the engagement at hand.
"""

import numpy as np

from ...errors import SolveError
from ...ladder.choose import levels_of
from ...ladder.error_table import SAFETY, fresh_levels
from ...ladder.formats import shown_error
from ..scene.connections import DIRECT, JUDGED, PACKS, SPEED, WITHOUT_PAST
from ..scene.scene import Part, Scene
from ..shift_result import ShiftResult
from .selection_record import Box, Scale, Selected

# Of the tolerance requested the levels have this share; the step has 0.3, the rest is spare. A
# torque that is evaluated by itself has all of it: it follows from the inputs of the moment.
MODEL_SHARE = 0.6
FLOOR = 0.1  # of the scene's range: below it differences count as if the value were this large
LEAST_RISE = 1.0  # K; a temperature that hardly moves is not compared more closely
TORQUE = "friction_torque"


def first_level(part: Part, is_checked: bool) -> str:
    """Return a part's level in the first run: the cheapest, or the default if unchecked."""
    levels = levels_of(part.spec, part.params)
    known = is_checked or levels[0] in fresh_levels(part.spec.key, part.params)
    return levels[0] if known else part.spec.default_fidelity


def select(scene: Scene, first: ShiftResult, is_checked: bool = True) -> list[Selected]:
    """Return the levels that may serve of every part that asks for a tolerance, by a first run.

    Unless the run ``is_checked`` afterwards, which covers what lies between the points of a table,
    its errors count times a factor of safety. SolveError: by its table no level holds.
    """
    safety = 1.0 if is_checked else SAFETY
    return [_selected(n, p, first, safety) for n, p in scene.parts.items() if p.tolerance]


def _selected(name: str, part: Part, first: ShiftResult, safety: float) -> Selected:
    spec, share = part.spec, (part.tolerance or 0.0) * (1.0 if name in DIRECT else MODEL_SHARE)
    levels = levels_of(spec, part.params)
    start = first.scene.parts[name].fidelity
    levels = levels[levels.index(start) :]
    box = _inputs(name, part, first)
    errors = _errors(part, box, safety)
    fitting = [level for level in levels if errors.get(level, 0.0) <= share]
    if not fitting:
        best = min(errors, key=lambda level: errors[level])
        raise SolveError(
            f"part {name!r}, {TORQUE}: no fidelity level reaches {100.0 * share:.2g} %; the "
            f"best is {best} "
            f"with {shown_error(errors[best], None)}; ask for less or name a fidelity level"
        )
    level, asked = fitting[0], f"(asked {shown_error(share, None)})"
    words = [f"{name}: {level}, its last fidelity level; no table of errors speaks here"]
    if level in errors:
        words = [f"{name}: {level}, {TORQUE} within {shown_error(errors[level], None)} {asked}"]
    elif len(fitting) > 1:
        words = [f"{name}: {level}, to be compared with {fitting[1]} {asked}"]
    words += [
        f"  too coarse: {level} {shown_error(errors[level], None)}"
        for level in levels
        if level not in fitting
    ]
    scales = tuple(_scale(name, output, first) for output in JUDGED[spec.key])
    return Selected(name, tuple(fitting), share, level in errors, tuple(words), box, scales)


def _inputs(name: str, part: Part, run: ShiftResult) -> Box:
    """Return the minimum and maximum value of each input while the part moves."""
    signals = {s.name: run.signals[f"{name}.{s.name}"] for s in part.spec.inputs}
    moves = signals[SPEED] != 0.0 if SPEED in signals else slice(None)
    found = {n: values[moves] if values[moves].size else values for n, values in signals.items()}
    return {n: (float(values.min()), float(values.max())) for n, values in found.items()}


def _errors(part: Part, box: Box, safety: float) -> dict[str, float]:
    """Return the largest error of each level that a table knows, in what it covers of a box."""
    if part.spec.key not in WITHOUT_PAST:
        return {}
    known = fresh_levels(part.spec.key, part.params)
    found = {name: level.worst(TORQUE, level.common(box)) for name, level in known.items()}
    return {name: safety * worst for name, worst in found.items() if worst is not None}


def _scale(part: str, output: str, run: ShiftResult) -> Scale:
    """Return what differences of an output count against, by its range in a run."""
    if output == "temperature":  # of the hotter pack: what a scene is evaluated by
        rises = [float(np.ptp(run.signals[f"{pack}.{output}"])) for pack in PACKS]
        return Scale(output, max(LEAST_RISE, *rises), relative=False)
    largest = float(np.abs(run.signals[f"{part}.{output}"]).max())
    return Scale(output, FLOOR * largest or 1e-12)
