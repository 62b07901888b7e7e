"""Which parameters have no effect, and which were kept though what they belong to was changed.

A parameter's metadata say it. ``read_by``: see ``model.unread``. ``overrides`` names those in whose
place its own value stands, ``belongs_to`` those for whose values alone it was measured or chosen.
"""

from collections.abc import Iterator, Mapping
from dataclasses import fields
from functools import cache, lru_cache
from typing import Any

from ..units import format_quantity
from .levels import gone_level
from .part_file import PartFile, preset_parts
from .registry import find_spec
from .unread import unread, why_unread


def idle_warnings(
    model: str, params: Any, fidelity: str = "", usual: Mapping[str, Any] | None = None
) -> tuple[str, ...]:
    """Return a line for all your own parameters that one choice leaves unread.

    A line on a level that is gone comes first. A value that is the default or that of a preset is
    your own none, nor is a ``usual`` one, which whatever holds the part gave it; neither is 0 where
    that stands for no value. ``fidelity``: the level, "" if it is not known.
    """
    return _idle(model, params, fidelity, tuple((usual or {}).items()))


@lru_cache(maxsize=256)
def _idle(
    model: str, params: Any, fidelity: str, given: tuple[tuple[str, Any], ...]
) -> tuple[str, ...]:
    found: dict[str, list[str]] = {}
    spec, usual = find_spec(model), dict(given)
    gone, fidelity = gone_level(spec, fidelity), spec.successors.get(fidelity, fidelity)
    for f in fields(params):
        own = getattr(params, f.name)
        is_own = own not in (0.0, usual.get(f.name))
        failing = unread(params, f.name, fidelity) if is_own else []
        if failing and all(own != getattr(start, f.name) for start in _starts(model).values()):
            why = why_unread(params, failing, fidelity)
            found.setdefault(why, []).append(_shown(params, f.name))
    return (*gone, *(f"{', '.join(names)} {why}" for why, names in found.items()))


def kept_warnings(part: PartFile) -> tuple[str, ...]:
    """Return a line for each value that overrides a changed one, or was kept with it."""
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
                f"{_shown(params, f.name)} is still that of {start}, but it depends on "
                f"{', '.join(_shown(params, n) for n in owners)}, changed here: give its value too"
            )


@cache
def _starts(model: str) -> dict[str, Any]:
    """Return the default parameters and those of each preset by their names."""
    spec = find_spec(model)
    presets = {f"the preset {name}": part.params for name, part in preset_parts(spec).items()}
    return {"the default": spec.params(), **presets}


def _shown(params: Any, name: str) -> str:
    """Return name and value of a parameter."""
    m, value = type(params).__dataclass_fields__[name].metadata, getattr(params, name)
    if m["kind"] != "real":
        return f"{name} = {value}"
    return f"{name} = {format_quantity(value, m['unit'], difference=bool(m.get('relative')))}"
