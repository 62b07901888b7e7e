"""How a part scatters, as the page's scripts read it: draws that are the same each time."""

from collections.abc import Mapping
from typing import Any

from ..model.part_file import PartFile
from ..model.places import other_of
from ..model.scatter import Law, Place
from ..numerics.jit import Array

DRAWS = 32  # a power of two: of each source one draw lies in each 32nd of its probability


def draws_of(part: PartFile, point: Mapping[str, float]) -> dict[str, Any] | None:
    """Return the sources that scatter, each with what its draws do; None without any.

    A draw changes the value that the page has: it is ``times`` (normal laws of so many percent,
    lognormal ones), ``plus`` (other normal laws) or ``set`` (uniform, choices) what ``values`` says.
    A load is never set, since the page goes over the load. ``at_zero``: what counts where the page
    has 0, a name or a number.

    Parameters
    ----------
    point : inputs [SI] that the page begins with
    """
    scatter = part.scattered(inputs={n: v for n, v in point.items() if n in part.starts})
    if not scatter.sources:
        return None
    rows = scatter.values(fixed_points(len(scatter.sources)))
    sources = []
    for s in scatter.sources:
        how, values = _changes(s.place, s.law, [row[s.place.name] for row in rows])
        about = {"name": s.place.name, "law": s.law.words(), "reason": s.reason, "how": how}
        sources.append({**about, "values": values, "at_zero": _at_zero(part, s.place.name)})
    return {"sources": sources, "warnings": scatter.warnings}


def fixed_points(n: int) -> Array:
    """Return the first Sobol' points (DRAWS, n), each in the middle of its 32nd of each axis."""
    from scipy.stats.qmc import Sobol

    points: Array = Sobol(n, scramble=False).random(DRAWS) + 0.5 / DRAWS
    return points


def _changes(place: Place, law: Law, values: list[Any]) -> tuple[str, list[Any]]:
    if law.is_share or (place.name == "load" and law.kind == "uniform"):
        return "times", [float(x / place.nominal) for x in values]
    if law.kind == "normal":
        return "plus", [float(x - place.nominal) for x in values]
    return "set", [x if place.choices else float(x) for x in values]


def _at_zero(part: PartFile, name: str) -> str | float:
    """Return what counts where a parameter or input is 0: another one's name, or a number."""
    inputs = {s.name: s.at_zero for s in part.spec.inputs}
    known = part.spec.params.__dataclass_fields__
    other = inputs[name] if name in inputs else other_of(known[name].metadata)
    return float(other(part.params)) if callable(other) else other or 0.0
