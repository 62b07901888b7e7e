"""How results show themselves: as plain data, as a table in a notebook, as a picture, in pandas.

Results lie below what draws them, which ``plugins`` names.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeVar, overload

from .errors import EnvironmentProblem
from .plugins import called
from .units import format_quantity, format_time

if TYPE_CHECKING:  # results are shown without matplotlib too
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

Canvas = TypeVar("Canvas", bound="Figure | SubFigure")
HOUR = 3600.0  # s
LONGEST_TEXT = 1200  # characters of a table's short text, before its last line
MOST_WORDS = 5  # different texts of a column that are listed


class Words(NamedTuple):
    """Unit and meaning of a figure; ``relative``: a difference of temperatures."""

    unit: str = "1"
    help: str = ""
    relative: bool = False


class Line(NamedTuple):
    """A line of a table: figure, value with a readable unit, meaning."""

    name: str
    value: str
    words: str = ""


class Card(NamedTuple):
    """A result as a person reads it; notes and warnings stand below the lines."""

    title: str
    lines: Iterable[Line]
    notes: Sequence[str] = ()
    warnings: Sequence[str] = ()


class Shown:
    """Base of results."""

    __slots__ = ()

    def to_dict(self) -> dict[str, Any]:
        """Return fields and properties as JSON can hold them: SI units, None for NaN."""
        return plain_dict({name: getattr(self, name) for name in public_names(self)})

    def as_dict(self) -> dict[str, Any]:
        """Return ``to_dict()``, under the name it had first."""
        return self.to_dict()

    @overload
    def plot(self, ax: None = None, *, fig: None = None, **options: Any) -> "Figure": ...
    @overload
    def plot(self, ax: "Axes", *, fig: None = None, **options: Any) -> "Axes": ...
    @overload
    def plot(self, ax: None = None, *, fig: Canvas, **options: Any) -> Canvas: ...
    def plot(self, ax: Any = None, *, fig: Any = None, **options: Any) -> Any:
        """Draw the result in a new ``matplotlib.figure.Figure``, or where it is asked to.

        Returns ``ax`` or ``fig`` if given, else the new figure, which a notebook shows.
        ``matplotlib``'s settings and windows are left alone.

        Parameters
        ----------
        ax : axes to draw on, of a picture of one panel
        fig : an empty figure or subfigure to draw in, in its size
        options : of this picture: ``outputs``, a name or several (sweep, scatter, load curve);
            ``panels``, titles (shift); ``residuals = False`` (calibration); of a sweep also looks
            of lines, such as ``color`` and ``label``

        Raises
        ------
        ParameterError : there is nothing to draw, the picture has several panels for one ``ax``,
            or an option is unknown; the message says what is allowed
        """
        return called("figure_of")(self, ax, fig, **options)

    def _card(self) -> Card:
        """Return the result as a person reads it."""
        raise NotImplementedError(type(self).__name__)

    def _repr_html_(self) -> str:
        """Return a small table, for notebooks: text is escaped, nothing runs."""
        return _page(self._card())


class Tabled(Shown):
    """Base of results with columns."""

    __slots__ = ()
    _index: ClassVar[str] = ""  # the column that a DataFrame has as its index

    def _columns(self) -> Mapping[str, Any]:
        """Return the columns by name."""
        raise NotImplementedError(type(self).__name__)

    def _words(self) -> Mapping[str, Words]:
        """Return unit and meaning of columns, as far as they have any."""
        return {}

    def _axes(self) -> Sequence[str]:
        """Return the names of the columns that were varied, in the order asked."""
        return ()

    def __init_subclass__(cls, **more: Any) -> None:
        """Keep the short text of a table: that of a dataclass would be all of its arrays."""
        super().__init_subclass__(**more)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = Tabled.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        """Return size, columns with their ranges, and what failed, in under 1500 characters."""
        columns, words = self._columns(), self._words()
        n = len(next(iter(columns.values()), ()))
        found = [f"{type(self).__name__}: {n} rows, {len(columns)} columns"]
        if failed := getattr(self, "failures", None):
            found.append(f"  failed: {', '.join(f'{k} {name}' for name, k in failed.items())}")
        return short_text(found, column_lines(columns, words), "columns")

    def to_xarray(self) -> Any:
        """Return the columns as an ``xarray.Dataset``, on the grid of what was varied.

        Where that is no grid they are over ``row``. Units [SI] and meanings are attributes; the
        status is a number with its meanings.

        Raises
        ------
        EnvironmentProblem : there is no xarray; the message says how to get it
        """
        from .datasets import dataset_of  # takes numpy, which help does without

        columns, words = self._columns(), self._words()
        attributes = {
            name: (words[name].unit, words[name].help) for name in columns if name in words
        }
        return dataset_of(columns, attributes, self._axes(), type(self).__name__)

    def to_pandas(self) -> Any:
        """Return the columns as a ``pandas.DataFrame``; units [SI] are in ``attrs["units"]``.

        Of results over time ``time`` is its index.

        Raises
        ------
        EnvironmentProblem : there is no pandas; the message says how to get it
        """
        columns, words = self._columns(), self._words()
        pandas, own = pandas_for(self), dict(columns)
        index = pandas.Index(own.pop(self._index), name=self._index) if self._index else None
        frame = pandas.DataFrame(own, index=index, copy=True)  # one block of each type
        frame.attrs["units"] = {name: words[name].unit for name in columns if name in words}
        return frame


def short_text(head: Sequence[str], lines: Iterable[Line], kind: str) -> str:
    """Return a head and names with their values, as many as fit, and how many ``kind`` do not."""
    found = list(head)
    texts = [f"  {line.name}  {line.value}" for line in lines]
    for i, text in enumerate(texts):
        if sum(map(len, found)) + len(text) > LONGEST_TEXT:
            return "\n".join([*found, f"  and {len(texts) - i} more {kind}"])
        found.append(text)
    return "\n".join(found)


def pandas_for(result: object) -> Any:
    """Return pandas; EnvironmentProblem: there is none, with how to get it."""
    try:
        import pandas
    except ImportError:
        raise EnvironmentProblem(
            f"{type(result).__name__}.to_pandas needs the package pandas: pip install pandas"
        ) from None
    return pandas


def public_names(result: Any) -> list[str]:
    """Return the names of a result's fields and properties, but those that begin with _."""
    names = [f.name for f in fields(result)]
    for base in type(result).__mro__:
        names += [n for n, what in vars(base).items() if isinstance(what, property)]
    return [name for name in dict.fromkeys(names) if not name.startswith("_")]


def plain(value: object) -> Any:
    """Return what JSON can hold: names for enumerations, lists for arrays, None for NaN."""
    if isinstance(value, Enum):
        return value.name
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, int):
        return int(value)
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | set | frozenset):
        return [plain(item) for item in value]
    if isinstance(value, tuple):
        return tuple(plain(item) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        return plain_dict({name: getattr(value, name) for name in public_names(value)})
    return plain(value.tolist()) if hasattr(value, "tolist") else str(value)


def plain_dict(found: Mapping[str, object]) -> dict[str, Any]:
    """Return a mapping as JSON can hold it."""
    return {name: plain(value) for name, value in found.items()}


def text_of(value: object, unit: str, difference: bool = False, digits: int = 5) -> str:
    """Return a value as a person reads it; times below an hour are in seconds."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float) and unit == "s" and abs(value) < HOUR:
        return format_time(float(value), digits)
    if isinstance(value, int | float):
        return format_quantity(float(value), unit, difference=difference, digits=digits)
    return value.name if isinstance(value, Enum) else str(value)


def column_lines(columns: Mapping[str, Any], words: Mapping[str, Words]) -> Iterable[Line]:
    """Yield a line for each column: the range of its values, or which there are."""
    for name, column in columns.items():
        unit, help_, relative = words.get(name, Words())
        yield Line(name, _range_of(plain(list(column)), unit, relative), help_)


def _range_of(values: list[Any], unit: str, relative: bool) -> str:
    if values and isinstance(values[0], bool):
        return f"yes at {sum(values)} of {len(values)}"
    if any(isinstance(value, str) for value in values):
        found = list(dict.fromkeys(filter(None, values)))
        more = ", ..." if len(found) > MOST_WORDS else ""
        return ", ".join(map(str, found[:MOST_WORDS])) + more
    known = [value for value in values if value is not None]
    ends = (min(known), max(known)) if known else ()
    return " .. ".join(dict.fromkeys(text_of(x, unit, relative, 4) for x in ends)) or "none"


def _page(card: Card) -> str:
    from html import escape  # late: few look at a result in a notebook

    left = ' style="text-align: left"'
    rows = (
        f"<tr>{''.join(f'<td{left}>{escape(cell)}</td>' for cell in line)}</tr>"
        for line in card.lines
    )
    heads = "".join(f"<th{left}>{head}</th>" for head in ("figure", "value", "meaning"))
    below = [escape(note) for note in card.notes]
    below += [f"<strong>Warning:</strong> {escape(text)}" for text in card.warnings]
    return (
        f"<table><caption{left}>{escape(card.title)}</caption><thead><tr>{heads}</tr></thead>"
        f"<tbody>{''.join(rows)}</tbody></table>" + "".join(f"<p>{text}</p>" for text in below)
    )
