"""Which models there are: the one list, by the package each lives in.

A model is a package with its record, ``MODEL`` in the module ``model``, and with compiled code in
the package ``kernels``, whose head says what of it Python calls (``CALLED``). Nothing is imported
before it is requested.
"""

from collections.abc import Iterable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from ..errors import ParameterError, suggestion
from .record import Ladder, Model
from .spec import ModelSpec

MODELS = {
    "washer": "thrustwasher.washer",
    "clutch": "thrustwasher.clutch",
    "gearmesh": "thrustwasher.gearmesh",
    "transmission": "thrustwasher.transmission",
    "sump": "thrustwasher.sump",
    "losses": "thrustwasher.losses",
    "train": "thrustwasher.train",
}
# Built when named, not with all: parts that only a system of FMUs needs.
HELPERS = {"command": "thrustwasher.command"}
# Packages with compiled code that belongs to no model; one from elsewhere adds its name.
OTHERS = ["thrustwasher.shift.cosim"]


def compiled_packages() -> tuple[str, ...]:
    """Return the packages of compiled code."""
    return (*(f"{home}.kernels" for home in (MODELS | HELPERS).values()), *OTHERS)


def _model_in(home: str) -> Model:
    model: Model = import_module(f"{home}.model").MODEL
    return model


def all_models() -> list[Model]:
    """Return the models of this version, in the order they are built."""
    return [_model_in(home) for home in MODELS.values()]


def models_with_points() -> dict[str, Model]:
    """Return the models that are solved at an operating point, by their keys."""
    return {model.key: model for model in all_models() if model.command}


def models_with_error_tables() -> dict[str, Model]:
    """Return the models with verification tables of their fidelity levels, by their keys."""
    return {model.key: model for model in all_models() if model.ladder}


def find_model(name: str) -> Model:
    """Return a model by its key ("washer") or the name of its FMU, or say which there are."""
    homes = MODELS | HELPERS
    if name in homes:
        return _model_in(homes[name])
    for model in map(_model_in, homes.values()):
        if model.name == name:
            return model
    raise _unknown(name)


def outside_laws(key: str, params: object, inputs: Mapping[str, float]) -> Iterable[str]:
    """Return which laws of a model inputs are outside of; of one from elsewhere nothing."""
    return find_model(key).doubts(params, inputs) if key in MODELS else ()


def _unknown(name: str, why: str = "") -> ParameterError:
    models = [_model_in(home) for home in (MODELS | HELPERS).values()]
    known = ", ".join(m.name for m in models)
    hint = suggestion(name, [n for m in models for n in (m.key, m.name)], "; did you mean {!r}?")
    why = why or (" (a folder)" if Path(name).is_dir() else "")
    return ParameterError(f"model = {name!r}{why}, allowed: {known}{hint}")


def find_spec(name: str) -> ModelSpec:
    """Return the interface of a model by key, by the name of its FMU or by "module:NAME"."""
    if ":" not in name:
        return find_model(name).spec
    module, _, attribute = name.partition(":")
    try:
        found = getattr(import_module(module), attribute)
    except (ImportError, AttributeError, TypeError, ValueError) as problem:
        raise _unknown(name, f" ({problem})") from problem
    if not isinstance(found, ModelSpec):
        raise _unknown(name, " (no ModelSpec)")
    return found


def all_specs(*, helpers: bool = False, alone: bool = False) -> list[ModelSpec]:
    """Return the interfaces of all models, in the order they are built.

    ``helpers``: those too; ``alone``: those of one level too, behind all others.
    """
    models = [*all_models(), *map(find_model, HELPERS if helpers else ())]
    found = [model.spec for model in models]
    if alone:
        found += [
            model.of_one_level(model.spec, level) for model in models for level in model.alone
        ]
    return found


def spec_of(name: str) -> ModelSpec:
    """Return the interface of a model that is solved at points; ParameterError names those."""
    return _among(models_with_points(), name).spec


def _among(models: dict[str, Model], name: str) -> Model:
    if name not in models:
        why = " (it has no verification tables)" if name in models_with_points() else ""
        hint = suggestion(name, models, "; did you mean {!r}?")
        words = " or ".join(map(repr, models))
        raise ParameterError(f"model = {name!r}{why}, allowed: {words}{hint}")
    return models[name]


def ladder_of(name: str) -> Ladder:
    """Return what the choice of a level knows of a model; errors as in ``spec_of``."""
    found = _among(models_with_error_tables(), name).ladder
    assert found is not None
    return found


def kernel_of(spec: ModelSpec) -> Any:
    """Return the module with a model's compiled step."""
    return import_module(spec.kernel)


def exchange_kernel_of(spec: ModelSpec) -> Any:
    """Return the module with a model's functions for model exchange, None if it has none."""
    return import_module(spec.exchange.kernel) if spec.exchange else None
