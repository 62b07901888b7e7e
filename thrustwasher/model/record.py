"""The record of a model, ``model.toml``: all that the rest of the package knows of it.

What lies above a model (plots, commands, reference values) stands there as data or as a dotted name
"module:NAME", which is resolved when it is asked for: a record imports nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, is_dataclass
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, get_args, get_origin, get_type_hints

if TYPE_CHECKING:  # it needs numpy, which not every command does
    from .spec import ModelSpec

Scaled = tuple[float, float, str]  # low, high, "linear" or "log"


def resolve(name: str) -> Any:
    """Return what a dotted name "module:NAME" stands for."""
    module, _, attribute = name.partition(":")
    return getattr(import_module(module), attribute)


def absent_outputs(spec: ModelSpec, params: Any) -> frozenset[str]:
    """Return the names of the outputs that have no value with these parameters."""
    return resolve(spec.absent)(params) if spec.absent else frozenset()


@cache
def _anatomy(kind: Any) -> tuple[Any, tuple[Any, ...], dict[str, Any]]:
    """Return what an annotation is made of: its origin, arguments, and fields if a dataclass."""
    fields = get_type_hints(kind) if is_dataclass(kind) else {}
    return get_origin(kind), get_args(kind), fields


def from_plain(kind: Any, raw: Any) -> Any:
    """Return what was read from JSON or TOML as the annotation ``kind`` says, lists as tuples.

    KeyError, TypeError or AttributeError if it has other keys or another shape.
    """
    origin, inner, fields = _anatomy(kind)
    if fields:
        return kind(**{k: from_plain(fields[k], v) for k, v in raw.items()})
    if origin is tuple:
        return tuple(from_plain(inner[0], item) for item in raw)
    if origin in (dict, Mapping):
        return {k: from_plain(inner[1], item) for k, item in raw.items()}
    if inner:  # one kind or None
        return None if raw is None else from_plain(inner[0], raw)
    return raw


@dataclass(frozen=True, kw_only=True)
class Option:
    """An argument of a model's ``solve`` as an option of its command."""

    name: str
    help: str
    choices: tuple[str, ...] | None = None
    read: str = ""  # dotted name of a function that makes its value of the text
    metavar: str | None = None


@dataclass(frozen=True, kw_only=True)
class Variants:
    """Results side by side for several variants, such as two steels: a table below the others."""

    head: str  # what a row is; the parameter of this name holds the chosen one
    rows: Mapping[str, str]  # words -> ending of the fields' names
    columns: Mapping[str, str]  # field without its ending -> head
    chosen: str  # said of the row that the parameters choose

    def name(self, column: str, row: str) -> str:
        """Return the name of a field."""
        return f"{column}_{self.rows[row]}"

    def fields(self) -> set[str]:
        """Return all fields in the table, and those of the chosen variant, which it repeats."""
        table = {self.name(column, row) for column in self.columns for row in self.rows}
        return table | set(self.columns)


@dataclass(frozen=True, kw_only=True)
class Command:
    """The command that solves a model at one operating point, beside what its interface says."""

    help: str
    solve: str  # called with (parameters, **point, fidelity=, **options)
    figure: str = ""  # called with (result, point, parameters); "": there is no --plot
    figure_help: str = ""
    title: str  # may name parameters: "gear mesh, {pinion_teeth} teeth"
    closing: str = "{fidelity}"  # how it was solved; may name results
    extra: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    """Results that are no output: unit and meaning."""
    warning: str = ""
    """Dotted name: from a result to a warning that takes a solve of its own, "" if nothing."""
    instead: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    """Name of a model's input -> fields of the signal that this command has instead of it."""
    place: str = ""  # dotted name: from the command's point to the model's own inputs
    back: str = ""  # dotted name: from these to the command's point
    options: tuple[Option, ...] = ()  # more arguments of ``solve``
    variants: Variants | None = None
    more: tuple[str, ...] = ()  # other commands of this model, which are files


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """What the choice of a rung and the making of its cards need to know."""

    kernels: Mapping[str, tuple[str, ...]]
    """Rungs that can be chosen, in the order of their cost -> modules that compute them."""
    boxes: Mapping[str, Mapping[str, Scaled]]
    """Parameter set -> range of every input: "default", a scene, or "scene.part"."""
    part: str  # of a scene, where a parameter set names none
    references: str  # dotted name: where reference values come from
    chart: str  # dotted name: what the chart shows, at which operating points
    only: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """Rung -> parameters and the values with which alone it differs from the one before."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """What a sweep does otherwise than by steps of the model's kernel."""

    walk: str = ""  # dotted name of what fills the rows of a line
    not_shown: tuple[str, ...] = ()  # outputs that make no sense there
    more_inputs: tuple[Mapping[str, Any], ...] = ()  # fields of signals it takes as well
    doubt: str = ""  # dotted name: (parameters, fidelity, inputs) to a warning or ""
    least: str = ""  # dotted name: output -> (value it should not be below, what it means there)


@dataclass(frozen=True, kw_only=True)
class OwnOutputs:
    """Outputs of a model that can be measured beside those of its solutions at points."""

    units: Mapping[str, str]
    computed: Callable[[Any, Mapping[str, float], str], Mapping[str, float]] | None = None
    """Of parameters, point and rung, those that there are; None: a law of its own has them."""
    without: str = ""  # the input that these do not depend on
    none: str = ""  # what a point means that has none of them


@dataclass(frozen=True, kw_only=True)
class Fits:
    """What can be fitted to measurements beside the model's outputs at its points."""

    outputs: str = ""  # dotted name of ``OwnOutputs``
    law: str = ""  # dotted name of the ``ModelProblem`` that fits these by a law of the model's own


@dataclass(frozen=True, kw_only=True)
class Model:
    """A model of the package."""

    key: str  # "washer": on the command line, in sweeps and cards
    name: str  # "ThrustWasher": of the FMU
    interface: str  # dotted name of the ``ModelSpec``: parameters, inputs, outputs, kernel
    command: Command | None = None
    ladder: Ladder | None = None
    sweep: Sweep = Sweep()
    fits: Fits = Fits()
    explore: str = ""  # dotted name of its ``View``: how a page in the browser shows it
    wiring: tuple[str, ...] = ()  # sentences for the FMU's page: how to connect it

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        found: ModelSpec = resolve(self.interface)
        return found

    def commands(self) -> tuple[str, ...]:
        """Return the names of the model's commands."""
        return (self.key, *self.command.more) if self.command else ()
