"""From a parameter dataclass to what a kernel takes: checked by its rules, filled in, with tables.

The kernel tests the rules between parameters, the texts in the interface say which one is broken.
"""

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np

from ..errors import ParameterError, Status
from .parameters import as_numbers
from .record import resolve
from .spec import ModelSpec, Rule

OFFLINE = (
    "fidelity = 'reference' is no rung to solve with: it takes long and comes with an uncertainty; "
    "call thrustwasher.study.reference_{0}.reference_{0}"
)


def filled(
    spec: ModelSpec, params: Any, fidelity: str, size: int, derive: Callable[[Any], int]
) -> Any:
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


def check_together(spec: ModelSpec, params: Any, fidelity: str) -> None:
    """Raise ParameterError for the first rule that parameters and fidelity break together."""
    if not spec.rules:  # a model from elsewhere may have its kernel elsewhere too
        return
    rule = getattr(import_module(spec.kernel), "broken_rule", None)
    if rule is None:
        return
    check_rules(params, spec.rules, rule, list(spec.fidelities).index(fidelity) + 1)


def check_rules(
    params: Any, rules: tuple[Rule, ...], broken_rule: Callable[[Any], int], *more: float
) -> None:
    """Raise ParameterError for the first broken rule; every value must be in its range already."""
    if number := broken_rule(np.array([*as_numbers(params), *more], float)):
        raise ParameterError(rules[number - 1].message(params))


def wants_table(spec: ModelSpec, par: Any) -> bool:
    """Tell if the rung in ``par`` reads a table."""
    known = _known(spec)
    return bool(known) and par[int(known["SWITCH"])] == known["ON"]


def fill_table(spec: ModelSpec, params: Any, par: Any, work: Any) -> None:
    """Put the table for ``params`` into ``work`` if the rung in ``par`` reads one.

    Raises
    ------
    ParameterError : there is none for these parameters, or it is too large
    """
    if not wants_table(spec, par):
        return
    known = _known(spec)
    table = resolve(spec.table)(params)
    room = work[int(known["AT"]) :]
    if len(table) > len(room):
        raise ParameterError(
            f"the table has {len(table)} numbers, allowed: {len(room)}; make it smaller"
        )
    room[: len(table)] = table


def _known(spec: ModelSpec) -> dict[str, float]:
    """Return what the kernel says about its table; empty if it has none."""
    kernel = import_module(spec.kernel)
    found: dict[str, float] = getattr(kernel, "TABLE", None) or {}
    return found
