"""A Python function that is studied: numbers in by name, one number or several by name out."""

import hashlib
import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, SolveError
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter, read_scatter
from .target import Array, Flags

OWN = ("nominal", "unit")  # next to the law, what a part or scene knows of its parameters
FAILURES = {SolveError: "no solution", ValueError: "wrong value", ArithmeticError: "arithmetic"}


@dataclass(frozen=True, kw_only=True)
class FunctionTarget:
    """A function as a target; what raises SolveError, ValueError, ArithmeticError has failed."""

    function: Callable[..., Any]
    scatter: Scatter
    figures: tuple[Figure, ...]
    name: str
    kind: Literal["function"] = "function"
    outcomes: tuple[str, ...] = ()
    series: tuple[str, ...] = ()
    time: Array = field(default_factory=lambda: np.empty(0))
    costly: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    reasons: tuple[str, ...] = tuple(FAILURES.values())

    @property
    def identity(self) -> dict[str, str]:
        """The function by its name and code; what that calls cannot be compared."""
        code, own = getattr(self.function, "__code__", None), b""
        if code:  # not by the text of code within it, which has an address
            plain = [c for c in code.co_consts if isinstance(c, str | int | float)]
            own = code.co_code + repr(plain).encode()
        digest = hashlib.sha256(own).hexdigest()[:16]
        return {
            "function": f"{self.name} {digest}",
            "figures": ", ".join(f.name for f in self.figures),
        }

    def touches(self, source: str) -> bool:
        """Any source may matter."""
        return True

    def why(self, _row: Mapping[str, object]) -> str:
        """Return nothing: the reasons say it."""
        return ""

    def doubts(self, _base: Array) -> Iterator[str]:
        """Yield nothing: a function has no limits."""
        yield from ()

    def error(self) -> dict[str, float]:
        """Nothing is known."""
        return {}

    def nominal(self) -> Array:
        """Return the figures at the nominal values."""
        return self._figures({s.place.name: s.place.nominal for s in self.scatter.sources})

    def solve(self, rows: list[dict[str, Any]], costly: NDArray[np.bool_]) -> tuple[Array, Flags]:
        """Return the figures of each row."""
        found, codes = (
            np.full((len(rows), len(self.figures)), np.nan),
            np.zeros(len(rows), np.int32),
        )
        for i, row in enumerate(rows):
            try:
                found[i] = self._figures(row)
            except tuple(FAILURES) as problem:
                codes[i] = 1 + next(k for k, e in enumerate(FAILURES) if isinstance(problem, e))
        return found, codes

    def _figures(self, row: dict[str, Any]) -> Array:
        values = named(self.function(**row))
        return np.array([values[f.name] for f in self.figures], float)


def function_target(
    function: Callable[..., Any], table: Mapping[str, object] | None, outputs: Any = None
) -> FunctionTarget:
    """Return a function as a target.

    Parameters
    ----------
    function : takes the sources by name, returns a number or a mapping of numbers
    table : as a table ``[scatter]``; a line may have ``nominal`` and ``unit`` too. Else the
        function's default is nominal, or the middle of ``uniform`` or the first of ``either``
    outputs : names of the figures to keep; None: all
    """
    if not table:
        raise ParameterError("nothing scatters: scatter = {name: law, ...} is required")
    usual = {
        name: p.default
        for name, p in inspect.signature(function).parameters.items()
        if p.default is not p.empty
    }
    lines = {
        name: {k: v for k, v in law.items() if k not in OWN} if isinstance(law, Mapping) else law
        for name, law in table.items()
    }
    places = {
        name: _place(name, law if isinstance(law, Mapping) else {}, usual)
        for name, law in table.items()
        if name != "correlation"
    }
    scatter = read_scatter("scatter", lines, places)
    name = getattr(function, "__name__", type(function).__name__)
    given = named(function(**{s.place.name: s.place.nominal for s in scatter.sources}))
    if not given or not all(isinstance(v, int | float | np.number) for v in given.values()):
        raise ParameterError(f"{name}: returns no number and no mapping of names to numbers")
    for wanted in outputs or ():
        if wanted not in given:
            raise ParameterError(f"outputs: {wanted!r}, allowed: {', '.join(given)}")
    figures = tuple(Figure(n, "1", "") for n in (outputs or given))
    return FunctionTarget(function=function, scatter=scatter, figures=figures, name=name)


def named(value: object) -> Mapping[str, Any]:
    """Return the numbers of a function by name: a bare one is its ``value``."""
    return value if isinstance(value, Mapping) else {"value": value}


def _place(name: str, law: Mapping[str, Any], usual: Mapping[str, Any]) -> Quantity:
    options = law.get("either", ())
    uniform = law.get("uniform", ())
    middle = None
    if len(uniform) == 2 and all(isinstance(end, int | float) for end in uniform):
        middle = 0.5 * sum(uniform)
    nominal = law.get("nominal", usual.get(name, options[0] if options else middle))
    if nominal is None:
        raise ParameterError(
            f'scatter: {name}: nominal is missing, as in {{"normal": "10 %", "nominal": 1.0}}'
        )
    return Quantity(name=name, unit=law.get("unit", "1"), nominal=nominal, choices=tuple(options))
