"""Where the tables of a file stand: heads of names with rows of numbers under them.

A head is a row whose cells are names and which is followed by rows of numbers; a row of units and
one of identifiers may stand between. What stands above, between and below tables is passed over.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ...errors import ParameterError
from .table import UNMEASURED, is_unit, plain_unit

Cells = Callable[[int, int], list[str]]
"""Gives the cells of a row, parted as the row of a head is."""
MISSING = (*UNMEASURED, "inf", "-inf")
SHORT = 8  # characters of a unit that is not known here
SHOWN = 60  # characters of a line that a message quotes
_NUMBER = re.compile(
    r"[+-]?(\d[\d.,'\u2019 \u00a0\u2007\u2009\u202f]*|[.,]\d+)([eE][+-]?\d+)?\s*%?"
)
_LETTER = re.compile(r"[^\W\d_]")


@dataclass(frozen=True)
class Place:
    """Where a table stands, as places of rows from 0."""

    head: int
    units: int  # -1: none
    first: int
    end: int  # behind the last row of numbers


@dataclass(frozen=True)
class Wanted:
    """What was said of a file's layout."""

    skip: int | None = None
    """Lines above the head."""
    table: tuple[int, ...] = ()
    """Numbers of the tables that are read, from 1; (): all, if their heads are equal."""
    sheet: str = ""
    """Sheet of a workbook, or struct of a MATLAB file."""


USUAL = Wanted()


def is_number(cell: str) -> bool:
    """Tell if a cell is a number as some country writes it.

    >>> [is_number(x) for x in ("1.234,5", "-.5e3", "01/02/2024", "CH1", "")]
    [True, True, False, False, False]
    """
    return _NUMBER.fullmatch(cell) is not None


def places(lines: Sequence[int], cells: Cells, wanted: Wanted = USUAL) -> list[Place]:
    """Return where tables stand; [] if no row is a head.

    Parameters
    ----------
    lines : number of each row in the file, rising
    cells : gives the cells of a row
    wanted : ``skip``: the first row behind so many lines is a head, whatever its cells are
    """
    rows = _Rows(len(lines), cells)
    if wanted.skip is not None:
        start = next((i for i, line in enumerate(lines) if line > wanted.skip), len(lines))
        return rows.from_head(start) if start < len(lines) else []
    for strict in (True, False):
        if found := rows.tables(0, strict):
            longer = [cells(p.head, p.head) for p in found if p.end - p.first > 1]
            return [p for p in found if not longer or cells(p.head, p.head) in longer]
    return []


@dataclass(frozen=True)
class _Rows:
    """Rows of a file whose heads are looked for."""

    n: int
    cells: Cells

    def tables(self, start: int, strict: bool) -> list[Place]:
        """Return the tables from a row on; ``strict``: rows begin with a number or a time."""
        found = [
            head
            for i in range(start, self.n - 1)
            if (head := self._head_above(i, start, strict)) is not None
        ]
        return self._ended(found)

    def from_head(self, start: int) -> list[Place]:
        """Return the table with a given head, and those below it."""
        first, units = start + 1, -1
        while first < min(start + 3, self.n) and self._is_text(first):
            row = self.cells(first, start)
            if _are_units(row, loose=True) or _are_alike(row, self.cells(start, start)):
                units = first
            first += 1
        return self._ended(
            [(start, units, first)] + [(p.head, p.units, p.first) for p in self.tables(first, True)]
        )

    def _ended(self, heads: list[tuple[int, int, int]]) -> list[Place]:
        """Return tables with their ends: text before the next head, or below all, is no row."""
        if not heads:
            return []
        ends = [*(head for head, _, _ in heads[1:]), self.n]
        found = []
        for (head, units, first), end in zip(heads, ends, strict=True):
            while end > first + 1 and self._is_aside(end - 1, head, first):
                end -= 1
            found.append(Place(head, units, first, end))
        return found

    def _is_aside(self, i: int, head: int, first: int) -> bool:
        """Tell if a row is text next to a table whose first row is ``first``."""
        row, begin = self.cells(i, head), self.cells(first, head)
        if not any(map(is_number, row)):
            return any(cell.lower() not in MISSING for cell in row)
        if not begin or not is_number(begin[0]) or is_number(row[0]):
            return False
        return row[0].lower() not in MISSING

    def _is_text(self, i: int) -> bool:
        """Tell if a row has names, units or identifiers and no number or date."""
        row = self.cells(i, i)
        if not row or is_number(row[0]):
            return False
        if any(cell[:1].isdigit() and not _LETTER.search(cell) for cell in row):
            return False
        words = [cell for cell in row if cell.lower() not in MISSING]
        return any(map(_LETTER.search, words)) and not any(map(is_number, words))

    def _follow(self, head: int, i: int, strict: bool) -> bool:
        """Tell if a row is one of numbers under a head."""
        row, width = self.cells(i, head), len(self.cells(head, head))
        full = [cell for cell in row if cell.lower() not in MISSING]
        count = sum(map(is_number, full))
        if not count or 2 * count < len(full) or len(row) > width:
            return False
        begins = row[0] != full[0] or is_number(full[0]) or not _LETTER.search(full[0])
        return begins or not strict

    def _head_above(self, i: int, start: int, strict: bool) -> tuple[int, int, int] | None:
        """Return (head, units, first row of numbers) if row ``i`` is the last above numbers."""
        if not self._is_text(i) or self._is_text(i + 1):
            return None
        last, width = i, len(self.cells(i, i))
        if width == 1 and i > start and self._is_text(i - 1):
            if len(self.cells(i - 1, i - 1)) > 1 < len(self.cells(i + 1, i - 1)):
                i, width = i - 1, len(self.cells(i - 1, i - 1))  # "[Data]" under a head

        def above(k: int) -> bool:
            """Tell if a row could name what stands here."""
            return k >= start and self._is_text(k) and len(self.cells(k, k)) >= max(width, 1)

        head, units = i, -1
        if i > start and _are_alike(self.cells(i, i - 1), self.cells(i - 1, i - 1)):
            head, units = i - 1, i
        elif above(i - 1) and _are_units(self.cells(i, i - 1), loose=True):
            head, units = i - 1, i
            if above(i - 2) and _are_ids(self.cells(i - 1, i - 1)):
                head = i - 2
        elif above(i - 1) and _are_units(self.cells(i - 1, i - 1)) and above(i - 2):
            head, units = i - 2, i - 1
        elif above(i - 1) and _are_ids(self.cells(i, i)) and not _are_ids(self.cells(i - 1, i - 1)):
            head = i - 1
        return (head, units, last + 1) if self._follow(head, last + 1, strict) else None


def _are_units(row: Sequence[str], loose: bool = False) -> bool:
    """Tell if a row has units alone; a pure number's may be left out.

    ``loose``: half of them are known, the others as short as units are.
    """
    named = [cell for cell in row if plain_unit(cell)]
    if not named or "1" in named:
        return False
    if len(named) > 1 and all(cell[0] + cell[-1] in ("[]", "()") for cell in named):
        return True
    known = [cell for cell in row if is_unit(cell)]
    if not loose or len(known) == len(row):
        return len(known) == len(row)
    short = all(len(cell) <= SHORT and " " not in cell for cell in row)
    return short and 2 * sum(map(is_unit, named)) >= len(named)


def _are_alike(row: Sequence[str], names: Sequence[str]) -> bool:
    """Tell if short words, some of them equal, stand under names that differ: "s, Volt, Volt"."""
    if len(row) != len(names) or not all(row) or not all(names) or is_number(names[0]):
        return False
    short = all(len(cell) <= SHORT and " " not in cell for cell in row)
    return short and len({*row}) < len(row) and len({*names}) == len(names)


def _are_ids(row: Sequence[str]) -> bool:
    """Tell if a row has identifiers alone, such as CH1, CH2, AI0."""
    named = [cell for cell in row if cell]
    if len(named) < 2 or not all(re.fullmatch(r"[A-Za-z#_./: ]*\d+", cell) for cell in named):
        return False
    return len({re.sub(r"\d+$", "", cell) for cell in named}) <= max(1, len(named) // 2)


def chosen(
    path: str,
    found: Sequence[Place],
    heads: Sequence[Sequence[str]],
    lines: Sequence[int],
    wanted: Wanted,
) -> list[int]:
    """Return the places in ``found`` of the tables that are read.

    ParameterError if their heads differ and none is named, or if there is no such table.
    """
    every = range(len(found))
    if wanted.table:
        if wrong := [n for n in wanted.table if not 1 <= n <= len(found)]:
            raise ParameterError(f"{path}: --table {wrong[0]}: allowed: 1 .. {len(found)}")
        picked = sorted({n - 1 for n in wanted.table})
    else:
        picked = list(every)
    if all(heads[k] == heads[picked[0]] for k in picked):
        return picked
    kinds: dict[tuple[str, ...], list[int]] = {}
    for k in every:
        kinds.setdefault(tuple(heads[k]), []).append(k)
    told = "; ".join(
        f"--table {','.join(str(k + 1) for k in own)} (line "
        f"{', '.join(str(lines[found[k].head]) for k in own)}): {_quoted(', '.join(names))}, "
        f"{sum(found[k].end - found[k].first for k in own)} rows"
        for names, own in kinds.items()
    )
    raise ParameterError(f"{path}: has tables with different heads, name those to read: {told}")


def passed_over(
    found: Sequence[Place], picked: Sequence[int], lines: Sequence[int], text: Callable[[int], str]
) -> Iterator[str]:
    """Yield remarks: which line the head is, what stands above, between and below."""
    first = found[picked[0]]
    if first.head:
        count = "1 line" if first.head == 1 else f"{first.head} lines"
        above = f"{count} above passed over ({_quoted(text(0))})"
        yield f"the head of line {lines[first.head]}, {above}"
    if len(picked) > 1:
        yield (
            f"{len(picked)} tables of one head (lines "
            f"{', '.join(str(lines[found[k].head]) for k in picked[:8])}"
            f"{', ..' if len(picked) > 8 else ''})"
        )
    if len(picked) < len(found):
        others = [lines[p.head] for k, p in enumerate(found) if k not in picked]
        yield f"the tables of line {', '.join(map(str, others[:8]))} passed over"
    for place, after in pairwise([*found, Place(len(lines), -1, len(lines), len(lines))]):
        if place.end < after.head and (after.head == len(lines) or place is found[picked[-1]]):
            yield f"text from line {lines[place.end]} on passed over ({_quoted(text(place.end))})"


def _quoted(text: str) -> str:
    """Return the beginning of a text."""
    text = " ".join(text.split())
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 3]}..."
