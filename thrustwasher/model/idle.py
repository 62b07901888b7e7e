"""Which parameters have no effect, and which were kept though what they belong to was changed.

A parameter's metadata say it. ``read_by`` holds pairs of the parameter (or ``"fidelity"``) and the
value under which it is read; one of them has to hold, of a parameter that is read itself. A pair
of its own name: that value is what happens all the same. ``overrides`` names those in whose place
its own value stands, ``belongs_to`` those for whose values alone it was measured or chosen.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from functools import cache, lru_cache
from typing import Any

from ..units import format_quantity
from .part_file import PartFile, preset_parts
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
    for name in metadata:
        own = getattr(params, name)
        if not _is_read(metadata, params, name, fidelity) and own != 0.0:
            if all(own != getattr(start, name) for start in _starts(model).values()):
                why = _why(params, _roots(metadata, params, name), fidelity)
                found.setdefault(why, []).append(_shown(params, name))
    return (*gone, *(f"{', '.join(names)} {why}" for why, names in found.items()))


def kept_warnings(part: PartFile) -> tuple[str, ...]:
    """Return a line for each value that overrides a changed one, or was kept beside it."""
    params, starts = part.params, _starts(part.spec.key)
    name = min(starts, key=lambda n: len(_changed(params, starts[n])))
    return tuple(_kept(params, _changed(params, starts[name]), name))


def _changed(params: Any, start: Any) -> set[str]:
    return {f.name for f in fields(params) if getattr(params, f.name) != getattr(start, f.name)}


def _kept(params: Any, changed: set[str], start: str) -> Iterator[str]:
    for f in fields(params):
        m, value = f.metadata, getattr(params, f.name)
        over = [n for n in m.get("overrides", ()) if n in changed]
        if over and value:
            yield (
                f"{_shown(params, f.name)} stands in place of "
                f"{', '.join(_shown(params, n) for n in over)}, which was changed; change it "
                "too, or set it to 0"
            )
        owners = [n for n in m.get("belongs_to", ()) if n in changed]
        if owners and value and f.name not in changed:
            yield (
                f"{_shown(params, f.name)} is that of {start}, though "
                f"{', '.join(_shown(params, n) for n in owners)} was changed, to which it "
                "belongs; give that of this part"
            )


@cache
def _starts(model: str) -> dict[str, Any]:
    """Return the default parameters and those of each preset by their names."""
    spec = find_spec(model)
    presets = {f"the preset {name}": part.params for name, part in preset_parts(spec).items()}
    return {"the default": spec.params(), **presets}


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
    required: dict[str, list[str]] = {}
    for by, value in pairs:
        required.setdefault(by, []).append(f"{value:g}" if isinstance(value, float) else str(value))
    read = " or ".join(f"{by} = {' or '.join(values)}" for by, values in required.items())
    present = {by: _value(params, by, fidelity) for by in required}
    here = ", ".join(f"{by} is {value}" for by, value in present.items() if value != "")
    return f"has no effect: read by {read} only; {here}"


def _shown(params: Any, name: str) -> str:
    """Return name and value of a parameter."""
    m, value = type(params).__dataclass_fields__[name].metadata, getattr(params, name)
    if m["kind"] != "real":
        return f"{name} = {value}"
    return f"{name} = {format_quantity(value, m['unit'], difference=bool(m.get('relative')))}"
