"""What a model's page shows next to its interface: data."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...model.spec import Signal
from ..report.web_worker import WebWorker

Point = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class View:
    """A model's page."""

    worker: WebWorker
    page: str  # stem of the bundle of its scripts
    main: Sequence[str]  # parameters with sliders
    group: tuple[str, Sequence[str]] = ("", ())
    """Heading and names of parameters that stand together below; with sliders where ``spans`` are.
    """
    figures: Sequence[str]  # results shown large
    solve: str  # public name of what solves, and of its parameters
    params: str
    spans: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Range of a slider where it is not the whole one of the input or parameter."""
    more: Mapping[str, Any] = field(default_factory=dict)  # that the page's own script reads
    result: Callable[[Any, Point, str], Any] | None = None
    """What (parameters, point, level) come to, where it is not what the model's command solves."""
    inputs: Sequence[Signal] = ()  # in place of the command's
    usual: Point = field(default_factory=dict)  # their values at the start
    verified_point: Callable[[Point], Point] = dict
    """From the inputs to those that the verification tables know."""
    load: str = "load"  # the input, or name of the page's script, that the model's load comes from
    outputs: Mapping[str, tuple[str, str]] = field(default_factory=dict)  # in place: unit, meaning
    terms: str = ""  # what words of the results mean
    least: Mapping[str, float] = field(default_factory=dict)
    """Minimum value of an input where the solve wants more than the FMU."""
