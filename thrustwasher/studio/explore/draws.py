"""How a part scatters, as the page's scripts read it: draws that are the same each time."""

from collections.abc import Collection, Mapping
from dataclasses import asdict
from typing import Any

from ...model.part_file import PartFile
from ...model.quantity import Quantity, other_of
from ...model.scatter import Law
from ...numerics.jit import Array
from .sobol import POINTS, first_points

DRAWS = POINTS  # a power of two: of each source one draw lies in each 32nd of its probability


def draws_of(
    part: PartFile, inputs: Mapping[str, float], known: Collection[str], load: str
) -> dict[str, Any] | None:
    """Return the sources that scatter, each with what it changes in the draws; None without any.

    A change makes of a value that the page has what ``values`` says, draw by draw: so many
    ``times`` it (normal laws of so many percent, lognormal ones), it ``plus`` so much (other normal
    laws), or it is ``set`` (uniform laws, choices). A load is never set, since the page goes over
    it. ``at_zero``: what counts where the page has 0, a name or a number.

    Parameters
    ----------
    inputs : of the model [SI], where the page begins
    known : names of parameters and inputs that the page has
    load : the page's name of what the load comes from
    """
    scatter = part.scattered(inputs={n: v for n, v in inputs.items() if n in part.starts})
    if not scatter.sources:
        return None
    rows = scatter.values(fixed_points(len(scatter.sources)))
    sources = []
    for s in scatter.sources:
        values = [row[s.place.name] for row in rows]
        if s.place.name == "load" or s.place.name in known:
            changes = [_change(part, s.place, s.law, values, load)]
        else:
            changes = _of_earlier_form(part, s.place.name, values)
        about = {"name": s.place.name, "law": s.law.words(), "reason": s.reason}
        sources.append({**about, "changes": changes})
    return {"draws": DRAWS, "sources": sources, "warnings": scatter.warnings}


def fixed_points(n: int) -> Array:
    """Return the first Sobol' points (DRAWS, n), each in the middle of its 32nd of each axis."""
    points: Array = first_points(n) + 0.5 / DRAWS
    return points


def _change(
    part: PartFile, place: Quantity, law: Law, values: list[Any], load: str
) -> dict[str, Any]:
    name, how = place.name, "set"
    if law.is_share or (name == "load" and (law.kind == "uniform" or load != "load")):
        how, values = "times", [float(x / place.nominal) for x in values]
    elif law.kind == "normal":
        how, values = "plus", [float(x - place.nominal) for x in values]
    name = load if name == "load" else name
    plain = [x if place.choices else float(x) for x in values]
    return {"name": name, "how": how, "values": plain, "at_zero": _at_zero(part, place.name)}


def _at_zero(part: PartFile, name: str) -> str | float:
    """Return what counts where a parameter or input is 0: another one's name, or a number."""
    inputs = {s.name: s.at_zero for s in part.spec.inputs}
    known = part.spec.params.__dataclass_fields__
    other = inputs[name] if name in inputs else other_of(known[name].metadata)
    return float(other(part.params)) if callable(other) else other or 0.0


def _of_earlier_form(part: PartFile, name: str, values: list[Any]) -> list[dict[str, Any]]:
    """Return the changes of the parameters that have replaced one."""
    drawn = [asdict(part.varied({name: value})[0]) for value in values]
    now = asdict(part.params)
    return [
        {"name": n, "how": "set", "values": [draw[n] for draw in drawn], "at_zero": 0.0}
        for n in now
        if any(draw[n] != now[n] for draw in drawn)
    ]
