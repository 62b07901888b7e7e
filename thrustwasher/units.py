"""Quantities as people write them: "24 degC", "3000 rpm", "1 MPa"; inside, SI only.

For the command line and scene files. A bare number is in SI units already.
"""

import math
import re
import tomllib
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

from .errors import ParameterError

_TABLES = tomllib.loads(Path(__file__).with_name("units.toml").read_text("utf-8"))
# SI unit -> unit as written -> (factor, offset): SI value = factor * number + offset.
# The offset is left out for a difference of temperatures.
UNITS: dict[str, dict[str, tuple[float, float]]] = {
    unit: {unit: (1.0, 0.0)}
    | {name: (size, 0.0) if isinstance(size, float) else tuple(size) for name, size in own.items()}
    for unit, own in _TABLES["measures"].items()
}
# Names that occur in unit strings, as exponents of the base units (kg is one of them).
_BASE: dict[str, dict[str, int]] = _TABLES["base"]
# The unit a person reads, tried in this order: the first whose number is at least 1.
_DISPLAY: dict[str, list[str]] = _TABLES["display"]
# In which unit a bare number was probably meant, the likeliest first.
_MEANT: dict[str, list[str]] = _TABLES["meant"]
# More units that a number may be exact in.
_EXACT = {
    "m": ("nm", "mm"),
    "K": ("degC",),
    "1/m2": ("1/mm2",),
    "m2/s": ("mm2/s",),
}
LEAST_PERCENT = 2.0  # 1.5 is rather a share that is too large than 1.5 %
ULPS = 8  # units in the last place, of the end of a range that is larger: by these a value may ...
SHARE = 1e-9  # ... leave the range, and at most by this share of it
_PRETTY = {"um": "µm", "us": "µs", "degC": "°C"}
_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)


def parse_quantity(value: str | float, unit: str, name: str, *, difference: bool = False) -> float:
    """Return ``value`` as a finite number in the SI unit ``unit``, or say which are allowed.

    Parameters
    ----------
    value : "24 degC", "3000 rpm", "0.1 deg"; a bare number, or a text without unit, is SI
    unit : SI unit of the argument, e.g. "rad/s"; that in ``value`` must measure the same thing
    name : of the argument, for the message
    difference : True for a difference of temperatures: 10 degC is then 10 K

    Examples
    --------
    >>> parse_quantity("24 degC", "K", "oil_temperature")
    297.15
    >>> parse_quantity("1.2 kN", "N", "load")
    1200.0
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ParameterError(f"{name} = {value!r}, allowed: {_wanted(unit)}")
    if not isinstance(value, str):
        digits, written = repr(_as_float(value)), ""
    else:
        match = _NUMBER.fullmatch(value)
        if match is None or re.match(r",\d", match[2]):
            comma = "; the decimal sign is a point" if match else ""
            raise ParameterError(f"{name} = {value!r}, allowed: {_wanted(unit)}{comma}")
        digits, written = match[1], _plain(match[2])
    size = unit_size(written, unit)
    if size is None:
        raise ParameterError(f"{name} = {value!r}, allowed: {_wanted(unit)}")
    factor, offset = size
    si = _scaled(digits, factor, 0.0 if difference else offset)
    if not math.isfinite(si):
        raise ParameterError(f"{name} = {value!r}, allowed: {_wanted(unit)}")
    return si


@lru_cache(maxsize=4096)
def unit_size(written: str, unit: str) -> tuple[float, float] | None:
    """Return (factor, offset) of a unit as written, SI value = factor * number + offset.

    None if it does not measure what the SI unit ``unit`` does; "" is that unit.

    >>> unit_size("°C", "K"), unit_size("kN", "K")
    ((1.0, 273.15), None)
    """
    written = _plain(written)
    if written in ("", _plain(unit)):
        return 1.0, 0.0
    known = {_plain(text): pair for text, pair in UNITS.get(unit, {}).items()}
    return known.get(written)


def has_unit(value: object) -> bool:
    """Tell if a quantity is written with a unit: there is no question then which was meant.

    >>> has_unit("30000 rpm"), has_unit("30000")
    (True, False)
    """
    match = _NUMBER.fullmatch(value) if isinstance(value, str) else None
    return bool(match and match[2].strip())


def into_range(low: float, high: float, value: float) -> float:
    """Return a number; the end of the range in place of one that only rounding put outside.

    -40 degC typed in a unit of your own may come as 233.14999999999998 K. Other numbers, and
    those that are not finite, come back as they are. C code of FMUs does the same.

    Examples
    --------
    >>> into_range(233.15, 473.15, 233.14999999999998), into_range(233.15, 473.15, 233.149)
    (233.15, 233.149)
    """
    if low <= value <= high or not math.isfinite(value):
        return value
    end = low if value < low else high
    known = math.isfinite(high - low)
    scale = max(abs(low), abs(high)) if known else abs(end)
    room = ULPS * math.ulp(1.0) * scale
    return end if abs(value - end) <= min(room, SHARE * (high - low)) else value


def meant(value: float, unit: str, low: float, high: float, *, difference: bool = False) -> str:
    """Return a question that names a unit with which a number would be in its range, "" if none.

    Examples
    --------
    >>> meant(80.0, "K", 233.15, 473.15)
    '; did you mean 353.15 K (80 degC)?'
    """
    if not math.isfinite(value) or (difference and unit == "K"):
        return ""
    for written in _MEANT.get(unit, []):
        if written == "%" and abs(value) < LEAST_PERCENT:
            continue
        try:
            si = parse_quantity(f"{value!r} {written}", unit, "")
        except ParameterError:  # beyond all numbers in that unit
            continue
        if low <= si <= high and si != 0.0:
            return f"; did you mean {si:.6g} {unit} ({value:g} {written})?"
    return ""


@lru_cache(maxsize=4096)  # a scene is read again for each draw of a study
def _scaled(digits: str, factor: float, offset: float) -> float:
    """Return ``factor * number + offset``, rounded once: "0.5 um" is 5e-07 to the bit."""
    rough = factor * float(digits) + offset
    if (factor, offset) == (1.0, 0.0):
        return rough
    if not math.isfinite(rough) or not 1e-200 < abs(rough) < 1e200:
        return rough
    return float(Fraction(digits) * Fraction(repr(factor)) + Fraction(repr(offset)))


def _as_float(value: int | float) -> float:
    """Return the number; one beyond all floats counts as infinite."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def format_quantity(value: float, unit: str, *, difference: bool = False, digits: int = 4) -> str:
    """Return ``value`` [SI ``unit``] as a person would write it, with its display unit.

    Examples
    --------
    >>> format_quantity(297.15, "K")
    '24 °C'
    >>> format_quantity(1.12e-5, "m")
    '11.2 µm'
    """
    if unit == "K" and not difference:
        return f"{_rounded(value - 273.15, digits)} {_PRETTY['degC']}"
    shown, factor = display_unit(value, unit)
    whole = (
        shown == "h" and 10.0 ** (digits - 1) <= abs(value / factor) < 1e12
    )  # lives: no exponent
    text = f"{value / factor:.0f}" if whole else _rounded(value / factor, digits)
    return text if shown == "1" else f"{text} {shown}"


def format_time(value: float, digits: int = 4) -> str:
    """Return a time of a run, or how long something in it lasted: in seconds always.

    Examples
    --------
    >>> format_time(0.83654), format_time(2e-3)
    ('0.8365 s', '0.002 s')
    """
    return f"{value:.{digits}g} s"


def display_unit(value: float, unit: str) -> tuple[str, float]:
    """Return the unit in which a person reads numbers as large as this, and its size [SI ``unit``].

    >>> display_unit(1.12e-6, "m")
    ('µm', 1e-06)
    """
    shown = _readable(value, unit, _DISPLAY.get(unit, [unit]))
    return pretty_unit(shown), UNITS.get(unit, {}).get(shown, (1.0, 0.0))[0]


def readable_units() -> dict[str, list[tuple[str, float]]]:
    """Return SI unit -> units as people read them with their factors, in the order they are tried.

    Temperatures, which people read in °C, are not among them.
    """
    return {
        unit: [(_PRETTY.get(name, name), UNITS[unit][name][0]) for name in names]
        for unit, names in _DISPLAY.items()
    }


def exact_quantity(value: float, unit: str, *, difference: bool = False) -> str | float:
    """Return a text that ``parse_quantity`` reads as the same number to the bit.

    Its unit is the one that needs the fewest digits and is shortest; a bare number has none.

    Examples
    --------
    >>> exact_quantity(5.15e-7, "m"), exact_quantity(297.15, "K"), exact_quantity(2.0, "1")
    ('515 nm', '24 degC', 2.0)
    """
    if unit == "1":
        return value
    readable = _readable(value, unit, _DISPLAY.get(unit, [unit]))
    shown = ("deg",) if unit == "rad" else (readable, *_EXACT.get(unit, ()), unit)
    for digits in range(1, 18):
        texts = (
            f"{_plain_number((value - (0.0 if difference else offset)) / factor, digits)} {other}"
            for other in shown
            for factor, offset in (UNITS.get(unit, {}).get(other, (1.0, 0.0)),)
        )
        same = [t for t in texts if parse_quantity(t, unit, "", difference=difference) == value]
        if same:
            return min(same, key=len)
    return f"{value!r} {unit}"


def _plain_number(number: float, digits: int) -> str:
    """Return so many significant digits, without an exponent where that is short."""
    return repr(float(f"{number:.{digits}g}")).removesuffix(".0")


def _readable(value: float, unit: str, choices: Sequence[str]) -> str:
    """Return the first display unit in which the number is at least 1, or the last."""
    if value == 0.0 or not math.isfinite(value):
        return unit
    for shown in choices:
        if abs(value) >= 0.9995 * UNITS.get(unit, {}).get(shown, (1.0, 0.0))[0]:
            return shown
    return choices[-1]


def _rounded(number: float, digits: int) -> str:
    """Return significant digits without an exponent where that stays readable."""
    if number == 0.0 or not math.isfinite(number):
        return f"{number:g}"
    places = digits - 1 - math.floor(math.log10(abs(number)))
    if 10.0 ** (digits + 2) > abs(number) >= 1e-4:
        text = f"{number:.{max(0, places)}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    return f"{number:.{digits - 1}e}"


@lru_cache(maxsize=4096)
def _plain(unit: str) -> str:
    """Return one spelling for °C and degC, N·m, N*m and N m, m² and m^2, µm and um."""
    text = unit.strip().replace("°", "deg").replace("*", ".").replace("^", "")
    text = text.replace("·", ".").replace("\u22c5", ".")
    text = text.replace("²", "2").replace("³", "3").replace("µ", "u").replace("μ", "u")
    return re.sub(r"\s+", ".", text)


def pretty_unit(unit: str) -> str:
    """Return the unit in typography, e.g. N·m, MJ/m²."""
    text = _PRETTY.get(unit, unit)
    for plain, raised in (("m2", "m²"), ("m3", "m³"), ("s2", "s²"), ("s3", "s³")):
        text = text.replace(plain, raised)
    return text.replace(".", "·")


def _wanted(unit: str) -> str:
    """Say which units are allowed."""
    sizes = {pair: text for text, pair in reversed(UNITS.get(unit, {}).items())}  # one name of each
    others = [text for text in UNITS.get(unit, {}) if text in sizes.values() and text != unit]
    if unit == "1":
        return "a finite number, or one in %"
    also = f", or one in {', '.join(others)}" if others else ""
    return f"a finite number in {unit}{also}"


def exponents(unit: str) -> dict[str, int]:
    """Return the base exponents of a unit such as ``W/(m2.K)``.

    >>> exponents("W/(m2.K)")
    {'kg': 1, 's': -3, 'K': -1}
    """
    over, _, under = unit.partition("/")
    total: dict[str, int] = {}
    for part, sign in ((over, 1), (under.strip("()"), -1)):
        for factor in filter(None, part.split(".")):
            match = re.fullmatch(r"([A-Za-z]+)(\d*)", factor)
            if factor == "1":
                continue
            if not match or match[1] not in _BASE:
                raise ParameterError(f"unit = {unit!r}, allowed: products of {', '.join(_BASE)}")
            for name, power in _BASE[match[1]].items():
                total[name] = total.get(name, 0) + sign * power * int(match[2] or 1)
    return {name: power for name, power in total.items() if power}
