"""What a part keeps of the preset that it was made from though what it belongs to was changed.

A parameter's metadata say it: ``overrides`` names those in whose place its own value stands,
``belongs_to`` those for whose values alone it was measured or chosen; ``when`` (a parameter and its
value) says under which choice it counts at all.
"""

from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from ..units import format_quantity
from .part_file import PartFile, find_part, preset_parts


def kept_warnings(part: PartFile) -> tuple[str, ...]:
    """Return a line for each value that overrides a changed one, or was kept beside it."""
    params = part.params
    starts = {"the default": find_part(part.spec.key).params}
    starts |= {f"the preset {n}": p.params for n, p in preset_parts(part.spec).items()}
    name = min(starts, key=lambda n: len(_changed(params, starts[n])))
    changed = _changed(params, starts[name])
    return tuple(_lines(params, changed, name))


def _changed(params: Any, start: Any) -> set[str]:
    return {f.name for f in fields(params) if getattr(params, f.name) != getattr(start, f.name)}


def _lines(params: Any, changed: set[str], start: str) -> Iterator[str]:
    for f in fields(params):
        m, value = f.metadata, getattr(params, f.name)
        if "when" in m and getattr(params, m["when"][0]) != m["when"][1]:
            continue
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


def _shown(params: Any, name: str) -> str:
    """Return name and value of a parameter."""
    m, value = type(params).__dataclass_fields__[name].metadata, getattr(params, name)
    if m["kind"] != "real":
        return f"{name} = {value}"
    return f"{name} = {format_quantity(value, m['unit'], difference=bool(m.get('relative')))}"
