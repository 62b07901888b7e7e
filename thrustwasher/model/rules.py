"""Rules between parameters: the kernel tests them, the texts here say which one is broken."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

from ..errors import ParameterError
from .parameters import as_numbers
from .spec import ModelSpec, Rule


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
    import numpy as np  # late: --help needs none

    if number := broken_rule(np.array([*as_numbers(params), *more], float)):
        raise ParameterError(rules[number - 1].message(params))
