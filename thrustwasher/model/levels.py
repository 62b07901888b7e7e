"""Names of levels: which a model has, and which one runs in the place of one that is gone."""

from ..errors import ParameterError
from .spec import ModelSpec

OFFLINE = (
    "fidelity = 'reference' is no fidelity level to solve with: it takes long and comes "
    "with an uncertainty; "
    "call thrustwasher.studio.verification.reference_{0}.reference_{0}"
)


def level_named(spec: ModelSpec, name: str) -> str:
    """Return the level that runs under this name; ParameterError if there is none."""
    if name == "reference":
        raise ParameterError(OFFLINE.format(spec.key))
    if name not in spec.fidelities:
        known = " or ".join(map(repr, spec.levels))
        raise ParameterError(f"fidelity = {name!r}, allowed: {known}")
    return spec.successors.get(name, name)


def gone_level(spec: ModelSpec, name: str) -> tuple[str, ...]:
    """Return the line on a level that is gone and the one in its place; nothing of others."""
    if name not in spec.successors:
        return ()
    better = spec.successors[name]
    return (
        f"fidelity = {name!r} is gone: {better!r}, the next better fidelity level, runs in "
        f"its place",
    )
