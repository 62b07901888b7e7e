"""Points of a sweep that are no grid: outputs over what was varied, never joined by lines."""

from collections.abc import Sequence
from copy import copy
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....errors import Status
from ....units import display_unit, pretty_unit
from ..palette import BLACK, BLUE, CELSIUS, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, legend_below, new_figure

ROWS, COLUMNS = 3, 6  # unless they are named
SOUND, FAILED = (ORANGE, PURPLE, GREEN, SKY), (RED, BLACK, GREY)  # of statuses; OK is blue
LETTERS = 13.0  # of a label in an inch
DECADES, LOWER = 100.0, 0.2  # ends differ more, and the median lies below: a logarithmic axis
LARGEST = 4.5  # a point's width
WIDTH, GOLDEN = 0.5, 0.6180339887  # points of a word, next to each other
EDGE = 0.03  # of a panel's height: where points without a value stand
MOST_SHARP = 2000  # points: more are a bitmap in a file of lines


def matrix_figure(
    table: Any, outputs: Sequence[str], over: Sequence[str], look: dict[str, Any]
) -> Figure:
    """Return a panel for each output and each of what was varied, colour by status.

    Points without a value of the output stand as crosses at the lower edge.
    """
    shown = list(over)[:COLUMNS]
    rows, columns = len(outputs), len(shown)
    width, high = (10.4, 1.9) if columns > 2 else (0.9 + 4.2 * columns, 3.0)
    letters = int(LETTERS * (width - 1.0) / columns - 2.0)
    marks = _marks(table)
    across, foot = [fill(scaled(table, name)[1], letters) for name in shown], -(-len(marks) // 4)
    foot += max(words.count("\n") for words in across)
    shape: Any = (width, 1.0 + high * rows, rows, columns)
    gaps: Any = {"across": 0.16, "down": 0.2, "top": 0.2, "sharex": "col", "sharey": "row"}
    figure, panels = new_figure(*shape, head=1, foot=foot, choose="outputs and over", **gaps)
    for i, axis in enumerate(panels):
        row, column = divmod(i, columns)
        (x, _), (y, up) = scaled(table, shown[column]), scaled(table, outputs[row])
        if not _is_number(table[shown[column]]):
            x = x + WIDTH * ((GOLDEN * np.arange(len(x))) % 1.0 - 0.5)  # side by side
        _draw_points(axis, x, y, marks, look)
        _scale(axis, table, shown[column], x, columns)
        if _is_wide(y):
            axis.set_yscale("log")
        if row == rows - 1:
            axis.set_xlabel(across[column])
        if column == 0:
            axis.set_ylabel(fill(up, int(LETTERS * high)))
    drawn, names = panels[0].get_legend_handles_labels()
    handles = [copy(line) for line in drawn]
    for handle in handles:
        handle.set(markersize=LARGEST, alpha=1.0)
    legend_below(figure, handles, names, columns=4)
    left = f", over {columns} of {len(over)} that vary" if columns < len(over) else ""
    heading(figure, f"{table.model or 'runs'}: {len(table)} points, {table.fidelity}{left}")
    return figure


def _marks(table: Any) -> dict[str, tuple[str, Any]]:
    """Return colour and rows of each status, OK first, failed ones last, by number."""
    failed, statuses = table.failures, table["status"]
    names = sorted(table.counts, key=lambda n: (n in failed, n != Status.OK.name, -table.counts[n]))
    sound = iter(SOUND * len(names))
    bad = iter(FAILED * len(names))
    colours = [
        BLUE if name == Status.OK.name else next(bad if name in failed else sound) for name in names
    ]
    return {n: (colour, statuses == n) for n, colour in zip(names, colours, strict=True)}


def _draw_points(
    axis: Axes, x: Any, y: Any, marks: dict[str, tuple[str, Any]], look: dict[str, Any]
) -> None:
    size = float(np.clip(90.0 / np.sqrt(len(x)), 1.5, LARGEST))
    crossed = {"marker": "x", "mew": min(1.0, 0.3 * size), "ms": 1.2 * size}
    common: Any = {
        "ls": "",
        "ms": size,
        "mew": 0.0,
        "alpha": 0.7,
        "rasterized": len(x) > MOST_SHARP,
    }
    for name, (colour, own) in marks.items():
        there, words = own & np.isfinite(y), f"{name.replace('_', ' ')}: {np.sum(own)}"
        cross = {"marker": "o"} if there.any() else crossed
        more = {**common, "color": colour, "label": words, **cross, **look}
        axis.plot(x[there], y[there], **more)
        lost = own & ~there
        if lost.any():
            more |= {**crossed, "label": None, "clip_on": False}
            place = np.full(np.sum(lost), EDGE)
            axis.plot(x[lost], place, transform=axis.get_xaxis_transform(), **more)


def _scale(axis: Axes, table: Any, name: str, x: Any, columns: int) -> None:
    """Set scale and ticks of what was varied; words stand at whole numbers."""
    if not _is_number(table[name]):
        words = list(dict.fromkeys(table[name].tolist()))
        axis.set_xticks(range(len(words)), [str(word) for word in words])
        axis.set_xlim(-0.5, len(words) - 0.5)
    elif _is_wide(x):
        axis.set_xscale("log")
    else:
        axis.locator_params(axis="x", nbins=3 if columns > 3 else 5)


def _is_number(values: Any) -> bool:
    return bool(values.dtype.kind in "fi")


def _is_wide(values: Any) -> bool:
    """Return whether values above 0 spread over decades, most of them near the lower end."""
    known = values[np.isfinite(values)]
    if not len(known) or known.min() <= 0.0 or known.max() <= DECADES * known.min():
        return False
    return bool(np.median(known) - known.min() < LOWER * np.ptp(known))


def scaled(table: Any, name: str) -> tuple[Any, str]:
    """Return a column in the unit that a person reads, and the label of its axis.

    Words are numbered in the order in which they first come.
    """
    values, unit, words = table[name], table.units.get(name, "1"), name.replace("_", " ")
    if not _is_number(values):
        places = {word: i for i, word in enumerate(dict.fromkeys(values.tolist()))}
        return np.array([places[word] for word in values.tolist()], float), words
    values = values.astype(float)
    if unit == "K":
        return values - CELSIUS, f"{words} [°C]"
    shown, size = display_unit(float(np.nanmax(np.abs(values))), unit)
    pretty = pretty_unit(shown)
    return values / size, words + (f" [{pretty}]" if pretty not in ("", "1") else "")
