"""Groups of parameters, for tools that show a tree.

In FMI 3.0 a parameter has a second name with a dot, an alias. FMI 2.0 knows none: there the groups
are listed in an annotation of the vendor. The plain names stay in both.
"""

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase

from ...model.spec import ModelSpec
from ...model.toml_tables import table_beside

GROUPS: dict[str, dict[str, list[str]]] = table_beside(__file__, "parameter_groups.toml")


def groups(spec: ModelSpec, names: Iterable[str]) -> dict[str, list[str]]:
    """Return the names of parameters by group; those in none are left out."""
    known, found = GROUPS.get(spec.key, {}), dict[str, list[str]]()
    for name in names:
        own = (g for g, patterns in known.items() if any(fnmatchcase(name, p) for p in patterns))
        if group := next(own, None):
            found.setdefault(group, []).append(name)
    return found


def listed_groups(spec: ModelSpec, names: Iterable[str]) -> dict[str, str]:
    """Return the names of parameters by group, in one text; of a whole body a pattern."""
    return {
        group: f"{group}_*" if _is_numbered(group) else " ".join(own)
        for group, own in groups(spec, names).items()
    }


def repeated(spec: ModelSpec, names: Iterable[str]) -> set[str]:
    """Return the variables that mean the same as one of the first body of their kind.

    Examples
    --------
    >>> from thrustwasher.model.registry import find_spec
    >>> names = "mesh_1_hand", "mesh_2_hand", "shaft_1_bearing_1_life", "shaft_1_bearing_2_life"
    >>> sorted(repeated(find_spec("train"), names))
    ['mesh_2_hand', 'shaft_1_bearing_2_life']
    """
    bodies = tuple(f"{group}_" for group in GROUPS.get(spec.key, ()) if _is_numbered(group))
    found = set(names)
    first = {name: re.sub(r"_\d_", "_1_", name) for name in found}
    return {
        name
        for name, same in first.items()
        if name.removeprefix("der(").startswith(bodies) and same != name and same in found
    }


def _is_numbered(group: str) -> bool:
    """Tell if a group is one of several bodies alike: mesh_2."""
    return group[-1].isdigit()


def grouped_names(spec: ModelSpec, names: Iterable[str]) -> dict[str, str]:
    """Return the second name of each parameter in a group, but for one of several bodies alike.

    mesh_1.hand says no more than mesh_1_hand.

    Examples
    --------
    >>> from thrustwasher.model.registry import find_spec
    >>> grouped_names(find_spec("washer"), ("oil_density", "density_gear", "fidelity"))
    {'oil_density': 'oil.density', 'density_gear': 'gear.density'}
    """
    return {
        name: f"{group}.{name.removeprefix(f'{group}_').removesuffix(f'_{group}')}"
        for group, own in groups(spec, names).items()
        if not _is_numbered(group)
        for name in own
    }
