"""The interface of a model as FMUs show it: everything they show comes from here.

It is made from the parameter dataclass and the model's inputs and outputs. Value references count
0, 1, 2, ... over ``time``, inputs, parameters (dataclass fields, then ``fidelity``), outputs, and
inputs that came later; they are the same for every target and FMI version.
"""

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import MISSING, Field, dataclass, fields
from functools import cached_property
from typing import Any

from ...errors import Status
from ...model.spec import NAMED, ModelSpec, Signal

LOG_CATEGORIES = {  # in the order of the enum in the shell's tables.h
    "logStatusWarning": "Results that need care, such as distress or too hot",
    "logStatusError": "Refused values and failed steps, with the reason",
    "logNonlinearSystems": "What the solver took in each step",
    "logEvents": "Film lost or regained, lock and break-away: once each",
    "logAll": "Everything, also tracebacks of defects",
}
MOST_STEPS = 1000  # of the default experiment; beyond it FMPy silently enlarges the step
EVENT_OUTPUTS = ("film_ratio", "engine_speed", "temperature")  # next to the inputs in messages
ADVISED = "advised_step"  # the output that a host's step is compared with
LATER = {"K": "K/s", "J": "W", "rad": "rad/s", "1": "1/s"}  # unit of a state -> of its derivative
LARGEST = sys.float_info.max  # bound of a variable without bounds: NaN and infinity still fail


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """One named number of an enumeration."""

    name: str
    value: int
    help: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """One variable of an FMU.

    ``store`` and ``slot`` say where the number lives: "time", or element ``slot`` of the kernel
    arrays "par", "inp", "out", "iout"; for model exchange also of "own" (its parameters), "cont"
    (states), "der" (derivatives), "sign" (event indicators). ``depends`` names the inputs that act
    on an output at once, in model exchange with those in ``exchange_depends``, ``states`` the
    continuous states that do; of a derivative likewise.
    """

    name: str
    reference: int
    store: str
    slot: int
    help: str
    type: str = "Real"  # or Integer, Boolean, Enumeration
    causality: str = "parameter"  # or independent, input, output
    variability: str = "fixed"
    initial: str | None = "exact"
    unit: str = "1"
    type_name: str | None = None  # of an enumeration
    low: float | None = None
    high: float | None = None
    nominal: float | None = None
    start: float | None = None
    depends: tuple[str, ...] = ()
    relative: bool = False
    states: tuple[str, ...] = ()
    exchange_depends: tuple[str, ...] = ()
    derivative_of: str | None = None

    @property
    def bounds(self) -> tuple[float, float]:
        """The allowed range, both ends belonging to it."""
        low = -LARGEST if self.low is None else self.low
        return low, LARGEST if self.high is None else self.high


@dataclass(frozen=True, eq=False)
class Interface:
    """All that an FMU shows of a model; ``interface`` makes it, whatever writes or runs takes it.

    ``variables`` are in the order of their value references, ``enumerations`` by type name.
    ``exchanged`` are those that model exchange adds behind them: states that are no outputs,
    derivatives, parameters, event indicators.
    """

    spec: ModelSpec
    variables: tuple[Variable, ...]
    inputs: tuple[Variable, ...]
    parameters: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    enumerations: dict[str, tuple[Item, ...]]
    exchanged: tuple[Variable, ...] = ()

    @cached_property
    def everything(self) -> tuple[Variable, ...]:
        """All variables, those of model exchange too."""
        return (*self.variables, *self.exchanged)

    @cached_property
    def continuous(self) -> tuple[Variable, ...]:
        """The continuous states, in their order."""
        own = self.spec.exchange.states if self.spec.exchange else ()
        known = {v.name: v for v in self.everything}
        return tuple(known[s.name] for s in own)

    @cached_property
    def derivatives(self) -> tuple[Variable, ...]:
        """Derivatives of the continuous states, in their order."""
        return tuple(v for v in self.exchanged if v.store == "der")

    @cached_property
    def status_slot(self) -> int | None:
        """The place of ``solver_status`` in ``iout``."""
        return next((v.slot for v in self.outputs if v.type_name == "SolverStatus"), None)

    @cached_property
    def listed(self) -> dict[str, tuple[Item, ...]]:
        """The enumerations without the levels that are gone, whose numbers are still taken."""
        gone = self.spec.successors
        found = {"Fidelity": tuple(i for i in self.enumerations["Fidelity"] if i.name not in gone)}
        return {**self.enumerations, **found}

    @cached_property
    def point(self) -> tuple[Variable, ...]:
        """What a message about an event says of the operating point."""
        return tuple(v for v in self.variables if v in self.inputs or v.name in EVENT_OUTPUTS)

    @cached_property
    def switches(self) -> tuple[tuple[int, tuple[str, str]], ...]:
        """Outputs that make events: place in ``iout``, texts of becoming true and false."""
        pairs = zip(self.outputs, self.spec.outputs, strict=True)
        return tuple((v.slot, signal.events) for v, signal in pairs if signal.events)

    def instants(self, slot: int) -> tuple[int, int]:
        """Return the places in ``out`` of the times of both events of a switch, -1: not told."""
        pairs = zip(self.outputs, self.spec.outputs, strict=True)
        named = next(s.instants for v, s in pairs if s.events and v.slot == slot)
        places = {v.name: v.slot for v in self.outputs if v.store == "out"}
        return places.get(named[0], -1), places.get(named[1], -1)

    @cached_property
    def counts(self) -> tuple[tuple[str, int], ...]:
        """What the model's solver counts: text, place in ``work``."""
        return self.spec.counted()

    @cached_property
    def categories(self) -> dict[str, str]:
        """The categories this model sends messages in, with what they mean."""
        silent = set() if self.counts else {"logNonlinearSystems"}
        if not self.switches:
            silent.add("logEvents")
        return {name: text for name, text in LOG_CATEGORIES.items() if name not in silent}

    @property
    def experiment(self) -> tuple[float, float]:
        """Stop time and step size [s] of the default experiment; the start time is 0."""
        step = self.spec.step_size
        return min(self.spec.stop_time, MOST_STEPS * step), step

    def ranges(self, room: int = 0) -> tuple[list[tuple[float, float]], ...]:
        """Return the part's box and the verified range of every input, of ``room`` places in all.

        Where there is none it is as wide as numbers are.
        """
        wide, inputs = (-LARGEST, LARGEST), self.spec.inputs
        found = (
            [self.spec.box.get(s.name, wide) for s in inputs],
            [(s.verified[0], s.verified[1]) if s.verified else wide for s in inputs],
        )
        return tuple(own + [wide] * (room - len(own)) for own in found)


_made: dict[int, Interface] = {}


def interface(spec: ModelSpec) -> Interface:
    """Return the interface of a model, made once for each record."""
    if id(spec) not in _made:
        items, slots = _enumerations(spec), Counter[str]()
        made: list[Variable] = []
        for store, entry in _entries(spec):
            if entry.get("type") == "Enumeration":
                numbers = [item.value for item in items[entry["type_name"]]]
                entry |= {"low": min(numbers), "high": max(numbers)}
            made.append(Variable(reference=len(made), store=store, slot=slots[store], **entry))
            slots[store] += 1
        inputs, parameters, outputs = (
            tuple(v for v in made if v.causality == kind)
            for kind in ("input", "parameter", "output")
        )
        more = tuple(_exchanged(spec, len(made)))
        _made[id(spec)] = Interface(spec, tuple(made), inputs, parameters, outputs, items, more)
    return _made[id(spec)]


def _exchanged(spec: ModelSpec, first: int) -> Iterator[Variable]:
    """Give the variables that model exchange adds; their value references begin with ``first``."""
    own, slots = spec.exchange, Counter[str]()
    if own is None:
        return
    entries: list[tuple[str, Signal, str | None]] = [
        ("cont", s, None) for s in own.states if s.name not in spec.real_outputs
    ]
    entries += [("der", s, s.name) for s in own.states]
    entries += [("own", s, None) for s in own.parameters]
    entries += [
        ("sign", Signal(name=f"event_indicator_{k}", unit="1", help=f"passes zero at {text}"), None)
        for k, text in enumerate(own.indicators, 1)
    ]
    names = {s.name: k for k, s in enumerate(own.states)}
    for place, (store, signal, base) in enumerate(entries):
        entry = _signal(signal, causality="local", initial="calculated")
        if store == "own":
            fixed = {"causality": "parameter", "initial": "exact", "variability": "fixed"}
            entry |= fixed | {"start": signal.start}
        if base is not None:
            needs = own.needs[f"der({base})"]
            words = f"rate of change of {base}; in co-simulation over the last step"
            entry |= {"name": f"der({base})", "unit": LATER[signal.unit], "help": words}
            entry |= {"low": None, "high": None, "relative": False, "derivative_of": base}
            entry |= {"states": tuple(n for n in needs if n in names)}
            entry |= {"depends": tuple(n for n in needs if n not in names)}
        if store == "sign":
            entry |= {"states": tuple(names), "depends": tuple(s.name for s in spec.inputs)}
        slot = names[signal.name] if store == "cont" else slots[store]
        slots[store] += 1
        yield Variable(reference=first + place, store=store, slot=slot, **entry)


def _entries(spec: ModelSpec) -> Iterator[tuple[str, dict[str, Any]]]:
    """Give store and fields of the variables, in the order of their value references."""
    clock = Signal(name="time", unit="s", help="time of the present communication point")
    yield "time", _signal(clock, causality="independent", initial=None)
    for signal in spec.inputs:
        if not signal.late:
            yield "inp", _input(signal)
    for f in fields(spec.params):
        yield "par", _parameter(f)
    level = list(spec.fidelities).index(spec.default_fidelity) + 1.0
    kind = {"type": "Enumeration", "type_name": "Fidelity"}
    words = "how finely the model is resolved"
    yield "par", kind | {"name": "fidelity", "help": words, "start": level}
    for signal in spec.outputs:
        store = "out" if signal.kind == "real" else "iout"
        own = {"causality": "output", "initial": "calculated", "depends": signal.depends}
        needs = spec.exchange.needs.get(signal.name, ()) if spec.exchange else ()
        states = {s.name for s in spec.exchange.states} if spec.exchange else set()
        own["states"] = tuple(n for n in needs if n in states)
        own["exchange_depends"] = tuple(n for n in needs if n not in states)
        yield store, _signal(signal, **own)
    for signal in spec.inputs:
        if signal.late:
            yield "inp", _input(signal)


def _input(signal: Signal) -> dict[str, Any]:
    return _signal(signal, causality="input", initial=None, start=signal.in_fmus)


def _enumerations(spec: ModelSpec) -> dict[str, tuple[Item, ...]]:
    found = {"Fidelity": _counted(spec.fidelities)}
    for f in fields(spec.params):
        if f.metadata["kind"] == "enumeration":
            found[f.metadata["type"]] = _counted(f.metadata["options"])
    statuses = tuple(Item(name=s.name, value=int(s), help=s.advice) for s in sorted(Status))
    shared = {name: _counted(names) for name, names in NAMED.items()} | {"SolverStatus": statuses}
    used = {signal.type for signal in (*spec.inputs, *spec.outputs)}
    return found | {name: items for name, items in shared.items() if name in used}


def _counted(options: dict[str, str]) -> tuple[Item, ...]:
    return tuple(Item(name=n, value=i, help=t) for i, (n, t) in enumerate(options.items(), 1))


def _signal(signal: Signal, **own: object) -> dict[str, Any]:
    same = ("name", "unit", "help", "low", "high", "nominal", "relative")
    return (
        own
        | {name: getattr(signal, name) for name in same}
        | {
            "type": signal.kind.capitalize(),
            "type_name": signal.type,
            "variability": "continuous" if signal.kind == "real" else "discrete",
        }
    )


def _parameter(f: "Field[Any]") -> dict[str, Any]:
    m = f.metadata
    assert f.default is not MISSING, "every parameter has a default"
    start = list(m["options"]).index(f.default) + 1 if "options" in m else f.default
    return {
        "name": f.name,
        "type": m["kind"].capitalize(),
        "variability": "tunable" if m.get("tunable") else "fixed",
        "unit": m["unit"],
        "help": m["help"],
        "type_name": m.get("type"),
        "low": m["min"],
        "high": m["max"],
        "nominal": m.get("nominal") or abs(float(start)) or None,
        "start": float(start),
        "relative": m.get("relative", False),
    }
