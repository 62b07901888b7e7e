"""Which rung each part takes: from the cards, over the inputs that a scout has seen."""

from __future__ import annotations

from collections.abc import Mapping

from ..errors import ParameterError, SolveError
from ..fidelity.choose import Choice, choose
from ..models._spec import ModelSpec
from ..store.cards import fresh_cards
from .guard_plan import Scale
from .scene import Part, Scene
from .scout import Scouted
from .selection_record import Box, Selected

MODEL_SHARE = 0.6  # of the tolerance asked for is the rung's; the step has 0.3, the rest is spare
FLOOR = 0.1  # of the scene's range: below it differences count as if the value were this large
LEAST_RISE = 1.0  # K; a temperature that hardly moves is not compared more closely
# Models whose outputs follow from the inputs of the moment. A guard's second instance sees these in
# strides; of a model with a past of its own, such as a pack's film, it would have another past.
WITHOUT_PAST = ("washer", "gearmesh")
# What a part is judged by: quantity of its cards, output that a guard compares.
QUANTITIES: Mapping[str, tuple[tuple[str, str], ...]] = {
    "washer": (("friction_torque", "friction_torque"),),
    "clutch": (("friction_torque", "torque_capacity"), ("temperature", "temperature")),
    "gearmesh": (("friction_torque", "friction_torque"),),
}


def select(scene: Scene, scouted: Scouted, steps: int) -> list[Selected]:
    """Return the rung of every part that asks for a tolerance.

    Raises
    ------
    SolveError : no rung of a part holds its tolerance; the best one is named
    """
    return [
        _select(name, part, scouted, steps) for name, part in scene.parts.items() if part.tolerance
    ]


def above(spec: ModelSpec, rung: str) -> str | None:
    """Return the rung to compare with: the next one, not below the default; None for the last.

    Examples
    --------
    >>> from thrustwasher.models.gearmesh_params import SPEC
    >>> above(SPEC, "closed")
    'field'
    """
    rungs = list(spec.fidelities)
    place = max(rungs.index(rung) + 1, rungs.index(spec.default_fidelity))
    return rungs[place] if place < len(rungs) else None


def _select(name: str, part: Part, scouted: Scouted, steps: int) -> Selected:
    spec, box = part.spec, scouted.box(name, part.spec)
    share = MODEL_SHARE * (part.tolerance or 0.0)
    quantities = [(q, out) for q, out in QUANTITIES.get(spec.key, ()) if out in _names(spec)]
    scales = tuple(_scale(name, output, quantity, scouted) for quantity, output in quantities)
    speaking = [r for r in spec.fidelities if fresh_cards(spec.key, r, part.params)]
    if not speaking:
        rung, verified = spec.default_fidelity, False
        words: tuple[str, ...] = (
            f"{name}: {rung}, its default: no card speaks for these parameters; not guarded",
        )
        higher = above(spec, rung)
    else:
        choices = [
            _choose(name, part, box, quantity, share, scale, steps)
            for (quantity, _), scale in zip(quantities, scales, strict=True)
        ]
        rungs = list(spec.fidelities)
        best = max(choices, key=lambda c: rungs.index(c.fidelity))
        rung, verified = best.fidelity, True
        words = tuple(_renamed(line, spec.key, name) for c in choices for line in c.reasons)
        higher = above(spec, rung)
        beyond = best.outside.fidelity if best.outside else ""
        if spec.key not in WITHOUT_PAST:
            words += ("  not guarded: it has a past, which an instance in strides would not share",)
        if beyond and rungs.index(beyond) > rungs.index(rung):
            higher = beyond
    return Selected(name, spec.key, rung, higher, share, verified, words, box, scales)


def _choose(
    name: str, part: Part, box: Box, quantity: str, share: float, scale: Scale, steps: int
) -> Choice:
    """Ask the cards; a temperature's tolerance is the share of its range in the scene."""
    tolerance = share if scale.relative else share * scale.floor
    try:
        return choose(
            part.spec.key, box, quantity=quantity, tol=tolerance, n_calls=steps, params=part.params
        )
    except (ParameterError, SolveError) as problem:
        raise type(problem)(f"part {name!r}, {quantity}: {problem}") from problem


def _scale(part: str, output: str, quantity: str, scouted: Scouted) -> Scale:
    low, high = scouted.seen(part, output)
    if quantity == "temperature":
        return Scale(output, max(high - low, LEAST_RISE), relative=False)
    return Scale(output, FLOOR * max(abs(low), abs(high)) or 1e-12)


def _names(spec: ModelSpec) -> list[str]:
    return [signal.name for signal in spec.outputs]


def _renamed(line: str, model: str, part: str) -> str:
    """Let the first line of a choice name the part, not the model."""
    return part + line.removeprefix(model) if line.startswith(f"{model}:") else f"  {line}"
