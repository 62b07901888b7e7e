"""Figures, bands and probabilities as a person reads them."""

import math
import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ....units import display_unit, format_quantity
from ..palette import CELSIUS
from .study_data import Band, Probability, Study

NONE = "\N{EN DASH}"
LOW, MIDDLE, HIGH = 0.05, 0.5, 0.95
BAND = "5 .. 95 %"  # the head of a column
MOST_DIGITS = 6
SHORT = 24  # letters of a title that fits above a small picture with its unit
LIFE = 1e5  # s
LOST = "film_lost"
LOST_TEXTS = {
    "part": "the asperities carry: the contact branch, or a film ratio below 3 where there are no "
    "folds",
    "scene": "in contact (distress) at any instant while it turns",
}
LEVELS = {LOW: "5 %", MIDDLE: "50 %", HIGH: "95 %"}


class Scale(NamedTuple):
    """The unit in which a figure's values are shown: its name, its size and zero [SI].

    ``digits`` are as many as tell the values apart.
    """

    unit: str
    size: float = 1.0
    zero: float = 0.0
    digits: int = 3

    def number(self, value: float | None) -> str:
        """Return a value without its unit."""
        if value is None or not math.isfinite(value):
            return NONE
        return plain((value - self.zero) / self.size, self.digits)

    def words(self, value: float | None) -> str:
        """Return a value with its unit."""
        return self._with_unit(self.number(value))

    def span(self, low: float | None, high: float | None) -> str:
        """Return a range with its unit; one without an end is open."""
        if low is None or not math.isfinite(low):
            return self._with_unit(f"up to {self.number(high)}")
        if high is None or not math.isfinite(high):
            return self._with_unit(f"{self.number(low)} or more")
        return self._with_unit(f"{self.number(low)} .. {self.number(high)}")

    @property
    def for_differences(self) -> "Scale":
        """The same for differences of values."""
        return self._replace(zero=0.0, digits=3)

    def _with_unit(self, text: str) -> str:
        return f"{text} {self.unit}".strip()


def plain(value: float, digits: int = 3) -> str:
    """Return significant digits, with an exponent for tiny and huge numbers only."""
    text = f"{float(f'{value:.{digits}g}'):.12g}"
    if value and not 1e-4 <= abs(value) < 1e7:
        text = f"{value:.{digits - 1}e}"
    return text.replace("-", "\N{MINUS SIGN}")


def padded(value: float, digits: int = 3) -> str:
    """Return just so many significant digits, zeros at the end among them."""
    if not value or not math.isfinite(value) or not 1e-4 <= abs(value) < 1e7:
        return plain(value, digits) if math.isfinite(value) else NONE
    shown = float(f"{value:.{digits}g}")
    places = max(digits - 1 - math.floor(math.log10(abs(shown))), 0)
    return f"{shown:.{places}f}".replace("-", "\N{MINUS SIGN}")


def scale_of(unit: str, values: Iterable[float | None], *, relative: bool = False) -> Scale:
    """Return the unit for values as large as these [SI]."""
    if unit == "K" and not relative:
        return Scale("°C", 1.0, CELSIUS)
    largest = max((abs(v) for v in values if v is not None and math.isfinite(v)), default=0.0)
    if unit == "s":  # times of a run stay in seconds, lives are hours
        return Scale("h", 3600.0) if largest >= LIFE else Scale("s")
    shown, size = display_unit(largest, unit)
    return Scale("" if shown == "1" else shown, size)


def band_scale(band: Band) -> Scale:
    """Return the unit of a figure's values."""
    values = (band.nominal, *band.quantiles.values())
    scale = scale_of(band.unit, values, relative=band.relative)
    low, high = (band.quantiles.get(level, math.nan) for level in (LOW, HIGH))
    if not varies(band) or low == high:
        return scale
    larger = max(abs(low - scale.zero), abs(high - scale.zero))
    digits = 1 + math.ceil(math.log10(larger / (high - low)))
    return scale._replace(digits=max(digits, 3) if digits <= MOST_DIGITS else 3)


def named(name: str) -> str:
    """Return a name as words: "clutch.friction_scale" is clutch: friction scale."""
    part, _, own = name.rpartition(".")
    words = own.replace("_", " ")
    if own.isdecimal():  # a point of a list: its path
        return name
    return f"{part.replace('_', ' ').replace('.', ' ')}: {words}" if part else words


def joined(name: str) -> str:
    """Return the name of a source or of correlated ones as words."""
    return " + ".join(map(named, name.split(" + ")))


def spoken(help: str) -> str:
    """Return what a figure is without what stands in brackets and after a semicolon."""
    return re.sub(r"\s*\([^()]*\)", "", help.split(";")[0]).strip()


def title_of(name: str, band: Band) -> str:
    """Return what a figure is, its name where nothing says it."""
    return spoken(band.help) or named(name)


def short_title(name: str, band: Band) -> str:
    """Return a title for a small picture: what a figure is if that is short, else its name."""
    title = title_of(name, band)
    return title if len(title) <= SHORT else named(name)


def steady_texts(result: Study) -> list[str]:
    """Return what is to be known of washer temperatures in the runs of a scene's study."""
    if result.kind != "scene" or not any("washer_temperature" in name for name in result.figures):
        return []
    return [
        "Washer temperatures: where the scene takes them as steady, runs of the study are not "
        "followed in time, and no run is checked one by one."
    ]


def with_unit(title: str, scale: Scale, most: int = 1000) -> str:
    """Return a title with the unit of what it names, both in so many letters."""
    unit = f" [{scale.unit}]" if scale.unit else ""
    return shortened(title, most - len(unit)) + unit


def shortened(text: str, most: int) -> str:
    """Return a text, its end replaced by dots where it is too long."""
    return text if len(text) <= most else f"{text[: most - 1].rstrip()}…"


def percent(share: float, runs: int = 0) -> str:
    """Return a share, never rounded to a certainty that it is not.

    Of so many runs it has two digits, not more than a run makes a difference.
    """
    if not math.isfinite(share):
        return NONE
    places = max(0, -math.floor(math.log10(100.0 / runs))) if runs else 1
    least = 10.0**-places
    value = float(f"{100.0 * share:.{2 if runs else 3}g}")
    value = round(value, places) if runs else value
    if share > 0.0 and value < least:
        return f"below {least:g} %"
    if share < 1.0 and value > 100.0 - least:
        return f"above {100.0 - least:g} %"
    return f"{value:g} %"


def probability(p: Probability, runs: int = 0) -> str:
    """Return a probability of so many runs with its confidence interval."""
    if p is None or not math.isfinite(p.value):
        return NONE
    return f"{percent(p.value, runs)} ({between(p)})"


def outside_words(result: Study, name: str) -> str:
    """Return how probably a figure is below and above its usual range; "" without one."""
    band = result.figures[name]
    values = np.asarray(result.sample.get(f"{name} (result)", result.sample.get(name, ())), float)
    values = values[np.isfinite(values)]
    if band.outside is None or not len(values):
        return "" if band.outside is None else probability(band.outside, result.runs)
    low, high = band.usual
    sides = {"below": float((values < low).mean()), "above": float((values > high).mean())}
    ends = {"below": low, "above": high}
    words = [
        f"{percent(x, result.runs)} {side}"
        for side, x in sides.items()
        if math.isfinite(ends[side])
    ]
    together = "together " if all(sides.values()) else ""
    return f"{', '.join(words)} ({together}{between(band.outside)})"


def not_expected(result: Study, names: Iterable[str]) -> list[str]:
    """Return a sentence on those figures whose nominal value is outside their band, if any."""
    found = []
    for name in names:
        band = result.figures[name]
        low, high = band.quantiles[LOW], band.quantiles[HIGH]
        if varies(band) and math.isfinite(band.nominal) and not low <= band.nominal <= high:
            scale = band_scale(band)
            found.append(
                f"{title_of(name, band)} {scale.words(band.nominal)} against {band_words(band)} in "
                f"nine of ten runs, median {scale.words(band.quantiles[MIDDLE])}"
            )
    return [f"The nominal value is not what to expect: {'; '.join(found)}."] if found else []


def between(p: Probability) -> str:
    """Return the confidence interval of a probability."""
    low, high = (plain(100.0 * x, 2 if x < 0.95 else 3) for x in (p.low, p.high))
    return f"{low} .. {high} %"


def value_words(value: object, unit: str) -> str:
    """Return a source's value: a quantity, a word, yes or no."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        if not math.isfinite(value):
            return NONE
        return format_quantity(float(value), unit or "1", digits=4).removesuffix(" 1")
    return str(value)


def band_words(band: Band) -> str:
    """Return the range from the 5 to the 95 % quantile, both ends with as many digits."""
    scale = band_scale(band)
    ends = (band.quantiles.get(level, math.nan) for level in (LOW, HIGH))
    low, high = (padded((x - scale.zero) / scale.size, scale.digits) for x in ends)
    return f"{low} .. {high} {scale.unit}".strip()


def loose_words(band: Band) -> list[str]:
    """Return what is known of quantiles whose confidence spans more than half of the band."""
    scale, width = band_scale(band), band.quantiles[HIGH] - band.quantiles[LOW]
    return [
        f"{LEVELS[level]} quantile by 95 % confidence: {scale.span(low, high)}"
        for level in (LOW, HIGH)
        for low, high in [band.confidence[level]]
        if high - low > 0.5 * width and (math.isfinite(low) or math.isfinite(high))
    ]


def sentence(text: str) -> str:
    """Return a text as a sentence."""
    return f"{text[:1].upper()}{text[1:].removesuffix('.')}." if text else ""


def varies(band: Band) -> bool:
    """Return whether a figure is there and scatters."""
    low, high = (band.quantiles.get(level, math.nan) for level in (LOW, HIGH))
    known = math.isfinite(low) and math.isfinite(high)
    return known and (high > low or band.standard_deviation > 0.0)


def relative_spread(band: Band) -> float:
    """Return the range from 5 to 95 % over the median's size; of temperatures over 100 K."""
    size = 100.0 if band.unit == "K" else abs(band.quantiles[MIDDLE])
    spread = band.quantiles[HIGH] - band.quantiles[LOW]
    return float(spread / size) if size else math.inf
