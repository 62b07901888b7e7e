"""The tables of a study as rows of text."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..html import Table
from .decides import INDEX, LEAST, column, shares
from .study_data import Band, Study
from .words import (
    HIGH,
    LEVELS,
    LOW,
    MIDDLE,
    NONE,
    band_scale,
    band_words,
    joined,
    named,
    outside_words,
    percent,
    plain,
    probability,
    title_of,
    value_words,
    varies,
    with_unit,
)

Files = Mapping[str, Mapping[float, str]]


def figure_table(result: Study, names: Sequence[str] | None = None) -> Table:
    """Return each figure: nominal, quantiles, how probably it is outside its usual range."""
    rows = []
    for name in result.figures if names is None else names:
        band = result.figures[name]
        scale = band_scale(band)
        numbers = [scale.number(x) for x in (band.nominal, *map(band.quantiles.get, LEVELS))]
        usual = "" if band.outside is None else scale.span(*band.usual)
        outside = outside_words(result, name)
        rows.append((with_unit(title_of(name, band), scale), *numbers, usual, outside))
    heads = ("", "nominal", *LEVELS.values(), "usual", "P(outside usual)")
    if not any(row[-1] for row in rows):  # nothing has a usual range
        heads, rows = heads[:-2], [row[:-2] for row in rows]
    return Table(heads, rows, numbers=range(1, len(heads)))


def confidence_table(result: Study) -> Table:
    """Return the quantiles with their confidence intervals, mean and standard deviation."""
    rows = []
    for name, band in result.figures.items():
        scale = band_scale(band)
        cells = []
        for level in LEVELS:
            low, high = band.confidence.get(level, (None, None))
            cells.append(f"{scale.number(low)} .. {scale.number(high)}")
        spread = scale.for_differences.number(band.standard_deviation)
        title = with_unit(title_of(name, band), scale)
        rows.append((title, *cells, scale.number(band.mean), spread))
    heads = ("", *LEVELS.values(), "mean", "standard deviation")
    title = f"95 % confidence of the quantiles; {NONE}: these runs give no bound"
    return Table(heads, rows, numbers=(1, 2, 3, 4, 5), title=title, folded=True, stays=True)


def probability_table(result: Study) -> Table:
    """Return how probable each yes is."""
    rows = [
        (name.replace("_", " "), probability(p, result.runs))
        for name, p in result.probabilities.items()
    ]
    return Table(("", "probability (95 % confidence)"), rows, numbers=(1,))


def matrix_table(result: Study, names: Sequence[str]) -> Table | None:
    """Return total indices, figures by sources; None without any. Small sources are left out."""
    found = {}
    for name in names:
        of = shares(result, name)
        if of and of[0].by == INDEX:
            found[name] = {s.source: s for s in of}
    sources = [s for s in _sources(found) if any(_counts(f.get(s)) for f in found.values())]
    if not found or not sources:
        return None
    rows, shades = [], []
    for name, by_source in found.items():
        values = [by_source[s].value if s in by_source else None for s in sources]
        cells = [NONE if v is None else "" if v < LEAST else f"{v:.2f}" for v in values]
        rows.append((title_of(name, result.figures[name]), *cells))
        shades.append((None, *(None if v is None else min(max(v, 0.0), 1.0) for v in values)))
    return Table(
        ("", *map(joined, sources)), rows, numbers=range(1, len(sources) + 1), shades=shades
    )


def _sources(found: Mapping[str, Mapping[str, object]]) -> list[str]:
    return list(dict.fromkeys(source for of in found.values() for source in of))


def _counts(share: Any) -> bool:
    return share is not None and share.weight >= LEAST


def source_table(result: Study) -> Table:
    """Return what scatters: nominal value, law, where the law comes from."""
    units = getattr(result, "units", {})
    rows = [
        (
            named(source.name),
            value_words(source.nominal, units.get(source.name, "")),
            source.words,
            source.reason or "given",
        )
        for source in result.sources
    ]
    return Table(("", "nominal", "distribution", "what it rests on"), rows, numbers=(1,))


def failed_table(result: Study) -> Table:
    """Return the failed runs by their reason."""
    rows = [(reason, str(count)) for reason, count in result.failed.items()]
    return Table(("why a run failed", "runs"), rows, numbers=(1,))


def error_table(result: Study, names: Sequence[str]) -> Table:
    """Return the three kinds of error of each figure side by side.

    Mesh or level: numerical error; model: how far a choice moves the median; inputs: the range from
    5 to 95 % about the nominal value. In percent of the nominal value, temperatures in kelvin.
    """
    rows = []
    for name in names:
        band = result.figures[name]
        rows.append(
            (title_of(name, band), _numerical(band), _by_choice(result, name), _by_inputs(band))
        )
    heads = ("", "mesh, step or level", "choice of the model", "inputs, 5 .. 95 %")
    return Table(heads, rows, numbers=(1, 3))


def _numerical(band: Band) -> str:
    if band.error is None or not math.isfinite(band.error):
        return "not known"
    return f"± {plain(100.0 * band.error, 2)} %"


def _off(band: Band, difference: float) -> str:
    """Return a difference of a figure: in kelvin, or in percent of the nominal value."""
    if band.unit == "K":
        text = plain(difference, 2)
    elif not band.nominal or not math.isfinite(band.nominal):
        return _with_sign(band_scale(band).for_differences.words(difference), difference)
    else:
        text = plain(100.0 * difference / abs(band.nominal), 2)
    return _with_sign(f"{text} {'K' if band.unit == 'K' else '%'}", difference)


def _with_sign(text: str, value: float) -> str:
    return f"+{text}" if value > 0.0 else text


def _by_inputs(band: Band) -> str:
    base = band.nominal if math.isfinite(band.nominal) else band.quantiles[MIDDLE]
    if not varies(band):
        return "none"
    low, high = (_off(band, band.quantiles[level] - base) for level in (LOW, HIGH))
    return f"{low} .. {high}"


def choices_of(result: Study) -> list[str]:
    """Return the sources that are choices of the model."""
    return [s.name for s in result.sources if isinstance(s.nominal, str | bool)]


def _by_choice(result: Study, name: str) -> str:
    """Return how far a choice of the model moves the median at most, against the nominal choice."""
    values, words = column(result.sample, name), []
    for source in result.sources:
        if source.name not in choices_of(result):
            continue
        drawn = np.asarray(result.sample[source.name])
        medians = {
            str(choice): float(np.median(own))
            for choice in dict.fromkeys(drawn.tolist())
            if values is not None and len(own := values[(drawn == choice) & np.isfinite(values)])
        }
        base = medians.pop(str(source.nominal), None)
        if base is not None and medians:
            other, median = max(medians.items(), key=lambda item: abs(item[1] - base))
            off = _off(result.figures[name], median - base)
            words.append(f"{named(source.name)}: {other} {off} against {source.nominal}")
    return "; ".join(words) or "none scatters"


def nearest_tables(result: Study, names: Sequence[str], files: Files) -> list[Table]:
    """Return the runs nearest to the quantiles: links to their files, then the values of each."""
    names, units = [n for n in names if n in result.nearest], getattr(result, "units", {})
    tables = []
    if files:
        rows = [
            (title_of(n, result.figures[n]), *(_link(files.get(n, {}).get(x)) for x in LEVELS))
            for n in names
        ]
        tables.append(Table(("run nearest to the", *LEVELS.values()), rows))
    for name in names:
        runs, band = result.nearest[name], result.figures[name]
        rows = [
            (
                named(s.name),
                *(
                    value_words(x, units.get(s.name, ""))
                    for x in (s.nominal, *(runs[level].get(s.name, math.nan) for level in LEVELS))
                ),
            )
            for s in result.sources
        ]
        heads = ("", "nominal", *(f"nearest to {words}" for words in LEVELS.values()))
        title = f"{title_of(name, band)}: {band_words(band)}"
        tables.append(
            Table(heads, rows, numbers=(1, 2, 3, 4), title=title, folded=True, stays=True)
        )
    return tables


def _link(file: str | None) -> Any:
    from markupsafe import Markup

    return NONE if file is None else Markup('<a href="{0}">{0}</a>').format(file)


def share_of_failed(result: Study) -> str:
    """Return how many runs failed, in words."""
    failed = sum(result.failed.values())
    if not failed:
        return f"All {result.solves} runs have a solution."
    share = percent(failed / result.solves)
    return (
        f"{failed} of {result.solves} runs ({share}) have no solution. The confidence of quantiles "
        "and probabilities has them at either end; indices leave out their base points."
    )
