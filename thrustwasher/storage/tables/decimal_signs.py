"""Decimal points or commas, and groups of thousands: found for a whole file, or it is refused."""

import re
from collections.abc import Sequence
from pathlib import Path

from ...errors import ParameterError

# spaces and apostrophes that group the digits of large numbers
_SPACES = dict.fromkeys(map(ord, " \u00a0\u2007\u2009\u202f'\u2019"), None)
_WITH_COMMA = re.compile(r"[+-]?(\d{1,3}(\.\d{3})+|\d*),\d+([eE][+-]?\d+)?")
_WITH_POINT = re.compile(r"[+-]?\d*\.\d+([eE][+-]?\d+)?")
_GROUPS_AND_POINT = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+\.\d*")
_GROUPS = re.compile(r"[+-]?[1-9]\d{0,2}([ \u00a0\u2007\u2009\u202f'\u2019]\d{3})+([.,]\d*)?")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+")


def signs(
    path: Path, rows: Sequence[tuple[int, list[str]]], names: Sequence[str]
) -> tuple[bool, bool]:
    """Tell if the decimal sign is a comma, and if groups of thousands are parted.

    A file has one decimal sign: "1,200" has a group next to "0.5", "1.200" one next to "0,5". A
    file that can be read in two ways is refused.
    """
    first: dict[str, tuple[int, str, str]] = {}
    for number, cells in rows:
        for name, cell in zip(names, cells, strict=False):
            if not name.startswith("_") and not cell.isdigit():
                for kind in _kinds(cell):
                    first.setdefault(kind, (number, name, cell))
    comma = first.get("comma") or first.get("comma or group")
    point = first.get("point") or first.get("point or group")
    is_told = ("comma" in first) != ("point" in first)
    if comma and point and not is_told:
        raise ParameterError(
            f"{path}: line {comma[0]} has {comma[1]} = {comma[2]!r} and line {point[0]} "
            f"{point[1]} = {point[2]!r}, one decimal sign is required"
        )
    if comma and not is_told:
        raise ParameterError(
            f"{path}, line {comma[0]}: {comma[1]} = {comma[2]!r} may have a decimal comma or "
            "groups of thousands; write the numbers with a decimal point, or with digits enough "
            "to tell"
        )
    commas = "comma" in first
    return commas, "group" in first or ("point or group" if commas else "comma or group") in first


def _kinds(cell: str) -> tuple[str, ...]:
    """Return what a number's signs may be: decimal "comma" or "point", and "group"."""
    plain = _plain(cell)
    parted = ("group",) if plain != cell else ()
    if _GROUPS_AND_POINT.fullmatch(plain):
        return "point", "group"
    if _WITH_COMMA.fullmatch(plain):
        return (*parted, "comma or group" if _THOUSANDS.fullmatch(plain) else "comma")
    if _WITH_POINT.fullmatch(plain):
        is_group = _THOUSANDS.fullmatch(plain.replace(".", ","))
        return (*parted, "point or group" if is_group else "point")
    if _THOUSANDS.fullmatch(plain.replace(".", ",")):  # more than one point
        return "point or group", "group"
    return parted


def _plain(cell: str) -> str:
    """Return a cell without the spaces or apostrophes that part its thousands."""
    if cell.isascii() and " " not in cell and "'" not in cell:
        return cell
    return cell.translate(_SPACES) if _GROUPS.fullmatch(cell) else cell


def ungrouped(cell: str) -> str:
    """Return a cell with a decimal point without what parts its thousands."""
    plain = _plain(cell)
    if _GROUPS_AND_POINT.fullmatch(plain) or _THOUSANDS.fullmatch(plain):
        return plain.replace(",", "")
    return plain


def pointed(cell: str) -> str:
    """Return a cell with a decimal point for its comma."""
    plain = _plain(cell)
    if _WITH_COMMA.fullmatch(plain) or _THOUSANDS.fullmatch(plain.replace(".", ",")):
        return plain.replace(".", "").replace(",", ".")
    return plain
