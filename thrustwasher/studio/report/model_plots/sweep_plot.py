"""A sweep: its first outputs over the axis with most values, a line for each of the others."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ....errors import ParameterError
from ....units import display_unit, format_quantity, pretty_unit
from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from ..style import heading, label, legend_below, new_figure, styled

COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, BLACK, GREY)  # lines at most
PANELS = 4


@styled
def sweep_figure(table: Any) -> Figure:
    """Return the picture of a ``SweepTable``.

    Raises
    ------
    ParameterError : there is no number that varies
    """
    outputs, axes = table.outputs(), table.axes()
    numbers = [name for name in axes if table[name].dtype.kind in "fi"]
    shown = [name for name in outputs if _varies(table[name])][:PANELS]
    if not numbers or not shown:
        raise ParameterError("plot: nothing varies in this table; allowed: a sweep over a number")
    over = max(numbers, key=lambda name: len(np.unique(table[name])))
    others = [name for name in axes if name != over]
    keys = list(zip(*(table[name].tolist() for name in others), strict=True)) or [()] * len(table)
    lines = list(dict.fromkeys(keys))
    places = np.linspace(0, len(lines) - 1, min(len(lines), len(COLOURS))).round().astype(int)
    rows = 1 if len(shown) < 3 else 2
    foot = -(-len(places) // 4) if others else 0
    figure, panels = new_figure(
        10.4, 0.9 + 3.2 * rows, rows, -(-len(shown) // rows), head=1, foot=foot
    )
    x, across = _scaled(table, over)
    for axis, name in zip(panels, shown, strict=False):
        y, up = _scaled(table, name)
        for colour, place in zip(COLOURS, places, strict=False):
            mine = np.array([key == lines[place] for key in keys])
            words = ", ".join(map(_worded, others, lines[place], map(table.units.get, others)))
            axis.plot(x[mine], y[mine], color=colour, label=words)
        label(axis, name.replace("_", " "), across, up)
    for axis in panels[len(shown) :]:
        axis.set_visible(False)
    if others:
        legend_below(figure, *panels[0].get_legend_handles_labels(), columns=4)
    left = f", {len(places)} of {len(lines)} lines" if len(places) < len(lines) else ""
    heading(figure, f"{table.model}: {len(table)} points, {table.fidelity}{left}")
    return figure


def _varies(values: Any) -> bool:
    known = values[np.isfinite(values)] if values.dtype.kind == "f" else values[:0]
    return bool(len(known) and np.ptp(known))


def _scaled(table: Any, name: str) -> tuple[Any, str]:
    """Return a column in the unit that a person reads, and the label of its axis."""
    values, unit = table[name].astype(float), table.units.get(name, "1")
    if unit == "K":
        return values - 273.15, f"{name.replace('_', ' ')} [°C]"
    shown, size = display_unit(float(np.nanmax(np.abs(values))), unit)
    words = pretty_unit(shown)
    return values / size, name.replace("_", " ") + (f" [{words}]" if words not in ("", "1") else "")


def _worded(name: str, value: Any, unit: str | None) -> str:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{name.replace('_', ' ')} {format_quantity(value, unit or '1') if is_number else value}"
