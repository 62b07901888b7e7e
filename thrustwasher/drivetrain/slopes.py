"""How an output of a part changes with one of its inputs: its own derivative, or differences."""

from __future__ import annotations

from ..errors import ParameterError, SolveError
from .state import gives_derivatives, saves_state, with_derivatives, with_state
from .system import ConnectedPart

WIDTH = 1e-6  # of an input's nominal value: half the distance of a difference


def slope(part: ConnectedPart, output: str, given: str) -> float:
    """Return d(output)/d(input) at the part's present inputs, memory held.

    From the instance's directional derivatives or, where it has none but can save its state, from
    a central difference after which it is where it was. SolveError if there is no derivative here,
    ParameterError if the instance can do neither.
    """
    if gives_derivatives(part):
        return with_derivatives(part).directional_derivative([output], [given], [1.0])[0]
    if not saves_state(part):
        raise ParameterError(
            f"master = 'linearly-implicit': {part.name} has neither directional derivatives nor a "
            "state that can be saved, allowed: with parts that have one of them, such as the "
            "native FMUs"
        )
    return _difference(part, output, given)


def _difference(part: ConnectedPart, output: str, given: str) -> float:
    instance, k = part.instance, part.input_names.index(given)
    place, signal = part.output_names.index(output), part.spec.inputs[k]
    width = WIDTH * (signal.nominal or 1.0)
    ends = part.inputs[k] - width, part.inputs[k] + width
    if signal.low is not None and ends[0] < signal.low:
        return 0.0  # at its limit, where models have corners: an open pack, a wheel at rest
    keeper = with_state(part, "linearly-implicit")
    state = keeper.get_state()
    try:
        found = []
        for value in ends:
            instance.set_inputs([*part.inputs[:k], value, *part.inputs[k + 1 :]])
            found.append(instance.outputs()[place])
    except ParameterError as problem:  # a limit of the part's inputs
        raise SolveError(str(problem)) from problem
    finally:
        keeper.set_state(state)
        keeper.free_state(state)
    return (found[1] - found[0]) / (ends[1] - ends[0])
