"""What a study leaves: bands of figures, what decides them, probabilities, bands over time."""

import csv
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...shown import Card, Line, Tabled, Words, text_of
from ...storage.digests import finite
from ...storage.whole_files import whole_folder
from .estimates import LEVELS

Array = NDArray[np.float64]
SAMPLE, FIGURES, SERIES = "sample.csv", "figures.csv", "series.csv"


class SourceLine(NamedTuple):
    """Something that scatters, as a report shows it."""

    name: str
    words: str
    """Its distribution."""
    reason: str
    """Where that comes from."""
    nominal: float | str | bool


@dataclass(frozen=True, kw_only=True)
class Index:
    """How much of a figure's variance a source decides; None where the figure does not vary."""

    first: float | None
    """By itself."""
    total: float | None
    """With all its interactions."""
    confidence: float | None
    """Half the 95 % confidence interval, the larger one of both."""
    first_confidence: float | None
    total_confidence: float | None


@dataclass(frozen=True, kw_only=True)
class Probability:
    """A probability with its 95 % confidence interval, widened by the failed runs."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, kw_only=True)
class Band:
    """A figure: its nominal value and what the scatter makes of it [SI]."""

    nominal: float
    quantiles: dict[float, float]
    """At 0.05, 0.5, 0.95, of the runs that have this figure."""
    confidence: dict[float, tuple[float, float]]
    """Their 95 % confidence intervals, with failed runs at either end; infinite: no bound."""
    mean: float
    standard_deviation: float
    indices: dict[str, Index]
    """By source or joined names of correlated ones; {} without indices."""
    left_out: int = 0
    """Base points that the indices leave out: a run of theirs failed or lacks this figure."""
    absent: int = 0
    """Base runs that did not fail and yet lack this figure."""
    unit: str
    relative: bool = False
    """A difference of temperatures."""
    help: str
    usual: tuple[float, float]
    outside: Probability | None = None
    """Of a value outside the usual range; None without such a range."""
    error: float | None = None
    """Numerical error, relative; None: not known."""
    linear_deviation: float | None = None
    """Standard deviation by the gradient at the nominal values; None: not requested or unknown."""


@dataclass(frozen=True, kw_only=True)
class Series:
    """A signal over time, all (n_t,)."""

    time: Array
    nominal: Array
    quantiles: dict[float, Array]
    indices: dict[str, Array]
    """Total indices by source, NaN where nothing varies."""
    unit: str = ""


@dataclass(frozen=True, kw_only=True)
class ScatterResult(Tabled):
    """What a study found."""

    target: str
    kind: str
    runs: int
    """Base points."""
    solves: int
    """Runs in all."""
    failed: dict[str, int]
    """Failed runs by their reason."""
    reached: str
    seed: int
    sources: tuple[SourceLine, ...]
    figures: dict[str, Band]
    probabilities: dict[str, Probability]
    series: dict[str, Series] = field(default_factory=dict)
    nearest: dict[str, dict[float, dict[str, Any]]] = field(default_factory=dict)
    """Sources' values [SI] of the base run nearest to each quantile of a figure."""
    sample: dict[str, Any] = field(default_factory=dict, repr=False)
    """Base runs by columns: sources, figures, outcomes, status."""
    units: dict[str, str] = field(default_factory=dict, repr=False)
    """Of the sample's columns."""
    groups: tuple[str, ...] = ()
    """Sources as indices have them: correlated ones by their joined names."""
    correlations: tuple[tuple[str, str, float], ...] = ()
    """Pairs of correlated sources, with the correlation of their normal scores."""
    model: str = ""
    """Command that solves a part."""
    setting: dict[str, str] = field(default_factory=dict)
    """Of a part what does not scatter: its level, its point, its oil, in words."""
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    """What is to be known of errors, and no warning."""
    wall_time: float = 0.0

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON has of it, without sample and series; None for what is not finite."""
        figures = {}
        for name, band in self.figures.items():
            record = asdict(band)
            record["quantiles"] = _by_text(band.quantiles)
            record["confidence"] = _by_text(band.confidence)
            figures[name] = record
        plain: dict[str, Any] = finite(
            {
                "target": self.target,
                "kind": self.kind,
                "runs": self.runs,
                "solves": self.solves,
                "failed": sum(self.failed.values()),
                "failures": self.failed,
                "reached": self.reached,
                "seed": self.seed,
                "setting": self.setting,
                "correlations": [list(pair) for pair in self.correlations],
                "sources": [line._asdict() for line in self.sources],
                "figures": figures,
                "probabilities": {name: p.value for name, p in self.probabilities.items()},
                "probability_bounds": {
                    name: (p.low, p.high) for name, p in self.probabilities.items()
                },
                "nearest": {name: _by_text(rows) for name, rows in self.nearest.items()},
                "warnings": list(self.warnings),
                "notes": list(self.notes),
                "wall_time": self.wall_time,
            }
        )
        return plain

    def write(self, folder: str | Path) -> None:
        """Write ``sample.csv``, ``figures.csv`` and, with series, ``series.csv``."""
        with whole_folder(Path(folder)) as draft:
            write_columns(draft / SAMPLE, self.sample, self.units)
            _write(draft / FIGURES, self._figure_rows())
            if self.series:
                columns, units = self._series_columns()
                write_columns(draft / SERIES, columns, units)

    def frame(self) -> Any:
        """Return ``to_pandas()``, under the name it had first."""
        return self.to_pandas()

    def _columns(self) -> dict[str, Any]:
        """Return the sample: a row for each base run."""
        return self.sample

    def _words(self) -> dict[str, Words]:
        known = {name: Words(unit) for name, unit in self.units.items()}
        return known | {n: Words(b.unit, b.help, b.relative) for n, b in self.figures.items()}

    def _card(self) -> Card:
        from ..report.scatter.decides import most_words, shares
        from ..report.scatter.words import band_words, probability, varies

        lines = []
        for name, b in self.figures.items():
            words = [b.help, f"nominal {text_of(b.nominal, b.unit, b.relative, 4)}"]
            words += [most_words(shares(self, name))] if varies(b) else []
            lines.append(Line(name, band_words(b), "; ".join(filter(None, words))))
        for name, p in self.probabilities.items():
            lines.append(Line(name, probability(p, self.runs), "probability, 95 % confidence"))
        title = f"{self.target}: 5 .. 95 % of {self.runs} runs, {len(self.sources)} inputs scatter"
        return Card(title, lines, self.notes, self.warnings)

    def _figure_rows(self) -> Iterable[list[Any]]:
        decided = list(dict.fromkeys(n for b in self.figures.values() for n in b.indices))
        head = ["figure", "unit", "nominal"]
        for level in LEVELS:
            head += [f"{level:g}", f"{level:g} low", f"{level:g} high"]
        head += ["mean", "standard deviation", "probability outside", "numerical error"]
        for name in decided:
            head += [f"first {name}", f"total {name}", f"confidence {name}"]
        yield head
        for name, band in self.figures.items():
            row: list[Any] = [name, band.unit, band.nominal]
            for level in LEVELS:
                row += [band.quantiles[level], *band.confidence[level]]
            outside = band.outside.value if band.outside else None
            row += [band.mean, band.standard_deviation, outside, band.error]
            for source in decided:
                index = band.indices.get(source)
                row += [index.first, index.total, index.confidence] if index else [None] * 3
            yield row

    def _series_columns(self) -> tuple[dict[str, Any], dict[str, str]]:
        columns: dict[str, Any] = {"time": next(iter(self.series.values())).time}
        units = {"time": "s"}
        for name, found in self.series.items():
            own = {f"{name} nominal": found.nominal}
            own |= {f"{name} {level:g}": values for level, values in found.quantiles.items()}
            units |= dict.fromkeys(own, found.unit)
            own |= {f"{name} total {source}": x for source, x in found.indices.items()}
            columns |= own
        return columns, units


def write_columns(path: Path, columns: Mapping[str, object], units: Mapping[str, str]) -> None:
    """Write columns as CSV, units in the head, numbers in full, empty where there is none."""
    heads = (f"{n} [{units[n]}]" if units.get(n, "1") not in ("", "1") else n for n in columns)
    values = (c.tolist() if isinstance(c, np.ndarray) else c for c in columns.values())
    _write(path, [list(heads), *map(list, zip(*values, strict=True))])


def _write(path: Path, rows: Iterable[list[Any]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream).writerows([_cell(value) for value in row] for row in rows)


def _cell(value: object) -> Any:
    """Return what a cell holds: nothing for None and what is not finite."""
    is_nothing = value is None or (isinstance(value, float) and not math.isfinite(value))
    return "" if is_nothing else value


def _by_text(by_level: Mapping[float, object]) -> dict[str, Any]:
    return {f"{level:g}": value for level, value in by_level.items()}
