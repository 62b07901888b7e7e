"""The option ``fidelity``: a rung by name, or the cheapest that holds a tolerance."""

from collections.abc import Sequence
from dataclasses import replace

from ...errors import ParameterError
from ...model.spec import ModelSpec
from .scene import Part, Scene

AUTO = "auto"
TOLERANCE = 0.01  # of "auto" alone
TOLERANCES = (1e-6, 0.5)


def rung_and_tolerance(where: str, spec: ModelSpec, text: object) -> tuple[str, float | None]:
    """Return rung and tolerance of "field", "auto" or "auto:0.01"; tolerance None: the rung as is.

    With a tolerance the rung is the model's own default, until one is chosen.
    """
    if isinstance(text, str) and text.partition(":")[0] == AUTO:
        return spec.default_fidelity, _tolerance(where, text)
    if not isinstance(text, str) or text not in spec.fidelities:
        options = " or ".join(repr(n) for n in spec.fidelities)
        raise ParameterError(
            f"{where}: fidelity = {text!r}, allowed: {options} or 'auto:TOLERANCE'"
        )
    return text, None


def _tolerance(where: str, text: str) -> float:
    given = text.partition(":")[2]
    low, high = TOLERANCES
    try:
        tolerance = float(given) if given or text.endswith(":") else TOLERANCE
    except ValueError:
        tolerance = -1.0
    if not low <= tolerance <= high:
        raise ParameterError(
            f"{where}: fidelity = {text!r}, allowed: auto:TOLERANCE with {low:g} .. {high:g}, "
            "for example auto:0.01"
        )
    return tolerance


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
