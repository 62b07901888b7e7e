"""A model with other defaults: the same kernels and names, the numbers of one place of use."""

from collections.abc import Mapping
from dataclasses import field, fields, make_dataclass, replace
from typing import Any

from .spec import ModelSpec


def tailored(
    spec: ModelSpec, parameters: Mapping[str, Any], starts: Mapping[str, float], *,
    stop_time: float, step_size: float,
) -> ModelSpec:  # fmt: skip
    """Return the model with these values of parameters and inputs as its defaults.

    Parameters
    ----------
    spec : the model
    parameters : values by name, ``fidelity`` among them; those not named stay as they are
    starts : start values of inputs by name
    stop_time, step_size : of its default experiment [s]
    """
    kept = [
        (f.name, f.type, field(default=parameters.get(f.name, f.default), metadata=f.metadata))
        for f in fields(spec.params)
    ]
    params = make_dataclass(
        spec.params.__name__, kept, bases=(spec.params,), frozen=True, kw_only=True,
        namespace={"__module__": spec.params.__module__, "__doc__": spec.params.__doc__},
    )  # fmt: skip
    params()  # raises what the model says about values that do not go together
    return replace(
        spec,
        params=params,
        default_fidelity=parameters.get("fidelity", spec.default_fidelity),
        inputs=tuple(replace(s, start=starts.get(s.name, s.start)) for s in spec.inputs),
        course=(),
        stop_time=stop_time,
        step_size=step_size,
    )
