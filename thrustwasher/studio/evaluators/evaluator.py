"""The form in which everything is studied: quantities by path in, figures by name out."""

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, Protocol, overload

import numpy as np
from numpy.typing import NDArray

from ...errors import Suggesting
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter

Array = NDArray[np.float64]
Codes = NDArray[np.int32]
Row = Mapping[str, Any]  # values [SI] by path; what is not there is as it is now
Effort = Literal["least", "search", "shown"]
"""How much a row may take: ``least`` leaves costly figures out (NaN), ``search`` does what the
figures ask for, ``shown`` solves on the finest means."""
Kind = Literal["part", "engagement", "scene", "gearbox", "function"]


class Remark(NamedTuple):
    """Something to be known of a result."""

    level: Literal["warning", "note"]
    text: str
    source: str = ""
    """Of what it is said: a file, a part, a signal."""


@dataclass(frozen=True, kw_only=True)
class Rows(Sequence[Row]):
    """Rows as columns, in lines: within a line a row may be solved from the one before it."""

    columns: Mapping[str, NDArray[Any]]
    """(n,) values [SI] by path."""
    starts: NDArray[np.int64]
    """(lines + 1,) first row of each line, and the end."""
    held: Mapping[str, Any] = field(default_factory=dict)
    """Values of all rows."""

    def __len__(self) -> int:
        return int(self.starts[-1])

    @overload
    def __getitem__(self, i: int) -> Row: ...
    @overload
    def __getitem__(self, i: slice) -> Sequence[Row]: ...
    def __getitem__(self, i: int | slice) -> Row | Sequence[Row]:
        """Return a row, or several."""
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        return {**self.held, **{name: _plain(column[i]) for name, column in self.columns.items()}}

    def __iter__(self) -> Iterator[Row]:
        return (self[i] for i in range(len(self)))

    def lines(self, first: int, end: int) -> "Rows":
        """Return the lines ``first .. end - 1``."""
        starts = self.starts[first : end + 1]
        own = {name: column[starts[0] : starts[-1]] for name, column in self.columns.items()}
        return Rows(columns=own, starts=starts - starts[0], held=self.held)


class Answers(NamedTuple):
    """What rows give."""

    values: Array
    """(n, m) figures [SI]; NaN where a row failed, or has no such figure."""
    codes: Codes
    """(n,) 0 where a row is sound, else a key of ``Evaluator.reasons`` or an advice."""
    series: Array | None = None
    """(n, signals, n_t) over ``Evaluator.time``, if signals were requested."""


class Slopes(NamedTuple):
    """Figures of a row (m,) and their derivatives (m, k) over quantities."""

    values: Array
    slopes: Array


class Evaluator(Protocol):
    """What is studied; it can be pickled, for the workers."""

    @property
    def kind(self) -> Kind:
        """What it is."""

    @property
    def name(self) -> str:
        """Name of the part, scene or function."""

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """What can be set, by path."""

    @property
    def figures(self) -> Mapping[str, Figure]:
        """What rows give, by name; one of kind "boolean" is 1 or 0."""

    @property
    def identity(self) -> Mapping[str, str]:
        """What makes it another one, in words by kind; for journals."""

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """What is to be known of it."""

    @property
    def reasons(self) -> Mapping[int, str]:
        """Why a row failed, by its code."""

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Effort | Sequence[Effort] = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return figures of rows, in the order of both; ``effort``: of all rows or of each.

        ``signals`` over time are there for a scene.

        The answers depend on the arguments alone, on all rows of them: neighbours may start one
        another. They do not depend on earlier calls.
        """

    def gradient(
        self, row: Row, figures: Sequence[str], quantities: Sequence[str], effort: Effort = "search"
    ) -> Slopes | None:
        """Return figures and their derivatives; NaN where there is no solution; None: not known."""

    def file(self, row: Row, *, draw: bool = False) -> str:
        """Return a row as the text of a TOML file that runs.

        ``draw``: as a draw of its scatter, which scatters no more.
        """

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how it scatters, at its values or at those of a row.

        ``table``: instead of its own ``[scatter]``. ParameterError if something is not allowed.
        """


class Scattering(Evaluator, Protocol):
    """What a study of scatter needs in addition."""

    @property
    def signals(self) -> Mapping[str, str]:
        """Units of the signals over time that it has, by name."""

    @property
    def time(self) -> Array:
        """(n_t,) [s] of the signals, common to all rows."""

    @property
    def costly(self) -> tuple[str, ...]:
        """Figures that ``least`` leaves out."""

    def under(self, scatter: Scatter, figures: Sequence[str]) -> "Scattering":
        """Return it as it is evaluated where this scatters and these figures count."""

    def nominal(self, figures: Sequence[str], signals: Sequence[str]) -> Answers:
        """Return the row with all values as they are."""

    def touches(self, source: str) -> bool:
        """Tell if any figure but the costly ones depends on a quantity."""

    def why(self, row: Row) -> str:
        """Return in words why a row failed; "" if only its run can tell."""

    def doubts(self, figures: Sequence[str], base: Array) -> Sequence[str]:
        """Return what single runs would warn of, with the figures of base rows (N, m)."""

    def error(self) -> Mapping[str, float]:
        """Return the numerical error of figures for which it is known, relative."""


def efforts(effort: Effort | Sequence[Effort], n: int) -> list[Effort]:
    """Return the effort of each of ``n`` rows."""
    return [effort] * n if isinstance(effort, str) else list(effort)


def some_figures(evaluator: Evaluator, names: Iterable[str]) -> Suggesting[Figure]:
    """Return figures by name; suggested are those that the evaluator suggests of its own."""
    every = evaluator.figures
    found = Suggesting({name: every[name] for name in names})
    found.suggested = getattr(every, "suggested", every)
    found.absent = getattr(every, "absent", ())
    return found


def digest_of(values: Mapping[str, Any]) -> str:
    """Return a digest of values by name, for journals."""
    return hashlib.sha256(repr(sorted(values.items())).encode()).hexdigest()[:16]


def texts(remarks: Sequence[Remark], level: str) -> tuple[str, ...]:
    """Return the remarks of a level in words."""
    return tuple(r.text for r in remarks if r.level == level)


def _plain(value: Any) -> Any:
    """Return a Python number, word or truth."""
    return value.item() if isinstance(value, np.generic) else value
