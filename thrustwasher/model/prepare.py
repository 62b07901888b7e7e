"""From a parameter dataclass to what a kernel takes: checked by its rules, filled in, with tables.

The kernel tests the rules between parameters, the texts in the interface say which one is broken.
Profiles of inputs over time are checked here too.
"""

import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, Status
from ..units import into_range
from .levels import level_named
from .parameters import as_numbers, check_rules
from .registry import MODELS, find_model
from .spec import ModelSpec, Signal, Tables

Array = NDArray[np.float64]
WITHOUT_PAST = {"thermal_mode": "quasi_steady", "holding": "off"}
KEPT = 16  # parameter objects
T = TypeVar("T")


class Recent(Generic[T]):
    """What ``make(params, *key)`` returned for the last few parameters of this thread.

    The object itself is looked for first, which is quicker than comparing all its fields; one that
    is new and equal finds what was made for the other.
    """

    def __init__(self, make: Callable[..., T]) -> None:
        self.make, self.local = make, threading.local()

    def __call__(self, params: Any, *key: object) -> T:
        """Return what was made for this object, or make it."""
        try:
            known: dict[Any, tuple[Any, T]] = self.local.known
        except AttributeError:
            known, self.local.equal = {}, {}
            self.local.known = known
        found = known.get((id(params), key))
        if found is not None and found[0] is params:
            return found[1]
        equal: dict[Any, T] = self.local.equal
        if len(known) >= KEPT:
            known.clear()
        made = equal.get((params, key))
        if made is None:
            if len(equal) >= KEPT:
                equal.clear()
            made = equal[params, key] = self.make(params, *key)
        known[id(params), key] = params, made
        return made

    def forget(self) -> None:
        """Make all anew: a file that something was made of has changed."""
        self.local = threading.local()


def filled(
    spec: ModelSpec, params: Any, fidelity: str, size: int, derive: Callable[[Any], int]
) -> Any:
    """Return the ``size`` numbers of a kernel's ``par``: parameters, level, derived constants.

    It is for solutions without a past: a washer's bodies are taken as steady, nothing is held.
    ParameterError if the
    level is not one of the model's, or the parameters cannot be used together.
    """
    level = level_named(spec, fidelity)
    numbers = [*as_numbers(params, WITHOUT_PAST), list(spec.fidelities).index(level) + 1]
    par = np.zeros(size)
    par[: len(numbers)] = numbers
    status = Status(derive(par))
    if status.is_failure:
        raise ParameterError(f"the {spec.key} parameters cannot be used: {status.advice}")
    return par


def check_together(spec: ModelSpec, params: object, fidelity: str) -> None:
    """Raise ParameterError for the first rule that parameters and fidelity break together."""
    if spec.rules:  # a model from elsewhere may have its kernel elsewhere too
        rule = getattr(import_module(spec.kernel), "broken_rule", None)
        if rule is not None:
            check_rules(params, spec.rules, rule, list(spec.fidelities).index(fidelity) + 1)


def wants_table(spec: ModelSpec, par: Any) -> bool:
    """Tell if the level in ``par`` reads a table."""
    known = _known(spec)
    return bool(known) and par[int(known["SWITCH"])] == known["ON"]


def with_box(spec: ModelSpec) -> ModelSpec:
    """Return a model whose inputs' descriptions name the ends of its map's box, if it has one."""
    tables = tables_of(spec)
    if tables is None:
        return spec
    try:
        box = tables.box(spec.table_of or spec.params())
    except ParameterError:  # no map was made for it
        return spec
    return replace(spec, inputs=tuple(_told(s, box, tables.level) for s in spec.inputs))


def _told(signal: Signal, box: Mapping[str, tuple[float, float]], level: str) -> Signal:
    if signal.name not in box:
        return signal
    low, high = box[signal.name]
    unit = "" if signal.unit == "1" else f" {signal.unit}"
    return replace(signal, help=f"{signal.help}; fidelity {level}: {low:g} .. {high:g}{unit}")


def is_of_table(spec: ModelSpec, par: object, place: int) -> bool:
    """Tell if the parameter at a place of ``par`` is one that the table in use was made for."""
    return wants_table(spec, par) and place < int(_known(spec)["N_PARAMS"])


def fill_table(spec: ModelSpec, params: object, par: object, work: Any) -> None:
    """Put the table for ``params`` into ``work`` if the level in ``par`` reads one.

    ParameterError if there is none for these parameters, or it is too large.
    """
    if not wants_table(spec, par):
        return
    known, tables = _known(spec), tables_of(spec)
    assert tables is not None
    table = tables.find(spec.table_of or params).data
    room = work[int(known["AT"]) :]
    if len(table) > len(room):
        raise ParameterError(
            f"the table has {len(table)} numbers, allowed: {len(room)}; make it smaller"
        )
    room[: len(table)] = table


def tables_of(spec: ModelSpec, level: str | None = None) -> Tables | None:
    """Return where a model, or one level of it, looks its answers up; None if it solves."""
    tables = find_model(spec.key).tables() if spec.key in MODELS else None
    return tables if tables and level in (None, tables.level) else None


def _known(spec: ModelSpec) -> dict[str, float]:
    """Return what the kernel says about its table; empty if it has none."""
    return getattr(import_module(spec.kernel), "TABLE", None) or {}


def rising(time: ArrayLike) -> Array:
    """Return points in time [s]; at least two, rising."""
    points = profile_of("time", time, "s", -1e9, 1e9)
    if len(points) < 2 or not (np.diff(points) > 0.0).all():
        raise ParameterError("time: at least two rising points [s] are required")
    return points


def profile_of(
    name: str, values: ArrayLike, unit: str, low: float, high: float, n: int | None = None
) -> Array:
    """Return a checked array; one number stands for ``n`` equal ones."""
    unit = "" if unit == "1" else f" {unit}"
    try:
        array = np.asarray(values, float)
    except (TypeError, ValueError):
        raise ParameterError(f"{name}: numbers{unit and ' in'}{unit} are required") from None
    if n is not None and array.ndim == 0:
        array = np.full(n, float(array))
    if array.ndim != 1 or len(array) != (n or len(array) or 1):
        raise ParameterError(
            f"{name}: shape {array.shape}, allowed: one number per point"
            + ("" if n is None else f" ({n})")
        )
    bad = ~((array >= low) & (array <= high))
    if bad.any():
        ends = [into_range(low, high, value) for value in array.tolist()]
        array = np.array(ends)  # a copy: what was given stays as it is
        bad = ~((array >= low) & (array <= high))
    if bad.any():
        i = int(np.argmax(bad))
        raise ParameterError(
            f"{name}[{i}] = {float(array[i])!r}{unit}, allowed: {low:g} .. {high:g}{unit}"
        )
    return array
