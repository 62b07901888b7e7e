"""Columns that count, told from those that do not, and what an unknown one probably holds."""

import re
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from ...errors import ParameterError, suggestion
from ...units import parse_quantity, unit_size
from .table import Column, Table

SHOWN = 12  # names that a message lists
TIMES = ("timestamp", "timestamps", "t", "zeit", "seconds", "x_value")  # names of loggers for it
# Name that counts -> words in names that loggers and people give to it; the first ones are surer.
WORDS = {
    "time": (*TIMES, "time"),
    "speed": ("slip", "schlupf", "n", "rpm", "speed", "drehzahl", "omega"),
    "sliding_speed": ("sliding", "gleit", "v", "velocity", "speed", "gleitgeschwindigkeit"),
    "load": ("load", "force", "f", "fn", "kraft", "anpresskraft", "axial", "last"),
    "pressure": ("pressure", "p", "druck"),
    "friction_torque": ("torque", "loss", "t", "m", "moment", "drehmoment", "reibmoment"),
    "friction": ("friction", "mu", "traction", "mue", "cof", "reibwert", "reibungszahl", "\u00b5"),
    "oil_temperature": ("oil", "oel", "\u00f6l", "lube", "sump", "temp", "temperature"),
    "temperature": ("steel", "plate", "interface", "temperature", "temp"),
    "torque": ("torque", "moment", "drehmoment"),
}
TIME = "time"
EITHER = {"speed": "sliding_speed", "load": "pressure"}  # names of which a file has one
EITHER |= {other: name for name, other in EITHER.items()}
SURE = 3  # points of a guess by name and unit


class Sorted(NamedTuple):
    """Columns of a table."""

    found: dict[str, Column]
    passed: list[str]
    """Names of those passed over."""


def known_columns(
    table: Table,
    units: Mapping[str, str],
    needed: Sequence[Sequence[str]] = (),
    *,
    strict: bool = False,
    may_lack: bool = False,
) -> Sorted:
    """Return the columns that count by their names, and the names of the others.

    Parameters
    ----------
    table : with columns named as they count
    units : SI unit of every name that counts
    needed : groups of names; of each group one is required
    strict : the columns are chosen for this: one whose name or unit is nearly one that counts, and
        nothing else is, is a mistake
    may_lack : what is needed may be missing, if no unknown column may be it

    Raises
    ------
    ParameterError : a column is there twice or has a unit of something else; one that is needed is
        missing; one is nearly a name that counts; two speeds are there and one is named. The
        message lists all unknown columns with what they probably hold
    """
    found: dict[str, Column] = {}
    unknown = []
    for column in table.columns:
        name = column.plain
        if name not in units:
            if column.name and not column.name.startswith("_") and column.name not in table.used:
                unknown.append(column)
            continue
        if name in found:
            raise ParameterError(f"{table.path}: has two columns {name}, allowed: one")
        parse_quantity(f"1 {column.unit}", units[name], f"{table.path}: unit of column {name}")
        found[name] = column
    _refuse_half_of_speed(table, units, unknown)
    free = set(units) - {*found} - {EITHER.get(name, name) for name in found}
    guesses = guessed(unknown, {name: units[name] for name in units if name in free})
    missing = [group for group in needed if not {*group} & {*found}]
    if may_lack:
        likely = {name for name, _ in guesses.values()}
        missing = [group for group in missing if likely & {*group}]
    near = {
        c.name: hint
        for c in unknown
        if (hint := _meant(c, free, units, guesses, strict=strict))
        and (not table.binary or hint == TIME)
    }
    if missing:
        told = " or ".join(missing[0])
        names = ", ".join(c.name for c in table.columns[:SHOWN])
        wanted = ", ".join(" or ".join(group) for group in needed)
        said = {n: g for n, (g, _) in guesses.items()}
        settled = [_option(f"_{n}", n) for n, g in said.items() if g == TIME]
        raise ParameterError(
            f"{table.path}: column {told} is missing; required: {wanted}; found: {names}"
            f"{_asked(unknown, said)}{f'; if it is none: {settled[0]}' if settled else ''}"
        )
    if near:
        many = len(near) > 1
        names = ", ".join(map(repr, near))
        what = f"columns {names} are" if many else f"column {names} is"
        said = {**{n: g for n, (g, _) in guesses.items()}, **near}
        first = next(iter(near.values()))
        hint = f"did you mean {first}? " if len(near) == 1 and first != TIME else ""
        raise ParameterError(
            f"{table.path}: {what} not known; {hint}begin {'their names' if many else 'its name'} "
            f"with _ to pass {'them' if many else 'it'} over{_asked(unknown, said)}"
        )
    return Sorted(found, [c.name for c in unknown])


def _meant(
    column: Column,
    free: Collection[str],
    units: Mapping[str, str],
    guesses: Mapping[str, tuple[str, int]],
    *,
    strict: bool,
) -> str:
    """Return the name that a column was certainly meant to have; "" if that is not certain."""
    if strict and column.plain in TIMES:
        return TIME
    name, points = guesses.get(column.name, ("", 0))
    if strict and points >= SURE:
        return name
    others = {n for other, (n, _) in guesses.items() if other != column.name}
    fitting = [
        n
        for n in free
        if n not in others and (not column.unit or unit_size(column.unit, units[n]) is not None)
    ]
    hint = suggestion(
        column.plain, fitting, "{}", likeness=0.6 if strict else 0.75, by_words=strict
    )
    return hint and (name or hint)


def refuse_misnamed(table: Table, units: Mapping[str, str], found: Sorted) -> None:
    """Raise ParameterError for a column passed over whose unit and name say what it holds."""
    free = set(units) - {*found.found} - {EITHER.get(name, name) for name in found.found}
    passed = [c for c in table.columns if c.name in found.passed and c.plain not in WORDS]
    guesses = guessed(passed, {name: unit for name, unit in units.items() if name in free})
    sure = {name: meant for name, (meant, points) in guesses.items() if points >= SURE}
    if sure:
        told = ", ".join(f"{name} (is it {meant}?)" for name, meant in sure.items())
        raise ParameterError(
            f"{table.path}: not known: {told}; give columns that count (slip is the difference of "
            "two speeds) these names, begin others with _"
        )


def guessed(unknown: Sequence[Column], units: Mapping[str, str]) -> dict[str, tuple[str, int]]:
    """Return for columns what they probably hold by name and unit, and the points of it.

    Each name is guessed once, for the column that fits it best.
    """
    ranked = sorted(
        (-_points(column, name, unit), i, k, column.name, name)
        for i, column in enumerate(unknown)
        for k, (name, unit) in enumerate(units.items())
        if name in WORDS and _points(column, name, unit)
    )
    found: dict[str, tuple[str, int]] = {}
    for points, *_, column, name in ranked:
        taken = {other for other, _ in found.values()}
        if column not in found and not taken & {name, EITHER.get(name, name)}:
            found[column] = name, -points
    return found


def _points(column: Column, name: str, unit: str) -> int:
    """Return how well a column fits a name: 2 for its unit, 1 or 2 for its words."""
    fits = 0
    if column.unit:
        if unit == "1" or unit_size(column.unit, unit) is None:
            return 0
        fits = 2
    own = WORDS[name]
    known = _words(column) & {*own}
    if known:
        return fits + 1 + bool(known & {*own[:2]}) + (len(known) > 1)
    return (
        fits
        if name
        in ("speed", "sliding_speed", "load", "pressure", "friction_torque", "oil_temperature")
        else 0
    )


def _asked(unknown: Sequence[Column], guesses: Mapping[str, str]) -> str:
    """Return all unknown columns with what they may be, and the options that say so."""
    likely = [c for c in unknown if c.name in guesses]
    if not likely:
        return ""
    names = [c.name for c in unknown]
    whole = {
        id(c): f"{c.group}:{c.name}" if names.count(c.name) > 1 and c.group else c.name
        for c in unknown
    }
    told = [
        f"{whole[id(c)]}{f' [{c.unit}]' if c.unit else ''}"
        + (f" (is it {guesses[c.name]}?)" if c.name in guesses else "")
        for c in [*likely, *(c for c in unknown if c.name not in guesses)]
    ]
    more = f" and {len(told) - SHOWN} more" if len(told) > SHOWN else ""
    options = {guesses[c.name]: whole[id(c)] for c in reversed(likely)}
    speeds = [c for c in unknown if _is_speed(c)]
    slip = {"slip", "schlupf"}
    if "speed" in options and len(speeds) == 2 and not slip & (_words(speeds[0], speeds[1])):
        options["speed"] = f"{whole[id(speeds[0])]} - {whole[id(speeds[1])]}"
    order = [*dict.fromkeys(guesses[c.name] for c in likely)]
    copy = " ".join(_option(name, options[name]) for name in order)
    return f"; not known: {', '.join(told[:SHOWN])}{more}; if so: {copy}"


def _is_speed(column: Column) -> bool:
    """Tell if a column has a unit of rotation, or without one a name of it."""
    if column.unit:
        return unit_size(column.unit, "rad/s") is not None
    return bool(_words(column) & {*WORDS["speed"]})


def _option(name: str, text: str) -> str:
    """Return an option to copy."""
    return f'--column "{name}={text}"'


def _refuse_half_of_speed(
    table: Table, units: Mapping[str, str], unknown: Sequence[Column]
) -> None:
    """Raise ParameterError where one of two speeds was named to be the speed."""
    named = table.given.get("speed")
    if named is None or "speed" not in units:
        return
    own = next((c for c in table.columns if c.plain == "speed"), None)
    stem = re.sub(r"\d", "", named)
    others = [c for c in unknown if _is_speed(c) and (c.unit or re.sub(r"\d", "", c.name) == stem)]
    if own is None or not others or named in [c.name for c in others] or table.used:
        return
    other = others[0].name
    raise ParameterError(
        f"{table.path}: speed={named}, but there is another speed, {other}: is slip their "
        f"difference? {_option('speed', f'{named} - {other}')}; if {named} is the slip itself, "
        f"pass the other over: {_option(f'_{other}', other)}"
    )


def time_like(columns: Collection[Column]) -> Column | None:
    """Return the column that is time by another name, None if there is none or one is time."""
    if any(column.plain == TIME for column in columns):
        return None
    for column in columns:
        words = _words(column)
        is_time = column.unit and unit_size(column.unit, "s") is not None and words & {*TIMES, TIME}
        if not column.name.startswith("_") and (column.plain in TIMES or is_time):
            return column
    return None


def time_hint(columns: Collection[Column]) -> str:
    """Return how a column that is time by another name is named; "" where there is none."""
    if column := time_like(columns):
        return f'if {column.name} is the time of a recording: --column "time={column.name}"; '
    return ""


def _words(*columns: Column) -> set[str]:
    found = {c.plain for c in columns}
    for column in columns:
        found |= {w for w in re.split(r"[^\w]|_|\d", column.name.lower()) if w}
    return found
