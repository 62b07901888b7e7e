"""Which parameters results are differentiated over, and the steps that differences take."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import fields
from typing import Any, NamedTuple

from ..errors import ParameterError

STEP = 1e-6  # of a value, or of its range where it is 0


class Varied(NamedTuple):
    """A parameter, and a difference over it: the sum of weight x function at value + offset."""

    name: str
    place: int  # in the parameter array
    value: float
    points: tuple[tuple[float, float], ...]  # offsets and weights


def varied_parameters(params: Any, wanted: Collection[str] | None) -> list[Varied]:
    """Return the real parameters, or those of them that are wanted.

    Left out are counts, choices, and those whose 0 stands for a value from elsewhere.

    Raises
    ------
    ParameterError : a name that is wanted is none of them
    """
    found = [
        Varied(f.name, place, value, _difference(value, f.metadata))
        for place, f in enumerate(fields(params))
        if f.metadata["kind"] == "real"
        for value in (float(getattr(params, f.name)),)
        if value != 0.0 or not (f.metadata.get("overrides") or f.metadata.get("at_zero"))
    ]
    names = _chosen("parameters", wanted, [v.name for v in found])
    return [v for v in found if v.name in names]


def wanted_outputs(wanted: Collection[str] | None, outputs: Sequence[str]) -> list[str]:
    """Return the outputs that are wanted, by default all; ParameterError for an unknown one."""
    return _chosen("outputs", wanted, outputs)


def by_differences(
    params: Any,
    parameters: Collection[str] | None,
    outputs: Collection[str] | None,
    values_at: Callable[[int, float], Mapping[str, float | None]],
) -> dict[str, dict[str, float]]:
    """Return {output: {parameter: derivative}} of results that take no solve to the end.

    ``values_at(place, value)`` returns all results with one number of the parameter array changed.
    """
    varied = varied_parameters(params, parameters)
    whole = values_at(0, float("nan")) if not varied else values_at(varied[0].place, varied[0].value)
    names = wanted_outputs(outputs, [name for name, x in whole.items() if x is not None])
    found: dict[str, dict[str, float]] = {name: {} for name in names}
    for v in varied:
        rows = [(weight, values_at(v.place, v.value + offset)) for offset, weight in v.points]
        for name in names:
            found[name][v.name] = sum(weight * float(row[name] or 0.0) for weight, row in rows)
    return found


def _difference(value: float, meta: Mapping[str, Any]) -> tuple[tuple[float, float], ...]:
    """Return offsets and weights of second order; at an end of the range they look inwards."""
    low, high = float(meta["min"]), float(meta["max"])
    h = STEP * (abs(value) or high - low)
    if value - h < low or value + h > high:
        h = h if value - h < low else -h
        return ((0.0, -1.5 / h), (h, 2.0 / h), (2.0 * h, -0.5 / h))
    return ((-h, -0.5 / h), (h, 0.5 / h))


def _chosen(what: str, wanted: Collection[str] | None, known: Sequence[str]) -> list[str]:
    if wanted is None:
        return list(known)
    for name in wanted:
        if name not in known:
            raise ParameterError(f"{what}: {name!r}, allowed: {', '.join(known)}")
    return [name for name in known if name in wanted]
