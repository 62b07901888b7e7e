"""The option ``fidelity``: a rung by name, or the cheapest that holds a tolerance."""

from collections.abc import Sequence
from dataclasses import replace

from ...errors import ParameterError
from ...ladder.choose import rung_and_tolerance
from .scene import Part, Scene


def has_choice(part: Part) -> bool:
    """Tell if a part has more rungs than one."""
    return len(part.spec.fidelities) > 1


def with_fidelities(scene: Scene, wishes: Sequence[str]) -> Scene:
    """Return the scene with other rungs: "field" for all parts, "washer=map" for one.

    Later wishes overrule earlier ones; parts with one rung keep it.
    """
    parts = dict(scene.parts)
    for wish in wishes:
        name, given, text = wish.partition("=")
        if not given:
            text, names = name, [n for n, p in parts.items() if has_choice(p)]
        elif name in parts:
            names = [name]
        else:
            raise ParameterError(
                f"fidelity = {wish!r}: there is no part {name!r} here, allowed: {', '.join(parts)}"
            )
        for n in names:
            rung, tolerance = rung_and_tolerance(f"part {n!r}", parts[n].spec, text)
            parts[n] = replace(parts[n], fidelity=rung, tolerance=tolerance)
    return replace(scene, parts=parts).checked()
