"""The models and their kernels by name."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import ParameterError
from .spec import ModelSpec

MODELS = {"washer": "washer_params", "clutch": "clutch_params", "gearmesh": "gearmesh_params"}


def spec_of(model: str) -> ModelSpec:
    """Return what a model shows to the outside, or raise ParameterError with the models there are.

    Examples
    --------
    >>> spec_of("washer").default_fidelity
    'field'
    """
    if model not in MODELS:
        raise ParameterError(f"model = {model!r}, allowed: {' or '.join(map(repr, MODELS))}")
    spec: ModelSpec = import_module(f"..models.{MODELS[model]}", __package__).SPEC
    return spec


def kernel_of(spec: ModelSpec) -> Any:
    """Return the module with a model's compiled step."""
    return import_module(f"..kernels.{spec.kernel}", __package__)
