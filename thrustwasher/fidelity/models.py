"""The models by name, and one face for solving any of them."""

from __future__ import annotations

from importlib import import_module

from ..errors import ParameterError
from ..models._spec import ModelSpec

HOMES = {"washer": "washer_params", "clutch": "clutch_params", "gearmesh": "gearmesh_params"}


def spec_of(model: str) -> ModelSpec:
    """Return what a model shows to the outside, or raise ParameterError with the models there are.

    Examples
    --------
    >>> spec_of("washer").default_fidelity
    'field'
    """
    if model not in HOMES:
        raise ParameterError(f"model = {model!r}, allowed: {' or '.join(map(repr, HOMES))}")
    home = import_module(f"..models.{HOMES[model]}", __package__)
    return home.SPEC  # type: ignore[no-any-return]
