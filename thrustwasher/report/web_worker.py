"""A model's kernels in a web worker: what its scripts are and read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import FIRST_FAILURE, Status
from ..model.spec import ModelSpec
from ..native.library import web_functions

WEB = Path(__file__).parent / "web" / "explore"


@dataclass(frozen=True, kw_only=True)
class WebWorker:
    """What solves a model in a browser."""

    script: str  # stem of a file in ``report/web/explore``
    more: Sequence[str] = ()  # stems of further ones
    calls: Sequence[str]  # kernels that it calls
    layout: Mapping[str, float]  # numbers of the kernels' layout
    rungs: Mapping[str, Mapping[str, Any]]  # that can be chosen, with what it needs of each

    @property
    def scripts(self) -> tuple[str, ...]:
        """Stems of the scripts that solve."""
        return ("kernel", self.script, *self.more)

    def data(self, spec: ModelSpec) -> dict[str, Any]:
        """Return what the scripts read, as JSON types."""
        return {
            "functions": web_functions(spec.kernel, self.calls),
            "layout": self.layout,
            "rungs": self.rungs,
            "real_outputs": spec.real_outputs,
            "statuses": {int(s): s.advice for s in Status},
            "first_failure": FIRST_FAILURE,
        }

    def source(self) -> str:
        """Return all scripts: the kernels' functions, the model, what answers the page."""
        return joined(*(f"{stem}.js" for stem in (*self.scripts, "worker")))


def joined(*names: str) -> str:
    """Return the text of files in ``report/web/explore``."""
    return "\n".join((WEB / name).read_text("utf-8") for name in names)


def numbers_of(*modules: Any, **more: float) -> dict[str, float]:
    """Return all public numbers of layout modules by name."""
    found = {n: v for m in modules for n, v in vars(m).items() if n.isupper()}
    return {n: v for n, v in found.items() if isinstance(v, int | float)} | more
