"""One list of variables per model: everything an FMU shows comes from here.

The list is made from the parameter dataclass and the model's inputs and outputs. Value references
count 0, 1, 2, ... over ``time``, inputs, parameters (dataclass fields, then ``fidelity``), outputs;
they are the same for every target and FMI version.
"""

import sys
from collections.abc import Iterator
from dataclasses import MISSING, Field, dataclass, fields
from typing import Any

from ...errors import Status
from ...model.spec import REGIMES, ModelSpec, Signal

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
    arrays "par", "inp", "out", "iout". ``depends`` names the inputs that act on an output at once.
    """

    name: str
    reference: int
    type: str  # Real, Integer, Boolean or Enumeration
    causality: str  # independent, input, parameter or output
    variability: str
    initial: str | None
    unit: str
    help: str
    store: str
    slot: int
    type_name: str | None = None  # of an enumeration
    low: float | None = None
    high: float | None = None
    nominal: float | None = None
    start: float | None = None
    depends: tuple[str, ...] = ()
    relative: bool = False

    @property
    def bounds(self) -> tuple[float, float]:
        """The allowed range, both ends belonging to it."""
        low = -LARGEST if self.low is None else self.low
        return low, LARGEST if self.high is None else self.high


EVENT_OUTPUTS = ("film_ratio", "engine_speed", "temperature")  # beside the inputs in messages


def ranges(spec: ModelSpec, room: int = 0) -> tuple[list[tuple[float, float]], ...]:
    """Return the part's box and the verified range of every input, and of ``room`` places in all.

    Where there is none it is as wide as numbers are.
    """
    wide = (-LARGEST, LARGEST)
    found = (
        [spec.box.get(s.name, wide) for s in spec.inputs],
        [(s.verified[0], s.verified[1]) if s.verified else wide for s in spec.inputs],
    )
    return tuple(own + [wide] * (room - len(own)) for own in found)


_made: dict[int, tuple[ModelSpec, tuple[Variable, ...]]] = {}


def variables(spec: ModelSpec) -> tuple[Variable, ...]:
    """Return the variables of a model in the order of their value references."""
    if id(spec) not in _made:
        time = {
            "name": "time", "type": "Real", "causality": "independent", "store": "time", "slot": 0,
            "variability": "continuous", "initial": None, "unit": "s",
            "help": "time of the present communication point",
        }  # fmt: skip
        entries = [time, *(_signal(s, "inp", i) for i, s in enumerate(spec.inputs))]
        entries += (_parameter(i, f) for i, f in enumerate(fields(spec.params)))
        entries += [_fidelity(spec), *_outputs(spec)]
        items = enumerations(spec)
        for entry in entries:
            if entry["type"] == "Enumeration":
                numbers = [item.value for item in items[entry["type_name"]]]
                entry["low"], entry["high"] = min(numbers), max(numbers)
        made = tuple(Variable(reference=i, **entry) for i, entry in enumerate(entries))
        _made[id(spec)] = spec, made
    return _made[id(spec)][1]


def enumerations(spec: ModelSpec) -> dict[str, tuple[Item, ...]]:
    """Return the enumerations that occur in this model, by type name."""
    found = {"Fidelity": _counted(spec.fidelities)}
    for f in fields(spec.params):
        if f.metadata["kind"] == "enumeration":
            found[f.metadata["type"]] = _counted(f.metadata["options"])
    shared = {
        "Regime": _counted(REGIMES),
        "SolverStatus": tuple(
            Item(name=s.name, value=int(s), help=s.advice) for s in sorted(Status)
        ),
    }
    used = {signal.type for signal in (*spec.inputs, *spec.outputs)}
    return found | {name: items for name, items in shared.items() if name in used}


def _counted(options: dict[str, str]) -> tuple[Item, ...]:
    return tuple(Item(name=n, value=i, help=t) for i, (n, t) in enumerate(options.items(), 1))


def _outputs(spec: ModelSpec) -> Iterator[dict[str, Any]]:
    """Real outputs fill ``out``, the others ``iout``, both in the order of the list."""
    filled = {"out": 0, "iout": 0}
    for signal in spec.outputs:
        store = "out" if signal.kind == "real" else "iout"
        yield _signal(signal, store, filled[store])
        filled[store] += 1


def _signal(signal: Signal, store: str, slot: int) -> dict[str, Any]:
    start = signal.start or 0.0
    own = (
        {"causality": "input", "initial": None, "start": start} if store == "inp" else
        {"causality": "output", "initial": "calculated", "depends": signal.depends}
    )  # fmt: skip
    return own | {
        "name": signal.name, "type": signal.kind.capitalize(), "unit": signal.unit,
        "help": signal.help, "type_name": signal.type, "low": signal.low, "high": signal.high,
        "nominal": signal.nominal, "relative": signal.relative, "store": store, "slot": slot,
        "variability": "continuous" if signal.kind == "real" else "discrete",
    }  # fmt: skip


def _parameter(slot: int, f: "Field[Any]") -> dict[str, Any]:
    m = f.metadata
    assert f.default is not MISSING, "every parameter has a default"
    start = list(m["options"]).index(f.default) + 1 if "options" in m else f.default
    return {
        "name": f.name, "type": m["kind"].capitalize(), "causality": "parameter",
        "variability": "tunable" if m.get("tunable") else "fixed", "initial": "exact",
        "unit": m["unit"], "help": m["help"],
        "store": "par", "slot": slot, "type_name": m.get("type"), "low": m["min"],
        "high": m["max"], "nominal": m.get("nominal") or abs(float(start)) or None,
        "start": float(start), "relative": m.get("relative", False),
    }  # fmt: skip


def _fidelity(spec: ModelSpec) -> dict[str, Any]:
    return {
        "name": "fidelity", "type": "Enumeration", "causality": "parameter",
        "variability": "fixed", "initial": "exact", "unit": "1", "store": "par",
        "slot": len(fields(spec.params)), "type_name": "Fidelity",
        "help": "how finely the model is resolved",
        "start": float(list(spec.fidelities).index(spec.default_fidelity) + 1),
    }  # fmt: skip
