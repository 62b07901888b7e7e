"""Warnings of a shift by the rules of ``warnings.toml``; the page of a scene has the same."""

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ..model.toml_tables import table_beside
from ..units import format_quantity
from .expressions import Missing, Scope, Tree, parsed

_TABLES: dict[str, dict[str, Any]] = table_beside(__file__, "warnings.toml")
KINDS = ("shift", "parts", "other")  # the most severe first
LIMITS: dict[str, float] = _TABLES.pop("limits")
TEXTS = {key: x["text"] for key, x in _TABLES.items() if isinstance(x.get("text"), str)}
FIELD = re.compile(r"{(\w+)(?::([^}]*))?}")
NUMBER = re.compile(r"(\.\d+)?[gf%]")  # a format of Python's; any other is a unit, and digits
OF_RULE = ("of", "rank", "each", "sort", "when", "text")


class Ranked(str):
    """A warning with its place among ``KINDS``, 0 the most severe; a text without one is last."""

    __slots__ = ("rank",)
    rank: int

    def __new__(cls, text: str, rank: int = 0) -> "Ranked":
        """Return the text with its rank."""
        made = super().__new__(cls, text)
        made.rank = rank
        return made


class Rule(NamedTuple):
    """When a warning is given and what it says; JSON types."""

    key: str
    of: tuple[str, ...]
    rank: int
    each: str
    sort: str
    when: Tree
    text: list[tuple[Tree, str]]
    """Pieces, each with the condition on which it is told; None: always."""
    figures: dict[str, Tree]


def rank_of(text: str) -> int:
    """Return the place of a warning among ``KINDS``."""
    return text.rank if isinstance(text, Ranked) else len(KINDS) - 1


def severest_first(warnings: Iterable[str]) -> list[str]:
    """Return warnings by severity, equal ones in their order."""
    return sorted(warnings, key=rank_of)


def text_of(key: str, **values: object) -> str:
    """Return the text of a rule that is one sentence, with values in SI units.

    >>> text_of("hot_part", part="clutch", limit=470.0)
    'clutch is hotter than 470 K'
    """
    return _filled(TEXTS[key], values)


@cache
def figures() -> dict[str, Tree]:
    """Return the figures that all rules know."""
    return {name: parsed(text) for name, text in _TABLES["figures"].items()}


@cache
def rules() -> tuple[Rule, ...]:
    """Return the rules in the order of their warnings."""
    found = []
    for key, table in _TABLES.items():
        if "when" in table:
            pieces = [table["text"]] if isinstance(table["text"], str) else table["text"]
            told = [(None, p) if isinstance(p, str) else (parsed(p[0]), p[1]) for p in pieces]
            own = {name: parsed(text) for name, text in table.items() if name not in OF_RULE}
            of, rank = tuple(table.get("of", "run").split()), KINDS.index(table["rank"])
            each, sort = table.get("each", ""), table.get("sort", "")
            found.append(Rule(key, of, rank, each, sort, parsed(table["when"]), told, own))
    return tuple(found)


def scope_of(values: Mapping[str, Any], signals: Mapping[str, Any] | None = None) -> Scope:
    """Return what expressions of rules know of a run."""
    return Scope({**LIMITS, **values}, figures(), signals=signals)


def warnings_of(of: str, run: Scope) -> Iterator[Ranked]:
    """Yield the warnings of a run by the rules of "run", "record", "scene" or "failed"."""
    with np.errstate(all="ignore"):  # what divides by nothing is not told
        for rule in rules():
            if of in rule.of:
                yield from _of_rule(rule, run)


def _of_rule(rule: Rule, run: Scope) -> list[Ranked]:
    found = []
    for row in run[rule.each] if rule.each else [{}]:
        own = Scope(row, rule.figures, run)
        try:
            if own.evaluated(rule.when):
                run.warned.add((rule.key, str(row.get("pack"))))
                text = "".join(
                    _told(piece, own) for holds, piece in rule.text if _holds(holds, own)
                )
                found.append(
                    (own[rule.sort] if rule.sort else 0, Ranked(text, row.get("rank", rule.rank)))
                )
        except Missing:
            continue
    return [line for _, line in sorted(found, key=lambda one: one[0])]


def _holds(condition: Tree, own: Scope) -> bool:
    return condition is None or bool(own.evaluated(condition))


def _told(piece: str, own: Scope) -> str:
    text = own[piece[1:]] if piece.startswith("@") else piece
    return _filled(text, own)


def _filled(text: str, values: Any) -> str:
    """Return a text with its values."""

    def filled(found: re.Match[str]) -> str:
        value, form = values[found[1]], found[2]
        if isinstance(value, tuple):
            return _quantity(*value)
        if not form:
            return str(value)
        if NUMBER.fullmatch(form):
            return format(value, form)
        unit, _, digits = form.partition(",")
        return format_quantity(float(value), unit, digits=int(digits or 4))

    return FIELD.sub(filled, text)


def _quantity(value: float, unit: str, name: str = "", relative: bool = False) -> str:
    words = format_quantity(float(value), unit, difference=relative)
    return f"{name} = {words}" if name else words
