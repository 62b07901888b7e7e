"""Texts of warnings of a shift, from ``warning_texts.toml``; the page of a scene has the same."""

import re
from collections.abc import Iterable

from ..model.toml_tables import table_beside
from ..units import format_quantity

_TABLES: dict[str, dict[str, str]] = table_beside(__file__, "warning_texts.toml")
KINDS = tuple(_TABLES)  # the most severe first
TEXTS = {key: text for table in _TABLES.values() for key, text in table.items()}
RANKS = {key: rank for rank, table in enumerate(_TABLES.values()) for key in table}
FIELD = re.compile(r"{(\w+)(?::([^}]*))?}")
NUMBER = re.compile(r"(\.\d+)?[gf%]")  # a format of Python's; any other is a unit, and digits


class Ranked(str):
    """A warning with its place among ``KINDS``, 0 the most severe; a text without one is last."""

    __slots__ = ("rank",)
    rank: int

    def __new__(cls, text: str, rank: int = 0) -> "Ranked":
        """Return the text with its rank."""
        made = super().__new__(cls, text)
        made.rank = rank
        return made

    def __add__(self, more: str) -> "Ranked":
        """Return the text with more behind it, as severe as it was."""
        return Ranked(str(self) + more, self.rank)


def rank_of(text: str) -> int:
    """Return the place of a warning among ``KINDS``."""
    return text.rank if isinstance(text, Ranked) else len(KINDS) - 1


def severest_first(warnings: Iterable[str]) -> list[str]:
    """Return warnings by severity, equal ones in their order."""
    return sorted(warnings, key=rank_of)


def warning(key: str, rank: int | None = None, /, **values: object) -> Ranked:
    """Return the text of that key with values in SI units; ``rank``: not that of its table.

    >>> warning("why_numerical", every=1.5)
    'a lock-up every 1.5 steps, which is numerical: their number follows the step'
    """

    def filled(found: re.Match[str]) -> str:
        value, form = values[found[1]], found[2]
        if not form:
            return str(value)
        if NUMBER.fullmatch(form):
            return format(value, form)
        unit, _, digits = form.partition(",")
        return format_quantity(float(value), unit, digits=int(digits or 4))  # type: ignore[arg-type]

    return Ranked(FIELD.sub(filled, TEXTS[key]), RANKS[key] if rank is None else rank)
