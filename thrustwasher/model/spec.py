"""What a model shows to the outside: inputs, outputs, parameters, kernel; as data.

The FMU variables, the command line's columns and the documentation come from these lists.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, make_dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

T = TypeVar("T")
REGIMES = {
    "film": "film ratio above 3: the oil film carries",
    "mixed": "film ratio 1 to 3: film and asperities share the load",
    "boundary": "film ratio below 1: the asperities carry",
    "adhesive": "the surfaces stick: static friction",
}
CHURNING_REGIMES = {
    "none": "the gear runs above the oil, or stands",
    "viscous": "centrifugal acceleration below 750 m/s2, Re below 4000: the more viscous, the more",
    "inertial": "centrifugal acceleration below 750 m/s2, Re from 4000 on",
    "between": "centrifugal acceleration of 750 to 1250 m/s2, from one law to the other",
    "centrifugal_viscous": "centrifugal acceleration above 1250 m/s2, Re below 4000",
    "centrifugal_inertial": "centrifugal acceleration above 1250 m/s2, Re from 4000 on",
}
NAMED = {"Regime": REGIMES, "ChurningRegime": CHURNING_REGIMES}
"""Enumerations of outputs: type -> name -> meaning, numbered from 1."""


@dataclass(frozen=True, kw_only=True)
class Signal:
    """One input or output.

    ``kind`` is "real", "boolean", "integer" or "enumeration" (then ``type`` names the enumeration,
    e.g. "Regime", "SolverStatus"). ``start`` is for inputs only, and ``first``, where FMUs start at
    another value, so that a first run shows a working point. ``depends`` lists the inputs that
    enter an output at once, at the same time point; an output that is an integral of the past
    has none. ``events``, of a Boolean output, says what happens when it becomes true, then false;
    ``instants`` names the outputs that tell when [s], where there are any.
    ``limit`` is the temperature [K] that an output should stay below.
    ``verified`` is the range of an input for which the accuracy was verified; empty: all of it.
    """

    name: str
    unit: str
    help: str
    kind: str = "real"
    type: str | None = None
    low: float | None = None
    high: float | None = None
    nominal: float | None = None
    start: float | None = None
    first: float | None = None
    depends: tuple[str, ...] = ()
    relative: bool = False  # a temperature difference, no absolute temperature
    optional: bool = False  # an input that may be left out: it is at its start then
    events: tuple[str, str] | None = None
    instants: tuple[str, str] = ("", "")
    limit: float | None = None
    verified: tuple[float, ...] = ()
    late: bool = False  # an input that came later: its value reference follows all others
    at_zero: str = ""  # another input, whose value counts where this one is 0

    @property
    def in_fmus(self) -> float:
        """The start value of an input in FMUs."""
        return (self.start or 0.0) if self.first is None else self.first

    @property
    def usual(self) -> float:
        """The value of an input that is not given: its start, or a nominal one in place of 0."""
        return self.start or (0.0 if self.optional else self.nominal) or 0.0

    @property
    def range(self) -> tuple[float, float]:
        """The bounds; infinite where there is none."""
        low, high = self.low, self.high
        return -math.inf if low is None else low, math.inf if high is None else high


def no_outputs(_params: object) -> frozenset[str]:
    """Return the outputs without a value of a model that has a value of all."""
    return frozenset()


def output(
    name: str, unit: str, nominal: float, help: str, depends: tuple[str, ...] = (), **more: Any
) -> Signal:
    """Return a real output."""
    return Signal(name=name, unit=unit, nominal=nominal, help=help, depends=depends, **more)


@dataclass(frozen=True)
class Rule:
    """The message when parameters contradict each other.

    ``text`` names parameters in braces and stands for itself wherever no Python runs; ``exact``,
    if given, makes the message from the parameters with figures that have to be computed.
    """

    text: str
    exact: Callable[[Any], str] | None = None

    def message(self, params: Any) -> str:
        """Return the text with the values of ``params`` in it."""
        if self.exact is not None:
            return self.exact(params)
        names = type(params).__dataclass_fields__
        return self.text.format(**{name: repr(getattr(params, name)) for name in names})


@dataclass(frozen=True, kw_only=True)
class Terminal:
    """A plug of the FMU: which variables belong together; ``members``: (variable, member, kind)."""

    name: str
    kind: str
    help: str
    members: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, kw_only=True)
class Exchange:
    """What a model has for model exchange, where a host's solver owns the continuous states.

    ``states`` are in the order of the kernels' array; one of the name of an output is that output.
    ``needs``: output or derivative, ``der(x)``, to the states and inputs that act on it;
    ``start(x)`` to the inputs that a state starts from. ``indicators``: what is so where each
    passes zero. ``parameters`` are those that only model exchange reads. ``steps``: the kernels
    have to hear of every step that the solver has completed. ``requires``: the value that a
    parameter has to have, where another one is for co-simulation only.
    """

    kernel: str  # dotted name of the module with start(), rates(), update() and slopes()
    states: tuple[Signal, ...]
    needs: Mapping[str, tuple[str, ...]]
    requires: Mapping[str, float] = field(default_factory=dict)
    indicators: tuple[str, ...] = ("no event: it stays at 1, so that hosts follow the inputs",)
    parameters: tuple[Signal, ...] = ()
    steps: bool = False


class Tables(NamedTuple):
    """Files of solutions made beforehand, in which one of a model's levels looks its answers up.

    A file has a ``path``, its ``data`` as the kernel takes them, and a ``metadata``.
    """

    level: str
    paths: Callable[[], list[Path]]  # of all files there are
    readable: Callable[[bool], Sequence[Any]]  # sound files: those of the package alone, or all
    find: Callable[[Any], Any]  # the file for parameters; ParameterError if there is none
    box: Callable[[Any], Mapping[str, tuple[float, float]]]  # that it covers, by input
    resource: Callable[[Any], bytes]  # a file as it lies in an FMU
    build: Callable[..., None]  # (parameters, box, tolerance, workers, progress): keep one
    lines: Callable[..., int]  # (parameters, box, tolerance): what building one has to solve
    least: Callable[[str, tuple[float, float]], float]  # of an input with this box, to be covered
    tolerances: tuple[float, float]  # relative, allowed
    kept: Callable[[], str]  # in words: what is kept in the user's cache, and where


@dataclass(frozen=True, kw_only=True)
class ModelSpec:
    """A model as an FMU importer sees it."""

    key: str  # "washer": command line and slave
    name: str  # "ThrustWasher": FMU model name
    help: str  # one sentence
    params: type[Any]  # the parameter dataclass
    fidelities: dict[str, str]  # level -> one sentence, in the order of the enumeration, from 1
    default_fidelity: str
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]  # real outputs fill `out` in order, all others `iout`
    kernel: str  # dotted name of the module with derive(), step() and so on
    rules: tuple[Rule, ...] = ()  # between parameters, in the order of the kernel's broken_rule()
    terminals: tuple[Terminal, ...] = ()
    stop_time: float = 1.0
    step_size: float = 1e-3
    # The reference run: rows of time and all inputs, linear between; none: inputs at their start.
    profile: tuple[tuple[float, ...], ...] = ()
    counted: Callable[[], tuple[tuple[str, int], ...]] = tuple
    """Returns what the solver counts: text, place in ``work``."""
    absent: Callable[[Any], frozenset[str]] = no_outputs
    """From parameters to the names of outputs without a value; an FMU has the number there that
    the output's help names."""
    scatter: Mapping[str, Any] = field(default_factory=dict)
    """How parameters and inputs scatter with the default parameters: a table ``[scatter]``."""
    # Of your own part: the name of the model, the inputs it is meant for, what else is known.
    kind: str = ""
    box: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    notes: str = ""
    # Of a model that only looks up: the parameters that its table was made for.
    table_of: Any = None
    # What it shows for model exchange; None: it is for co-simulation only.
    exchange: Exchange | None = None
    # Fidelities that are gone -> the next better one, which the kernel runs under their number.
    successors: Mapping[str, str] = field(default_factory=dict)

    @property
    def levels(self) -> dict[str, str]:
        """The fidelities there are, each with its sentence."""
        return {n: text for n, text in self.fidelities.items() if n not in self.successors}

    @property
    def real_outputs(self) -> list[str]:
        """Names of the outputs that are real numbers, as they lie in `out`."""
        return [signal.name for signal in self.outputs if signal.kind == "real"]


def derived(base: type[T], name: str, more: Sequence[tuple[str, Any, Any]]) -> type[T]:
    """Return a frozen dataclass of this name: the base's fields, then ``more``.

    ``more``: name, type and field of each. It belongs to the base's module, where digests look for
    its source and pickle for its name; ``make_dataclass`` alone writes its caller's module from
    Python 3.12 on, whatever is given.
    """
    made = make_dataclass(
        name, more, bases=(base,), frozen=True, kw_only=True, namespace={"__doc__": base.__doc__}
    )
    made.__module__ = base.__module__
    return made


def tailored(
    spec: ModelSpec, parameters: Mapping[str, Any], starts: Mapping[str, float], **more: Any
) -> ModelSpec:
    """Return the model with these values of parameters and inputs as its defaults: same kernels.

    ``fidelity`` is among the parameters; what is not named stays as it is. ``more`` are other
    fields of the model, such as ``name`` and, of its default experiment [s], ``stop_time``; its
    inputs hold unless a ``profile`` is among them.
    """
    kept = [
        (f.name, f.type, field(default=parameters.get(f.name, f.default), metadata=f.metadata))
        for f in fields(spec.params)
    ]
    params = derived(spec.params, spec.params.__name__, kept)
    params()  # raises what the model says about values that do not go together
    own = {
        "params": params,
        "kind": spec.kind or spec.name,
        "profile": (),
        "default_fidelity": parameters.get("fidelity", spec.default_fidelity),
        "inputs": tuple(
            replace(s, start=starts[s.name], first=None) if s.name in starts else s
            for s in spec.inputs
        ),
    }
    return replace(spec, **(own | more))
