"""The record of a model: all that the layers below and above it know of it.

Each model has a class of its own, in the module ``model`` of its folder. What it returns is
imported when it is requested. What draws a model, shows it in a browser or finds its reference
values lies above it, in one list each: ``studio.report.model_plots``, ``studio.explore.page``,
``studio.verification.reference_cache``, ``lab.charts.work_precision``; the fit of a law of its own
in ``studio.calibration.run_calibration``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import ParameterError
from ..face_load import Face
from .spec import ModelSpec, Signal, Tables

if TYPE_CHECKING:  # not every command needs numpy
    import numpy as np
    from numpy.typing import NDArray

Scaled = tuple[float, float, str]  # low, high, "linear" or "log"
Values = dict[str, float]


@dataclass(frozen=True, kw_only=True)
class Option:
    """An argument of a model's ``solve`` as an option of its command."""

    name: str
    help: str
    choices: tuple[str, ...] | None = None
    read: Callable[[str], Any] = str  # makes its value of the text
    metavar: str | None = None


@dataclass(frozen=True, kw_only=True)
class Variants:
    """Results side by side for several variants, such as two steels: a table below the others."""

    head: str  # what a row is; the parameter of this name holds the chosen one
    rows: Mapping[str, str]  # words -> ending of the fields' names
    columns: Mapping[str, str]  # field without its ending -> head
    chosen: str  # words next to the row that the parameters choose

    def name(self, column: str, row: str) -> str:
        """Return the name of a field."""
        return f"{column}_{self.rows[row]}"

    def fields(self) -> set[str]:
        """Return all fields in the table, and those of the chosen variant, which it repeats."""
        table = {self.name(column, row) for column in self.columns for row in self.rows}
        return table | set(self.columns)


@dataclass(frozen=True, kw_only=True)
class Command:
    """The command that solves a model at one operating point, next to what its interface says."""

    help: str
    examples: tuple[str, str]  # command lines that run
    title: str  # may name parameters: "gear mesh, {pinion_teeth} teeth"
    closing: str = "{fidelity}"  # how it was solved; may name results
    plot: str = ""  # what --plot draws
    report: str = ""  # what --report writes, if anything
    report_by: str = ""  # what writes it, a name of ``plugins``: (file, part, operating points)
    extra: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    """Results that are no output: unit and meaning."""
    instead: Mapping[str, Signal] = field(default_factory=dict)
    """Name of a model's input -> what this command has instead of it."""
    options: tuple[Option, ...] = ()  # more arguments of ``solve``
    variants: Variants | None = None
    more: tuple[str, ...] = ()  # other commands of this model, which are files
    ranks: bool = False  # results have ``sensitivities``


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """What the choice of a level and the making of its verification tables need to know."""

    kernels: Mapping[str, tuple[str, ...]]
    """Levels that can be chosen, in the order of their cost -> modules that compute them."""
    boxes: Mapping[str, Mapping[str, Scaled]]
    """Parameter set -> range of every input: "default", a scene, or "scene.part"."""
    part: str  # of a scene, where a parameter set names none
    only: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """Level -> parameters and the values with which alone it differs from the one before."""


@dataclass(frozen=True, kw_only=True)
class Fits:
    """Outputs that can be fitted in addition to those of a model's solutions at points."""

    units: Mapping[str, str] = field(default_factory=dict)
    computed: Callable[[Any, Mapping[str, float], str], Mapping[str, float]] | None = None
    """Of parameters, point and level, those that there are; None: a law of the model's own has them
    (``studio.calibration.run_calibration``)."""
    without: str = ""  # the input that these do not depend on
    none: str = ""  # what a point means that has none of them
    slopes: Callable[..., Any] | None = None
    """Exact derivatives of outputs, of these too: called with (parameters, inputs of a line's
    rows, level, wanted: (row, output), names of parameters), returns (wanted, parameters) or None
    where there are none."""
    sliding_radius: Callable[[Any], float] | None = None
    """From parameters to the radius [m] at which the speed slides."""
    at_mean: bool = False
    """That radius is a mean: a measured sliding speed [m/s] over it is a speed."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """What a sweep does otherwise than by steps of the model's kernel."""

    walk: Callable[..., None] | None = None  # fills the rows of lines with the same parameters
    not_shown: tuple[str, ...] = ()  # outputs that make no sense there
    doubt: Callable[[Any, str, Sequence[NDArray[np.float64]]], str] | None = None
    """From parameters, fidelity and columns of inputs to a warning or ""."""
    least: Mapping[str, tuple[float, str]] = field(default_factory=dict)
    """Output -> value that it should not be below, and what it means there."""
    draws: Callable[..., Any] | None = None
    """Solves rows of which each has parameters of its own, on the branch that it is on when it
    comes from light load (from heavy load with ``above``): called with (parameters of each row or
    None, inputs, fidelity, above=), returns outputs, statuses, and whether the film is lost."""


class Model(ABC):
    """A model of the package."""

    key: str  # "washer": on the command line, in sweeps and verification tables
    wiring: tuple[str, ...] = ()  # sentences for the FMU's page: how to connect it
    command: Command | None = None  # None: it is not solved at operating points
    ladder: Ladder | None = None  # None: it has no verification tables
    quick: bool = False  # microseconds a point, on no branch: pictures may solve more of them

    @property
    @abstractmethod
    def spec(self) -> ModelSpec:
        """What an importer sees."""

    @property
    def name(self) -> str:
        """Name of its FMU."""
        return self.spec.name

    @property
    def solve(self) -> Callable[..., Any]:
        """What solves it at a point: called with (parameters, **point, fidelity=, **options)."""
        raise NotImplementedError(self.key)

    def commands(self) -> tuple[str, ...]:
        """Return the names of the model's commands."""
        return (self.key, *self.command.more) if self.command else ()

    def inputs(self) -> list[Signal]:
        """Return the inputs of its command, in the order of the model's own."""
        instead = self.command.instead if self.command else {}
        return [instead.get(s.name, s) for s in self.spec.inputs]

    def place(self, point: Values) -> Values:
        """Return the model's own inputs at a point of its command."""
        return dict(point)

    def back(self, inputs: Values) -> Values:
        """Return the point of its command with these inputs of the model."""
        return dict(inputs)

    def doubts(self, _params: object, _inputs: Mapping[str, float]) -> Iterable[str]:
        """Return what lies outside the range of a law at inputs of the model, a line each."""
        return ()

    def doubt(self, _result: object) -> str:
        """Return a warning that takes a solve of its own, "" if nothing."""
        return ""

    def tables(self) -> Tables | None:
        """Return where one of its levels looks its answers up; None if all of them solve."""
        return None

    scene_of = ""  # "a gear train": what a part file is a scene of that has a table [key]

    def flat(self, where: str, _table: dict[str, Any], _folder: Path | None) -> dict[str, Any]:
        """Return the table of a part file for that of a scene; ``folder`` of files it names."""
        raise NotImplementedError(where)

    def nested(self, part: Any) -> Iterable[str]:
        """Return the lines of the file of such a scene, but its box and scatter."""
        raise NotImplementedError(part.name)

    def own_names(self, _source: str | None) -> Callable[[str], str]:
        """Return what gives names and texts the words of a part's file or preset."""
        return str

    def face(self, _params: Any) -> Face | None:
        """Return the friction faces of a part; None where it has none."""
        return None

    alone: tuple[str, ...] = ()  # levels that there are FMUs of their own of

    def of_one_level(self, spec: ModelSpec, level: str) -> ModelSpec:
        """Return a model of this kind, or a part's, that has nothing but one of its levels.

        ParameterError if there is no such FMU.
        """
        raise ParameterError(
            f"fidelity = {level!r} alone, for {spec.name}, allowed: "
            + (" or ".join(map(repr, self.alone)) or "none; its FMU has all of its fidelities")
        )

    @property
    def sweep(self) -> Sweep:
        """What a sweep of it does otherwise."""
        return Sweep()

    @property
    def fits(self) -> Fits:
        """What can be fitted in addition to its outputs."""
        return Fits()
