"""Which rung each part takes.

A part that is not judged by itself keeps its default rung if the finest rungs of all such parts
together do not move the trial runs' figures by more than the rungs' share of the tolerance. For the
others the cards decide, over the inputs that the trial runs have seen.
"""

from ...errors import ParameterError, SolveError
from ...ladder.card import fresh_cards
from ...ladder.choose import Choice, choose
from ...model.spec import ModelSpec
from ..scene.connections import DIRECT, PACKS, QUANTITIES, WITHOUT_PAST
from ..scene.scene import Part, Scene
from .selection_record import Box, Scale, Selected
from .trial_run import TrialRuns, farthest, finest_of

# Of the tolerance asked for the rungs have this share; the step has 0.3, the rest is spare. A
# torque that is judged by itself has all of it: it follows from the inputs of the moment.
MODEL_SHARE = 0.6
SAFETY = 1.5  # on the cards' errors where nothing checks what lies between their points
FLOOR = 0.1  # of the scene's range: below it differences count as if the value were this large
LEAST_RISE = 1.0  # K; a temperature that hardly moves is not compared more closely


def select(scene: Scene, trials: TrialRuns, steps: int, is_checked: bool = True) -> list[Selected]:
    """Return the rung of every part that asks for a tolerance; SolveError if none holds it.

    ``steps`` are those of the run to come. Unless the run ``is_checked`` afterwards, which covers
    what lies between the cards' points, their errors count times a factor of safety.
    """
    open_ = {name: part for name, part in scene.parts.items() if part.tolerance}
    return [
        _by_trial(name, part, trials) or _by_cards(name, part, trials, steps, is_checked)
        for name, part in open_.items()
    ]


def above(spec: ModelSpec, rung: str) -> str | None:
    """Return the rung to compare with: the next one, not below the default; None for the last."""
    rungs = list(spec.fidelities)
    place = max(rungs.index(rung) + 1, rungs.index(spec.default_fidelity))
    return rungs[place] if place < len(rungs) else None


def still_verified(chosen: Selected, part: Part, box: Box) -> bool:
    """Tell if the cards of the chosen rung hold its tolerance over another box as well."""
    quantities = [q for q, out in QUANTITIES[chosen.model] if out in _names(part.spec)]
    safety = 1.0 if chosen.model in WITHOUT_PAST else SAFETY
    try:
        for quantity, scale in zip(quantities, chosen.scales, strict=True):
            _choose(
                chosen.part, part, box, quantity, chosen.tolerance, scale, 1, safety, chosen.rung
            )
    except (ParameterError, SolveError):
        return False
    return True


def _by_trial(name: str, part: Part, trials: TrialRuns) -> Selected | None:
    """Return the default rung if nothing that is judged depends on it."""
    if name in DIRECT:
        return None
    spec, share = part.spec, MODEL_SHARE * (part.tolerance or 0.0)
    rung = spec.default_fidelity
    if rung == finest_of(spec):
        words = f"{name}: {rung}, its default and its finest"
    elif trials.finest is None or not farthest(trials.coarse, trials.finest)[0] <= share:
        return None
    else:
        words = f"{name}: {rung}, its default: {_moved(trials)}, {100.0 * share:.2g} % allowed"
    box = trials.box(name, spec)
    return Selected(name, spec.key, rung, None, share, False, (words,), box, ())


def _moved(trials: TrialRuns) -> str:
    """Say what the finest rungs of all parts that are not judged by themselves are worth."""
    assert trials.finest is not None
    moved, figure = farthest(trials.coarse, trials.finest)
    return (
        f"the finest rungs of all parts but the washer move the trial runs' figures by "
        f"{100.0 * moved:.2g} % ({figure.replace('_', ' ')})"
    )


def _by_cards(name: str, part: Part, trials: TrialRuns, steps: int, is_checked: bool) -> Selected:
    spec, box = part.spec, trials.box(name, part.spec)
    direct = name in DIRECT
    share = (part.tolerance or 0.0) * (1.0 if direct else MODEL_SHARE)
    quantities = [(q, out) for q, out in QUANTITIES.get(spec.key, ()) if out in _names(spec)]
    scales = tuple(_scale(name, output, quantity, trials) for quantity, output in quantities)
    if not any(fresh_cards(spec.key, rung, part.params) for rung in spec.fidelities):
        rung = spec.default_fidelity
        words = f"{name}: {rung}, its default: no card speaks for these parameters; not checked"
        return Selected(name, spec.key, rung, None, share, False, (words,), box, scales)
    safety = 1.0 if is_checked and spec.key in WITHOUT_PAST else SAFETY
    choices = [
        _choose(name, part, box, quantity, share, scale, steps, safety)
        for (quantity, _), scale in zip(quantities, scales, strict=True)
    ]
    rungs = list(spec.fidelities)
    best = max(choices, key=lambda c: rungs.index(c.fidelity))
    reasons = [  # the first line of a choice names the part, not the model
        name + line.removeprefix(spec.key) if line.startswith(f"{spec.key}:") else f"  {line}"
        for c in choices for line in c.reasons
    ]  # fmt: skip
    if not direct and trials.finest is not None:
        reasons.append(f"  asked, because {_moved(trials)}")
    higher = above(spec, best.fidelity)
    beyond = best.outside.fidelity if best.outside else best.fidelity
    if rungs.index(beyond) > rungs.index(best.fidelity):
        higher = beyond
    return Selected(name, spec.key, best.fidelity, higher, share, True, tuple(reasons), box, scales)


def _choose(
    name: str, part: Part, box: Box, quantity: str, share: float, scale: Scale, steps: int,
    safety: float, only: str | None = None,
) -> Choice:  # fmt: skip
    """Ask the cards; a temperature's tolerance is the share of its range in the scene."""
    tolerance = share if scale.relative else share * scale.floor
    try:
        return choose(
            part.spec.key, box, quantity=quantity, tol=tolerance, n_calls=steps, safety=safety,
            params=part.params, among=[only] if only else None, loaded=True,  # by the trial runs
        )  # fmt: skip
    except (ParameterError, SolveError) as problem:
        raise type(problem)(f"part {name!r}, {quantity}: {problem}") from problem


def _scale(part: str, output: str, quantity: str, trials: TrialRuns) -> Scale:
    low, high = trials.seen(part, output)
    if quantity == "temperature":  # of the hotter pack: what a scene is judged by
        ranges = [trials.seen(pack, output) for pack in PACKS]
        return Scale(output, max(LEAST_RISE, *(b - a for a, b in ranges)), relative=False)
    return Scale(output, FLOOR * max(abs(low), abs(high)) or 1e-12)


def _names(spec: ModelSpec) -> list[str]:
    return [signal.name for signal in spec.outputs]
