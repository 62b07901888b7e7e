"""Which parameters are not read, because of the value of another one.

A parameter's metadata say it: ``read_by`` holds pairs of the parameter (or ``"fidelity"``) and the
value under which it is read; one of them has to hold, of a parameter that is read itself. A pair
of its own name: that value is what happens all the same.
"""

from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any

Pairs = list[tuple[str, Any]]


def unread(params: Any, name: str, fidelity: str = "") -> Pairs:
    """Return the pairs that would let a parameter be read; none if it is read.

    ``fidelity``: the level, "" if it is not known.
    """
    kind: Any = type(params)
    metadata = _conditions(kind)
    if _is_read(metadata, params, name, fidelity):
        return []
    return _roots(metadata, params, name)


@cache
def _conditions(kind: Any) -> dict[str, Any]:
    """Return the metadata of the fields that not every choice reads."""
    known: dict[str, Any] = getattr(kind, "__dataclass_fields__")  # noqa: B009
    return {n: f.metadata for n, f in known.items() if "read_by" in f.metadata}


def _is_read(metadata: Mapping[str, Any], params: object, name: str, fidelity: str) -> bool:
    """Tell if a parameter is read; one without such metadata always is."""
    if name not in metadata:
        return True
    return any(
        _value(params, by, fidelity) in (value, "")
        and (by == name or _is_read(metadata, params, by, fidelity))
        for by, value in metadata[name]["read_by"]
    )


def _roots(metadata: Mapping[str, Any], params: object, name: str) -> Pairs:
    """Return the pairs that would read a parameter; for one that holds in vain those of its own."""
    found: Pairs = []
    for by, value in metadata[name]["read_by"]:
        holds = by in metadata and by != name and getattr(params, by) == value
        found += _roots(metadata, params, by) if holds else [(by, value)]
    return [(by, value) for by, value in found if by != name]


def _value(params: object, by: str, fidelity: str) -> Any:
    return fidelity if by == "fidelity" else getattr(params, by)


def why_unread(params: object, pairs: Iterable[tuple[str, object]], fidelity: str = "") -> str:
    """Say what would read a parameter, and what there is instead."""
    required: dict[str, list[str]] = {}
    for by, value in pairs:
        required.setdefault(by, []).append(f"{value:g}" if isinstance(value, float) else str(value))
    read = " or ".join(f"{by} = {' or '.join(values)}" for by, values in required.items())
    present = {by: _value(params, by, fidelity) for by in required}
    here = ", ".join(f"{by} is {value}" for by, value in present.items() if value != "")
    return f"has no effect: read by {read} only; {here}"
