"""A model's kernels in a web worker: what its scripts are and read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...errors import FIRST_FAILURE, Status
from ...model.spec import ModelSpec
from ...native.library import web_functions
from .bundles import bundle


@dataclass(frozen=True, kw_only=True)
class WebWorker:
    """What solves a model in a browser."""

    script: str  # stem of its bundle, and of the module in ``explore/models`` that solves
    calls: Sequence[str]  # kernels that it calls
    layout: Mapping[str, float]  # numbers of the kernels' layout
    levels: Mapping[str, Mapping[str, Any]]  # that can be chosen, with what it needs of each
    more: Mapping[str, Any] = field(default_factory=dict)  # that the model's own script reads

    def data(self, spec: ModelSpec) -> dict[str, Any]:
        """Return what the scripts read, as JSON types."""
        return {
            "functions": web_functions(spec.kernel, self.calls),
            "layout": self.layout,
            "levels": self.levels,
            "real_outputs": spec.real_outputs,
            "statuses": {int(s): s.advice for s in Status},
            "first_failure": FIRST_FAILURE,
            **self.more,
        }

    def source(self) -> str:
        """Return all of it: the kernels' functions, the model, what answers the page."""
        return bundle(f"{self.script}.js")


def numbers_of(*modules: object, **more: float) -> dict[str, float]:
    """Return all public numbers of layout modules by name."""
    found = {n: v for m in modules for n, v in vars(m).items() if n.isupper()}
    return {n: v for n, v in found.items() if isinstance(v, int | float)} | more
