"""The page of a study: bands first, then what decides them, then what all of it rests on."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ....units import format_quantity as say
from ..html import Card, Page, Plot, Section
from . import scatter_plots as plots
from . import scatter_tables as tables
from .decides import (
    INDEX,
    LEAST,
    RANK,
    chances,
    column,
    flagged,
    lost_texts,
    most_words,
    shares,
    signed,
    verdict,
)
from .lost_power import NAME as EFFICIENCY
from .lost_power import other_ends, with_lost_power
from .study_data import Study
from .words import (
    LOST,
    band_scale,
    band_words,
    between,
    joined,
    loose_words,
    named,
    not_expected,
    padded,
    percent,
    relative_spread,
    sentence,
    short_title,
    steady_texts,
    title_of,
    varies,
)

MOST_FIGURES, MOST_CARDS, MOST_BANDS, MOST_OVER_TIME = 12, 8, 8, 4
LEADING = ("efficiency", "loss", "bearing_life")  # figures of a gear train that come first
MUCH = 0.1  # square of a coefficient that makes a source worth naming
BAND_TEXT = (
    "Shaded: 90 % of all runs are inside, instant by instant. Dashed: the nominal values of all "
    "inputs, which need not be the middle."
)
DISTRIBUTION_TEXT = (
    "How often each value occurred. Thin lines: 5 and 95 %, thick: the median, dashed: the run at "
    "the nominal values. The outermost 0.5 % are drawn at the ends."
)
DECIDED_TEXT = (
    "Total Sobol' index: the share of a figure's variance that this input has to do with, alone or "
    "with others; the indices of a figure may add up to more than 1. The line at the end of a bar "
    "is the 95 % confidence interval."
)
RANK_TEXT = (
    "Of figures without indices: the standardised rank regression coefficient, by least squares of "
    "the figure's ranks on the ranks of all inputs: how steadily the figure rises (blue) or falls "
    "(purple) with this input, the others held. A choice, and correlated inputs together, have no "
    "sign. The line is the 95 % confidence interval. With --indices all they have indices too."
)
OVER_TIME_TEXT = (
    "Which input decides a signal at which time. Nothing is drawn where the signal hardly scatters."
)
ERROR_TEXT = (
    "Three errors that have nothing to do with each other, each relative to the nominal value, of "
    "temperatures in kelvin: the error of the mesh or fidelity level, how far a choice between "
    "models moves the median, and how far the scatter of the inputs reaches. A finer mesh helps "
    "where the first is the largest, and nowhere else."
)
SOURCES_TEXT = (
    "What is called an estimate has no source beyond engineering practice: measure it first if it "
    "decides much. What is not listed does not scatter."
)


def scatter_page(result: Study, files: tables.Files | None = None) -> Page:
    """Return the page of a study.

    Parameters
    ----------
    result : the study, a ``scatter.result.ScatterResult``
    files : scene or part files of the runs nearest to quantiles, by figure and quantile, as the
        page links them; None: there are none
    """
    result = with_lost_power(result)
    if files and result.model == "train":
        files = {n: other_ends(x) if n == EFFICIENCY else x for n, x in files.items()}
    chosen = main_figures(result, MOST_FIGURES)
    return Page(
        title=f"Uncertainty: {result.target}",
        subtitle=_subtitle(result),
        summary=[
            *_verdicts(result, chosen),
            *_chance_text(result),
            *lost_texts(result),
            *not_expected(result, chosen),
        ],
        warnings=list(map(sentence, result.warnings)),
        cards=_cards(result, chosen),
        sections=[
            *band_sections(result),
            *_distribution_sections(result, chosen),
            _figure_section(result, chosen),
            *decided_sections(result, chosen),
            *over_time_sections(result),
            source_section(result),
            *error_sections(result, chosen),
            *_nearest_sections(result, chosen, files or {}),
            Section("runs", "The runs", texts=_run_texts(result, chosen), tables=_failed(result)),
        ],
        footer="One file, readable offline. The same numbers: sample.csv, figures.csv and, of a "
        "scene, series.csv next to this page, and thrustwasher scatter --json.",
    )


def main_figures(result: Study, most: int) -> list[str]:
    """Return so many figures that scatter, in their own order.

    Those with a usual range come first, then those of washers, then those that scatter most.
    """
    found = [name for name, band in result.figures.items() if varies(band)]
    washers = washer_figures(result)

    leading = [name for name in LEADING if name in found and result.model == "train"]

    def rank(name: str) -> tuple[bool, bool, bool, float]:
        band, wanted = result.figures[name], name not in leading
        return wanted, band.outside is None, name not in washers, -relative_spread(band)

    first = sorted(found, key=rank)[:most]
    return [*leading[:most], *(n for n in found if n in first and n not in leading)]


def _subtitle(result: Study) -> str:
    kind = {"part": "Part", "scene": "Scene"}.get(result.kind, "Function")
    runs = f"{len(result.sources)} inputs scatter, {result.runs} base points, {result.solves} runs"
    held = f" ({setting_words(result)})" if result.setting else ""
    return f"{kind} {result.target}{held}, {runs}, made by thrustwasher"


def setting_words(result: Study) -> str:
    """Return what of a part does not scatter: level, operating point, oil."""
    return ", ".join(
        value if value.startswith(f"{name} ") else f"{named(name)} {value}"  # "oil ISO VG 46, .."
        for name, value in result.setting.items()
    )


def _verdicts(result: Study, names: Sequence[str]) -> list[str]:
    """Return what decides most, of the washers where there are some."""
    films = film_figures(result)
    return verdict(result, "the washers", films) if films else _first_decided(result, names)


def washer_figures(result: Study) -> list[str]:
    """Return the figures of a scene that say how its washers fare."""
    return [name for name in result.figures if result.kind == "scene" and "washer" in name]


def film_figures(result: Study) -> list[str]:
    """Return the figures that the verdict on a scene's washers is made of: their film ratios."""
    washers = washer_figures(result)
    return [name for name in washers if name.endswith("film_ratio")] or washers


def _first_decided(result: Study, names: Sequence[str]) -> list[str]:
    """Return what decides the first figures; the film ratio where a film can be lost."""
    texts = []
    film = [n for n in ("film_ratio",) if LOST in result.probabilities and n in result.figures]
    for name in list(dict.fromkeys([*film, *names]))[:3]:
        band = result.figures[name]
        if varies(band):
            most = most_words(shares(result, name), flagged(result))
            texts.append(f"{title_of(name, band)}: {band_words(band)}, {most}")
    return [sentence("; ".join(texts))] if texts else []


def _chance_text(result: Study) -> list[str]:
    said = sentence("; ".join(chances(result)))
    return [said] if said else []


def chance_cards(result: Study, names: Sequence[str] = ()) -> list[Card]:
    """Return a panel per probability, of these names or all."""
    return [
        Card(
            f"probability: {named(name)}",
            percent(p.value, result.runs),
            f"95 % confidence: {between(p)}",
        )
        for name, p in result.probabilities.items()
        if not names or name in names
    ]


def _cards(result: Study, names: Sequence[str]) -> list[Card]:
    chances, cards = chance_cards(result), list[Card]()
    washers = [name for name in names if name in washer_figures(result)][:2]
    others = [name for name in names if name not in washers]
    for name in [*washers, *others][: max(MOST_CARDS - len(chances), 4)]:
        band = result.figures[name]
        scale = band_scale(band)
        nominal = padded((band.nominal - scale.zero) / scale.size, scale.digits)
        note = "; ".join([f"5 .. 95 %; nominal {nominal} {scale.unit}".strip(), *loose_words(band)])
        cards.append(Card(title_of(name, band), band_words(band), note))
    return [*cards, *chances] if result.model == "train" else [*chances, *cards]


def band_sections(result: Study) -> list[Section]:
    """Return the signals over time with their bands."""
    tiles = [
        Plot(f"band-{i}", plots.band_figure(name, series), f"{named(name)} over time", tiles=2)
        for i, (name, series) in enumerate(result.series.items())
        if i < MOST_BANDS and plots.is_there(series)
    ]
    return [Section("bands", "Over time", texts=[BAND_TEXT], plots=tiles)] if tiles else []


def _distribution_sections(result: Study, names: Sequence[str]) -> list[Section]:
    tiles = []
    for i, name in enumerate(names):
        if column(result.sample, name) is not None:
            band = result.figures[name]
            figure = plots.distribution_figure(result, name, short_title(name, band))
            caption = f"{title_of(name, band)}: {band_words(band)}"
            tiles.append(Plot(f"spread-{i}", figure, caption, tiles=3))
    title = "Distributions of the figures"
    return [Section("spread", title, texts=[DISTRIBUTION_TEXT], plots=tiles)] if tiles else []


def _figure_section(result: Study, names: Sequence[str]) -> Section:
    chance = [tables.probability_table(result)] if result.probabilities else []
    shown = [tables.figure_table(result, names), *chance]
    if len(names) < len(result.figures):
        title = f"All {len(result.figures)} figures"
        shown.append(replace(tables.figure_table(result), title=title, folded=True, stays=True))
    shown.append(tables.confidence_table(result))
    title = "Figures and their bands"
    return Section("figures", title, texts=steady_texts(result), tables=shown)


def decided_sections(result: Study, names: Sequence[str]) -> list[Section]:
    """Return what decides each figure: the overview of all, bars of the chosen ones."""
    found = {name: of for name in names if (of := shares(result, name))}
    if not found:
        return []
    used = {of[0].by for of in found.values()}
    texts = [text for by, text in ((INDEX, DECIDED_TEXT), (RANK, RANK_TEXT)) if by in used]
    small = _small_sources(result)
    texts += (
        [f"Below {LEAST} for every figure that has indices: {', '.join(small)}."] if small else []
    )
    matrix = tables.matrix_table(result, names)
    tiles = [
        Plot(
            f"decides-{i}",
            plots.bar_figure(of, short_title(name, result.figures[name])),
            f"{title_of(name, result.figures[name])}: {most_words(of)}",
            tiles=3,
        )
        for i, (name, of) in enumerate(found.items())
    ]
    shown = [matrix] if matrix else []
    whole = tables.matrix_table(result, list(result.figures))
    if matrix and whole and len(matrix.rows) < len(whole.rows):
        title = f"Total indices of all {len(whole.rows)} figures"
        shown.append(replace(whole, title=title, folded=True, stays=True))
    return [Section("decides", "Dominant inputs", texts=texts, plots=tiles, tables=shown)]


def _small_sources(result: Study) -> list[str]:
    """Return the sources that decide nothing of a figure with indices, and little of the others."""
    found = [share for name in result.figures for share in shares(result, name)]
    counts = {s.source for s in found if s.weight >= (LEAST if s.by == INDEX else MUCH)}
    return [joined(source) for source in sorted({s.source for s in found} - counts)]


def over_time_sections(result: Study) -> list[Section]:
    """Return the indices of signals over time; torques first."""
    known = {n: s for n, s in result.series.items() if s.indices and plots.is_there(s)}
    ranked = sorted(known, key=lambda name: "torque" not in name)[:MOST_OVER_TIME]
    tiles = [
        Plot(f"over-time-{i}", figure, f"indices of {named(name)} over time", tiles=2)
        for i, name in enumerate(ranked)
        if (figure := plots.decided_over_time(name, known[name])) is not None
    ]
    title = "Dominant inputs over time"
    return [Section("over-time", title, texts=[OVER_TIME_TEXT], plots=tiles)] if tiles else []


def source_section(result: Study) -> Section:
    """Return what scatters, how, and what that rests on."""
    return Section(
        "sources",
        "Inputs with a scatter (uncertainty)",
        texts=source_texts(result),
        tables=[tables.source_table(result)],
    )


def source_texts(result: Study) -> list[str]:
    """Return what is to be known of the sources: estimates, the point, correlations."""
    pairs = [f"{named(a)} and {named(b)} {signed(r)}" for a, b, r in result.correlations]
    return [
        SOURCES_TEXT,
        *([f"Held: {setting_words(result)}."] if result.setting else []),
        *([f"Correlated, by their normal scores: {', '.join(pairs)}."] if pairs else []),
    ]


def error_sections(result: Study, names: Sequence[str]) -> list[Section]:
    """Return mesh, model and inputs side by side; none where inputs alone are known."""
    if not tables.choices_of(result) and all(result.figures[n].error is None for n in names):
        return []
    table, notes = tables.error_table(result, names), map(sentence, result.notes)
    title = "Mesh, model, inputs"
    return [Section("errors", title, texts=[ERROR_TEXT, *notes], tables=[table])]


def _nearest_sections(
    result: Study, names: Sequence[str], files: Mapping[str, Mapping[float, str]]
) -> list[Section]:
    found = tables.nearest_tables(result, names, files)
    text = "The base runs nearest to the 5, 50 and 95 % quantile of a figure, with their inputs."
    if files:
        runs = (
            "shift --scene FILE runs"
            if result.kind == "scene"
            else f"{result.model} --part FILE solves"
        )
        text += f" Each is a file next to this page: thrustwasher {runs} it."
    title = "Runs that stand for the band"
    return [Section("nearest", title, texts=[text], tables=found)] if found else []


def _run_texts(result: Study, names: Sequence[str]) -> list[str]:
    side = "up from light load" if result.reached == "below" else "down from a high load"
    return [
        tables.share_of_failed(result),
        f"Scrambled Sobol' points, seed {result.seed}: quantiles and probabilities are of "
        f"{result.runs} base runs, indices of exchanges between them (Saltelli's design), "
        "confidence of eight independent scrambles. Where several solutions exist, the branch is "
        f"the one reached {side}. Took {say(result.wall_time, 's', digits=3)}.",
        *([] if error_sections(result, names) else map(sentence, result.notes)),
    ]


def _failed(result: Study) -> list[Any]:
    return [tables.failed_table(result)] if result.failed else []
