"""From a parameter dataclass to the array a kernel takes."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from .parameters import as_numbers
from .spec import ModelSpec

Derive = Callable[[NDArray[np.float64]], int]
OFFLINE = (
    "fidelity = 'reference' is no rung to solve with: it takes long and comes with an uncertainty; "
    "call thrustwasher.study.reference_{0}.reference_{0}"
)


def filled(spec: ModelSpec, params: Any, fidelity: str, size: int, derive: Derive) -> Any:
    """Return the ``size`` numbers of a kernel's ``par``: parameters, rung, derived constants.

    It is for solutions without a past: a washer's bodies are taken as steady.

    Raises
    ------
    ParameterError : the rung is not one of the model's, or the parameters cannot be used together
    """
    if fidelity == "reference":
        raise ParameterError(OFFLINE.format(spec.key))
    rungs = list(spec.fidelities)
    if fidelity not in rungs:
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: {' or '.join(map(repr, rungs))}")
    if getattr(params, "thermal_mode", "quasi_steady") != "quasi_steady":
        params = replace(params, thermal_mode="quasi_steady")
    numbers = [*as_numbers(params), rungs.index(fidelity) + 1]
    par = np.zeros(size)
    par[: len(numbers)] = numbers
    status = Status(derive(par))
    if status.is_failure:
        raise ParameterError(f"the {spec.key} parameters cannot be used: {status.advice}")
    return par
