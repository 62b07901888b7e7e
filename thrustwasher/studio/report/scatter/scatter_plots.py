"""Plots of a study: bands over time, distributions, bars of what decides."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import palette
from ..style import Picture, heading, label, new_figure, styled
from .decides import LEAST, RANK, Share, column
from .study_data import Series, Study
from .words import (
    HIGH,
    LOST,
    LOW,
    MIDDLE,
    Scale,
    band_scale,
    joined,
    named,
    scale_of,
    shortened,
    with_unit,
)

ACROSS = 3  # distributions in a row
WIDE, NARROW = 4.6, 3.3  # inch of a tile, two and three in a row
BARS = 6  # at most
COLOURS = ("BLUE", "RED", "GREEN", "ORANGE", "PURPLE", "SKY")
PER_INCH = 12.0  # letters of a title
PLAIN = Scale("")
LETTERS = 46  # of a name above a bar
DRAWN = 0.01  # of the maximum spread: below it indices over time say nothing


def _tile(
    width: float, height: float, *, left: float = 0.62, below: float = 0.3
) -> tuple[Figure, Axes]:
    figure = Picture(figsize=(width, height))
    size = 1.0 - (left + 0.16) / width, 1.0 - (below + 0.32) / height
    axis = figure.add_axes((left / width, below / height, *size))
    return figure, axis


def _title(axis: Axes, text: str, width: float, scale: Scale = PLAIN) -> None:
    """Write a title from the left edge of the tile, shortened to its width."""
    words = with_unit(text, scale, int(PER_INCH * width))
    axis.figure.text(0.06 / width, 0.985, words, va="top", fontsize=10, fontweight="bold")


def series_scale(name: str, series: Series) -> Scale:
    """Return the unit of a signal over time."""
    return scale_of(series.unit, [float(np.nanmax(np.abs(v))) for v in _lines(series) if _any(v)])


def _lines(series: Series) -> list[Any]:
    return [series.nominal, series.quantiles[LOW], series.quantiles[HIGH]]


def _any(values: Any) -> bool:
    return bool(np.isfinite(values).any())


def is_there(series: Series) -> bool:
    """Return whether a signal has values and moves or scatters."""
    return all(map(_any, _lines(series))) and any(
        np.nanmax(v) > np.nanmin(v) for v in _lines(series)
    )


@styled
def band_figure(name: str, series: Series, scale: Scale | None = None, title: str = "") -> Figure:
    """Return a signal over time: nominal, median, the range from 5 to 95 % shaded."""
    figure, axis = _tile(WIDE, 2.75, below=0.48)
    scale = scale or series_scale(name, series)
    time = series.time

    def shown(values: object) -> Any:
        return (np.asarray(values, float) - scale.zero) / scale.size

    low, high = shown(series.quantiles[LOW]), shown(series.quantiles[HIGH])
    look: Any = {"color": palette.BLUE, "alpha": 0.25, "lw": 0}
    axis.fill_between(time, low, high, label="5 .. 95 %", **look)
    axis.plot(time, shown(series.quantiles[MIDDLE]), color=palette.BLUE, label="median")
    axis.plot(time, shown(series.nominal), color=palette.ORANGE, ls="--", label="nominal")
    if np.nanmin(low) > 0.0 and np.nanmax(high) > 100.0 * np.nanmin(low):
        axis.set_yscale("log")
        axis.yaxis.set_major_formatter("{x:g}")
    axis.set_xlim(time[0], time[-1])
    axis.set_xlabel("time [s]")
    _title(axis, title or named(name), WIDE, scale)
    axis.legend(loc="best", handlelength=1.6)
    return figure


@styled
def distribution_figure(result: Study, name: str, title: str) -> Figure:
    """Return how often which values of a figure came out; those with the film lost apart."""
    figure, axis = _tile(NARROW, 2.0, left=0.16)
    scale = _draw_distribution(axis, result, name)
    _title(axis, title, NARROW, scale)
    return figure


@styled
def study_figure(result: Study, names: Sequence[str]) -> Figure:
    """Return the distributions of these figures next to each other."""
    rows, columns = -(-len(names) // ACROSS), 1 if len(names) == 1 else ACROSS
    shape: Any = (0.5 + 3.3 * columns, 0.5 + 2.4 * rows, rows, columns)
    figure, axes = new_figure(*shape, head=1, left=0.2, across=0.3, choose="outputs")
    for axis, name in zip(axes, names, strict=False):
        scale = _draw_distribution(axis, result, name)
        title = with_unit(named(name), scale, int(PER_INCH * NARROW))
        label(axis, title, "", "")
    for axis in axes[len(names) :]:
        axis.set_visible(False)
    words = f"{result.runs} runs; lines: 5, 50 and 95 %, dashed: nominal"
    heading(figure, f"{result.target}: {words}")
    return figure


def _draw_distribution(axis: Axes, result: Study, name: str) -> Scale:
    """Draw how often which values of a figure came out; return the unit they are drawn in."""
    band = result.figures[name]
    scale, values = band_scale(band), column(result.sample, name)
    assert values is not None
    sound = np.isfinite(values)
    lost = column(result.sample, LOST) if name != LOST else None
    shown = (values - scale.zero) / scale.size
    low, high = np.quantile(shown[sound], [0.005, 0.995])
    logarithmic = low > 0.0 and high > 30.0 * low
    count = int(np.clip(np.ceil(2.0 * sound.sum() ** (1.0 / 3.0)), 8, 32)) + 1  # Rice's rule
    ends = np.geomspace(low, high, count) if logarithmic else np.linspace(low, high, count)
    if not high > low:
        ends = np.linspace(low - 0.5, low + 0.5, 4)
    kept, is_lost = np.clip(shown[sound], ends[0], ends[-1]), None if lost is None else lost[sound]
    groups = [kept] if is_lost is None else [kept[is_lost < 0.5], kept[is_lost > 0.5]]
    colours, names = [palette.BLUE, palette.RED], ["film kept", "film lost"]
    colours, names = colours[: len(groups)], names[: len(groups)]
    axis.hist(groups, ends.tolist(), stacked=True, color=colours, label=names, alpha=0.75)
    if logarithmic:
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter("{x:g}")
    for level in (LOW, MIDDLE, HIGH):
        at = (band.quantiles[level] - scale.zero) / scale.size
        axis.axvline(at, color=palette.BLACK, lw=1.4 if level == MIDDLE else 0.9)
    if np.isfinite(band.nominal):
        at = (band.nominal - scale.zero) / scale.size
        axis.axvline(at, color=palette.ORANGE, lw=1.8, ls="--")
    axis.set_yticks([])
    axis.spines["left"].set_visible(False)
    if len(groups) > 1 and all(len(group) for group in groups):
        axis.legend(loc="best", handlelength=1.0)
    return scale


@styled
def bar_figure(found: Sequence[Share], title: str) -> Figure:
    """Return the largest shares as bars with their confidence, the name above each."""
    shown = [share for share in found if share.weight >= LEAST][:BARS] or list(found[:1])
    figure = Picture(figsize=(NARROW, 0.64 + 0.36 * len(shown)))
    tall = figure.get_figheight()
    axis = figure.add_axes((0.16 / NARROW, 0.32 / tall, 1.0 - 0.32 / NARROW, 1.0 - 0.62 / tall))
    by_rank = found[0].by == RANK
    for row, share in enumerate(shown):
        size = abs(share.value)
        colour = palette.PURPLE if by_rank and share.value < 0.0 else palette.BLUE
        half = min(share.half, 10.0)
        bar: Any = {"ecolor": palette.BLACK, "error_kw": {"elinewidth": 1.0, "capsize": 2.0}}
        axis.barh(row, size, 0.34, xerr=half, color=colour, alpha=0.85, **bar)
        words = shortened(joined(share.source), LETTERS)
        axis.text(0.0, row - 0.24, words, ha="left", va="bottom", fontsize=8.5)
    axis.set_ylim(len(shown) - 0.6, -0.85)
    axis.set_xlim(0.0, max(1.0, *(min(abs(s.value) + s.half, 1.5) for s in shown)))
    axis.set_yticks([])
    axis.spines["left"].set_visible(False)
    axis.grid(visible=False, axis="y")
    _title(axis, title, NARROW)
    return figure


@styled
def decided_over_time(name: str, series: Series, title: str = "") -> Figure | None:
    """Return the total indices of a signal over time, of the sources that decide most.

    Nothing is drawn where the spread is below DRAWN of its maximum; None where there is none.
    """
    low, high = series.quantiles[LOW], series.quantiles[HIGH]
    spread = np.nan_to_num(np.asarray(high) - np.asarray(low))
    seen = spread > DRAWN * spread.max()
    drawn = {
        source: np.where(seen, np.asarray(values, float), np.nan)
        for source, values in series.indices.items()
    }
    if not any(map(_any, drawn.values())):
        return None
    top = max(float(np.nanmax(values)) for values in drawn.values() if _any(values))
    figure, axis = _tile(WIDE, 3.2, left=0.45, below=0.95)
    weights = {
        source: float(np.nansum(np.clip(values, 0.0, 1.0))) for source, values in drawn.items()
    }
    ranked = sorted(weights, key=lambda source: -weights[source])[: len(COLOURS)]
    for source, colour in zip(ranked, COLOURS, strict=False):
        axis.plot(
            series.time,
            drawn[source],
            color=getattr(palette, colour),
            label=shortened(joined(source), 28),
        )
    axis.set_xlim(series.time[0], series.time[-1])
    axis.set_ylim(0.0, min(max(1.05, top), 1.5))
    axis.set_xlabel("time [s]")
    look = {"fontsize": 8, "handlelength": 1.4, "columnspacing": 1.0, "labelspacing": 0.25}
    figure.legend(loc="lower left", ncols=2, borderaxespad=0.2, **look)
    _title(axis, f"{title or named(name)}: total indices", WIDE)
    return figure
