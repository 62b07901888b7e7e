"""A sweep: its first outputs over the axis with most values, a line for each of the others.

Rows that are no grid, as random points, are a scatter matrix.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ....errors import ParameterError
from ....units import format_quantity
from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, label, legend_below, new_figure, styled
from ..target import chosen
from .matrix_plot import ROWS, matrix_figure, scaled

COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, BLACK, GREY)  # lines at most
PANELS = 4  # unless outputs are named


@styled
def sweep_figure(
    table: Any, *, outputs: str | Sequence[str] = (), over: str | Sequence[str] = (), **look: Any
) -> Figure:
    """Return the picture of a ``SweepTable``: lines on a grid, else a scatter matrix.

    Parameters
    ----------
    outputs : names of those to draw, each in a panel; none: the first that vary
    over : what was varied, to draw over; none: what has most values, of points up to six
    look : of the lines or points, as ``Axes.plot`` takes it

    Raises
    ------
    ParameterError : there is no number that varies, or a name is not known
    """
    axes = table.axes()
    wanted = chosen("outputs", outputs, [n for n in table.outputs() if _is_number(table[n])])
    shown = wanted or [name for name in table.outputs() if _varies(table[name])]
    across = chosen("over", over, axes)
    numbers = [name for name in across or axes if _is_number(table[name])]
    if not (numbers or (axes and not is_grid(table))) or not shown:
        raise ParameterError("plot: nothing varies in this table; allowed: a sweep over a number")
    if not is_grid(table):
        return matrix_figure(table, wanted or shown[:ROWS], across or axes, look)
    shown = wanted or shown[:PANELS]
    x_name = max(numbers, key=lambda name: len(np.unique(table[name])))
    others = [name for name in axes if name != x_name]
    keys = list(zip(*(table[name].tolist() for name in others), strict=True)) or [()] * len(table)
    lines = list(dict.fromkeys(keys))
    places = np.linspace(0, len(lines) - 1, min(len(lines), len(COLOURS))).round().astype(int)
    rows = 1 if len(shown) < 3 else -(-len(shown) // 2)
    foot = -(-len(places) // 4) if others else 0
    shape: Any = (10.4, 0.9 + 3.2 * rows, rows, -(-len(shown) // rows))
    figure, panels = new_figure(*shape, head=1, foot=foot, choose="outputs")
    x, words_across = scaled(table, x_name)
    for axis, name in zip(panels, shown, strict=False):
        y, up = scaled(table, name)
        for colour, place in zip(COLOURS, places, strict=False):
            mine = np.flatnonzero([key == lines[place] for key in keys])
            mine = mine[np.argsort(x[mine], kind="stable")]
            words = ", ".join(map(_worded, others, lines[place], map(table.units.get, others)))
            axis.plot(x[mine], y[mine], **{"color": colour, "label": words} | look)
        label(axis, name.replace("_", " "), words_across, up)
    for axis in panels[len(shown) :]:
        axis.set_visible(False)
    if others:
        legend_below(figure, *panels[0].get_legend_handles_labels(), columns=4)
    left = f", {len(places)} of {len(lines)} lines" if len(places) < len(lines) else ""
    heading(figure, f"{table.model or 'runs'}: {len(table)} points, {table.fidelity}{left}")
    return figure


def is_grid(table: Any) -> bool:
    """Return whether the rows are a grid of what was varied: each combination once.

    One number that goes up and down is points, too.
    """
    columns = [table[name] for name in table.axes()]
    if len(columns) == 1 and _is_number(columns[0]):
        steps = np.diff(columns[0])
        return bool(np.all(steps > 0.0) or np.all(steps < 0.0))
    rows = set(zip(*(column.tolist() for column in columns), strict=True))
    sizes = (len(set(column.tolist())) for column in columns)
    return len(rows) == len(table) == math.prod(sizes)


def _is_number(values: Any) -> bool:
    return bool(values.dtype.kind in "fi")


def _varies(values: Any) -> bool:
    known = values[np.isfinite(values)] if values.dtype.kind == "f" else values[:0]
    return bool(len(known) and np.ptp(known))


def _worded(name: str, value: Any, unit: str | None) -> str:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{name.replace('_', ' ')} {format_quantity(value, unit or '1') if is_number else value}"
