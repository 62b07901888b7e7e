"""Which parameters the choices beside them leave unread.

A parameter's metadata say it: ``read_by`` holds pairs of the parameter (or ``"fidelity"``) and the
value under which it is read; one of them has to hold, of a parameter that is read itself. A pair
of its own name: that value is what happens all the same.
"""

from collections.abc import Iterable, Mapping
from dataclasses import fields
from functools import cache, lru_cache
from typing import Any

from ..units import format_quantity
from .part_file import preset_parts
from .registry import find_spec
from .rungs import gone_rung


@lru_cache(maxsize=256)
def idle_warnings(model: str, params: Any, fidelity: str = "") -> tuple[str, ...]:
    """Return a line for all parameters of one's own that one choice leaves unread.

    A line on a rung that is gone comes first. A value that is the default or that of a preset is
    none of one's own; neither is 0 where that stands for no value. ``fidelity``: the rung, "" if
    it is not known.
    """
    found: dict[str, list[str]] = {}
    spec = find_spec(model)
    gone, fidelity = gone_rung(spec, fidelity), spec.successors.get(fidelity, fidelity)
    metadata = {f.name: f.metadata for f in fields(params) if "read_by" in f.metadata}
    for name, m in metadata.items():
        own = getattr(params, name)
        if not _is_read(metadata, params, name, fidelity) and own != 0.0:
            if all(own != getattr(start, name) for start in _starts(model)):
                why = _why(params, _roots(metadata, params, name), fidelity)
                found.setdefault(why, []).append(_shown(name, own, m))
    return (*gone, *(f"{', '.join(names)} {why}" for why, names in found.items()))


@cache
def _starts(model: str) -> tuple[Any, ...]:
    """Return the default parameters and those of each preset."""
    spec = find_spec(model)
    return (spec.params(), *(part.params for part in preset_parts(spec).values()))


def _is_read(metadata: Mapping[str, Any], params: Any, name: str, fidelity: str) -> bool:
    """Tell if a parameter is read; one without such metadata always is."""
    if name not in metadata:
        return True
    return any(
        _value(params, by, fidelity) in (value, "")
        and (by == name or _is_read(metadata, params, by, fidelity))
        for by, value in metadata[name]["read_by"]
    )


def _roots(metadata: Mapping[str, Any], params: Any, name: str) -> list[tuple[str, Any]]:
    """Return the pairs that would read a parameter; for one that holds in vain those of its own."""
    found: list[tuple[str, Any]] = []
    for by, value in metadata[name]["read_by"]:
        holds = by in metadata and by != name and getattr(params, by) == value
        found += _roots(metadata, params, by) if holds else [(by, value)]
    return [(by, value) for by, value in found if by != name]


def _value(params: Any, by: str, fidelity: str) -> Any:
    return fidelity if by == "fidelity" else getattr(params, by)


def _why(params: Any, pairs: Iterable[tuple[str, Any]], fidelity: str) -> str:
    """Say what would read a parameter, and what there is instead."""
    wanted: dict[str, list[str]] = {}
    for by, value in pairs:
        wanted.setdefault(by, []).append(f"{value:g}" if isinstance(value, float) else str(value))
    read = " or ".join(f"{by} = {' or '.join(values)}" for by, values in wanted.items())
    said = {by: _value(params, by, fidelity) for by in wanted}
    here = ", ".join(f"{by} is {value}" for by, value in said.items() if value != "")
    return f"has no effect: read by {read} only; {here}"


def _shown(name: str, value: Any, m: Mapping[str, Any]) -> str:
    """Return name and value of a parameter."""
    if m["kind"] != "real":
        return f"{name} = {value}"
    return f"{name} = {format_quantity(value, m['unit'], difference=bool(m.get('relative')))}"
