"""Instances that do not belong to the scene they are to run in: made with other parameters.

Inputs and outputs of a model are the same in every scene, so that an instance of another one runs
without a complaint and answers another question.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

from ..errors import ParameterError
from ..models._params import as_numbers
from .scene import Part, Scene
from .system import Stepping


@runtime_checkable
class WithParameters(Protocol):
    """An instance that tells the values of its variables."""

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name."""


def check_agreement(scene: Scene, instances: Mapping[str, Stepping]) -> None:
    """Compare the parameters of initialized instances with those of the scene's parts.

    Instances without a ``get`` (stand-ins for a model) are taken as they are.

    Raises
    ------
    ParameterError : names the part, the parameter, both values and how to make the instance
    """
    for name, part in scene.parts.items():
        instance = instances[name]
        if not isinstance(instance, WithParameters):
            continue
        wanted = _numbers(part)
        found = instance.get(list(wanted))
        for key, has in zip(wanted, found, strict=True):
            if has != wanted[key]:
                raise ParameterError(
                    f"{name}: the instance was made with {key} = {has:.9g}, scene "
                    f"{scene.name!r} has {wanted[key]:.9g}; make it with "
                    f"scene.parts[{name!r}].parameters()"
                )


def _numbers(part: Part) -> dict[str, float]:
    """Return all parameters of a part as an instance holds them: enumerations count from 1."""
    names = [n for n in part.parameters() if n != "fidelity"]
    rung = list(part.spec.fidelities).index(part.fidelity) + 1.0
    return {**dict(zip(names, as_numbers(part.params), strict=True)), "fidelity": rung}
