"""What a model's page shows beside its interface: data."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import FIRST_FAILURE, Status
from ..model.spec import ModelSpec, Signal
from ..native.library import web_functions

WEB = Path(__file__).parents[1] / "report" / "web" / "explore"
Picture = tuple[str, Any]  # caption, matplotlib's figure
Point = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class View:
    """A model's page.

    Scripts are stems of files in ``report/web/explore``: what the worker runs, what the page runs.
    """

    worker: str
    page: str
    calls: Sequence[str]  # kernels that the worker calls
    layout: Mapping[str, float]  # numbers of the kernels' layout
    rungs: Mapping[str, Mapping[str, Any]]  # that can be chosen, with what the worker needs
    main: Sequence[str]  # parameters with sliders
    figures: Sequence[str]  # results shown large
    solve: str  # public name of what solves, and of its parameters
    params: str
    pictures: Callable[[Any, Any, Point], list[Picture]]  # (parameters, result, point)
    spans: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Range of a slider where it is not the whole one of the input or parameter."""
    more: Mapping[str, Any] = field(default_factory=dict)  # that the page's own script reads
    result: Callable[[Any, Point, str], Any] | None = None
    """What (parameters, point, rung) come to, where it is not what the model's command solves."""
    inputs: Sequence[Signal] = ()  # in place of the command's
    usual: Point = field(default_factory=dict)  # their values at the start
    card_point: Callable[[Point], Point] = dict
    """From the inputs to those that the cards know."""
    outputs: Mapping[str, tuple[str, str]] = field(default_factory=dict)  # in place: unit, meaning
    terms: str = ""  # what words of the results mean
    least: Mapping[str, float] = field(default_factory=dict)
    """Least value of an input where the solve wants more than the FMU."""

    def worker_data(self, spec: ModelSpec) -> dict[str, Any]:
        """Return what the worker's scripts read, as JSON types."""
        return {
            "functions": web_functions(spec.kernel, self.calls),
            "layout": self.layout,
            "rungs": self.rungs,
            "real_outputs": spec.real_outputs,
            "statuses": {int(s): s.advice for s in Status},
            "first_failure": FIRST_FAILURE,
        }

    def worker_script(self) -> str:
        """Return the worker: the kernels' functions, the model, what answers the page."""
        return joined("kernel.js", f"{self.worker}.js", "worker.js")


def joined(*names: str) -> str:
    """Return the text of files in ``report/web/explore``."""
    return "\n".join((WEB / name).read_text("utf-8") for name in names)


def numbers_of(*modules: Any, **more: float) -> dict[str, float]:
    """Return all public numbers of layout modules by name."""
    found = {n: v for m in modules for n, v in vars(m).items() if n.isupper()}
    return {n: v for n, v in found.items() if isinstance(v, int | float)} | more
