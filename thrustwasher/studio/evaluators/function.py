"""A Python function that is evaluated: numbers in by name, one number or several by name out."""

import hashlib
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.quantity import Figure, Quantity
from ...model.scatter import CORRELATION, Scatter, read_scatter
from .evaluator import Answers, Array, Remark, Row

OWN = ("nominal", "unit")  # next to the law, what a part or scene knows of its parameters
FAILURES = {SolveError: "no solution", ValueError: "wrong value", ArithmeticError: "arithmetic"}


class FunctionEvaluator:
    """A function; what raises SolveError, ValueError, ArithmeticError has failed."""

    kind: Literal["function"] = "function"
    remarks: tuple[Remark, ...] = ()
    costly: tuple[str, ...] = ()
    time = np.empty(0)

    def __init__(self, function: Callable[..., Any], table: Mapping[str, Any]) -> None:
        """``table``: as in ``function_evaluator``; ParameterError: it returns no numbers."""
        self.function, self._table = function, table
        self.name = getattr(function, "__name__", type(function).__name__)
        usual = {
            name: p.default
            for name, p in inspect.signature(function).parameters.items()
            if p.default is not p.empty
        }
        self.quantities = {
            name: _quantity(name, law if isinstance(law, Mapping) else {}, usual)
            for name, law in table.items()
            if name != CORRELATION
        }
        self.scattered()  # what it says against the laws
        values = self._named({})
        if not values or not all(isinstance(v, int | float | np.number) for v in values.values()):
            raise ParameterError(
                f"{self.name}: returns no number and no mapping of names to numbers"
            )
        self.figures = {name: Figure(name, "1", "") for name in values}
        self.reasons = dict(enumerate(FAILURES.values(), 1))
        self.signals: dict[str, str] = {}

    @property
    def identity(self) -> dict[str, str]:
        """The function by its name and code; what that calls cannot be compared."""
        code, own = getattr(inspect.unwrap(self.function), "__code__", None), b""
        if code:  # not by the text of code within it, which has an address
            plain = [c for c in code.co_consts if isinstance(c, str | int | float)]
            own = code.co_code + repr(plain).encode()
        return {"function": f"{self.name} {hashlib.sha256(own).hexdigest()[:16]}"}

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Any = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return the figures of each row."""
        values = np.full((len(rows), len(figures)), np.nan)
        codes = np.zeros(len(rows), np.int32)
        for i, row in enumerate(rows):
            try:
                given = self._named(row)
                values[i] = [given[name] for name in figures]
            except tuple(FAILURES) as problem:
                codes[i] = 1 + next(k for k, e in enumerate(FAILURES) if isinstance(problem, e))
        return Answers(values, codes)

    def gradient(self, *_: Any) -> None:
        """Return nothing: it is not known."""

    def file(self, row: Row, *, draw: bool = False) -> str:
        """ParameterError: a function has no file."""
        raise ParameterError(f"{self.name}: a function has no file")

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how its quantities scatter."""
        lines = {
            name: {k: v for k, v in law.items() if k not in OWN}
            if isinstance(law, Mapping)
            else law
            for name, law in (self._table if table is None else table).items()
        }
        return read_scatter("scatter", lines, self.quantities)

    def under(self, _scatter: Scatter, _figures: Sequence[str]) -> "FunctionEvaluator":
        """Return the same."""
        return self

    def nominal(self, figures: Sequence[str], _signals: Sequence[str]) -> Answers:
        """Return the figures at the nominal values; whatever it raises."""
        values = self._named({})
        return Answers(np.array([[values[n] for n in figures]], float), np.zeros(1, np.int32))

    def touches(self, _source: str) -> bool:
        """Any quantity may matter."""
        return True

    def why(self, _row: Row) -> str:
        """Return nothing: the reasons say it."""
        return ""

    def doubts(self, _figures: Sequence[str], _base: Array) -> tuple[str, ...]:
        """Return nothing: a function has no limits."""
        return ()

    def error(self) -> dict[str, float]:
        """Nothing is known."""
        return {}

    def _named(self, row: Row) -> Mapping[str, Any]:
        """Return the numbers of a row by name: a bare one is its ``value``."""
        value = self.function(**{**{n: q.nominal for n, q in self.quantities.items()}, **row})
        return value if isinstance(value, Mapping) else {"value": value}


def function_evaluator(
    function: Callable[..., Any], table: Mapping[str, Any] | None
) -> FunctionEvaluator:
    """Return a function as what is evaluated.

    Parameters
    ----------
    function : takes its quantities by name, returns a number or a mapping of numbers
    table : as a table ``[scatter]``; a line may have ``nominal`` and ``unit`` too. Else the
        function's default is nominal, or the middle of ``uniform`` or the first of ``either``
    """
    if not table:
        raise ParameterError("nothing scatters: scatter = {name: law, ...} is required")
    return FunctionEvaluator(function, table)


def _quantity(name: str, law: Mapping[str, Any], usual: Mapping[str, Any]) -> Quantity:
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
