"""Groups of parameters, for tools that show a tree.

In FMI 3.0 a parameter has a second name with a dot, an alias. FMI 2.0 knows none: there the groups
are listed in an annotation of the vendor. The plain names stay in both.
"""

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


def grouped_names(spec: ModelSpec, names: Iterable[str]) -> dict[str, str]:
    """Return the second name of each parameter that is in a group.

    Examples
    --------
    >>> from thrustwasher.model.registry import find_spec
    >>> grouped_names(find_spec("washer"), ("oil_density", "density_gear", "fidelity"))
    {'oil_density': 'oil.density', 'density_gear': 'gear.density'}
    """
    return {
        name: f"{group}.{name.removeprefix(f'{group}_').removesuffix(f'_{group}')}"
        for group, own in groups(spec, names).items()
        for name in own
    }
