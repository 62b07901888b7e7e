"""Lines of equal value over a map, each with its number."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

TRIED = 40  # places for a number along a line
FINE = 4  # pieces of an interval: lines have no kinks from the grid


def numbered_contours(
    axis: Axes, x: Any, y: Any, values: Any, levels: Sequence[float], colour: str
) -> list[float]:
    """Draw the lines that have room for their numbers; return their levels, rising.

    ``values`` (y, x); between them lines follow the monotone cubic through them. A number lies
    inside the axes and on no other one; the highest come first.
    """
    x, y, values = _refined(x, y, values)
    axis.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    axis.figure.canvas.draw()
    box, taken, named = axis.get_window_extent(), list[Any](), list[float]()
    whole = axis.contour(x, y, values, levels=levels)
    pieces = dict(zip(map(float, whole.levels), whole.allsegs, strict=True))
    whole.remove()
    for level in sorted(pieces, reverse=True):
        for piece in pieces[level]:
            for place in _places(piece):
                text = axis.text(*place, f"{level:g}", ha="center", va="center", fontsize=8)
                text.set_color(colour)
                own = text.get_window_extent().expanded(1.15, 1.3)
                inside = box.contains(*own.min) and box.contains(*own.max)
                if inside and not own.count_overlaps(taken):
                    look = {"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none"}
                    text.set_bbox({**look, "alpha": 0.85})
                    taken.append(own)
                    named.append(level)
                    break
                text.remove()
    found = sorted({*named})
    if found:
        axis.contour(x, y, values, levels=found, colors=colour)
    return found


def _refined(x: Any, y: Any, values: Any) -> tuple[Any, Any, Any]:
    """Return a map on a finer grid; as it is where values are missing."""
    from scipy.interpolate import PchipInterpolator

    if not np.isfinite(values).all() or min(len(x), len(y)) < 3:
        return x, y, values
    for axis, at in ((1, np.asarray(x, float)), (0, np.asarray(y, float))):
        places = np.interp(np.arange(FINE * (len(at) - 1) + 1) / FINE, np.arange(len(at)), at)
        values = PchipInterpolator(at, values, axis=axis)(places)
        x, y = (places, y) if axis else (x, places)
    return x, y, values


def _places(piece: Any) -> list[tuple[float, float]]:
    """Return points along a line, from its middle to its ends."""
    if len(piece) < 2:
        return []
    at = np.linspace(0.0, 1.0, TRIED)
    at = at[np.argsort(np.abs(at - 0.5), kind="stable")]
    size = np.ptp(piece, axis=0)
    steps = np.hypot(*(np.diff(piece, axis=0) / np.where(size > 0.0, size, 1.0)).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    return [
        (float(np.interp(s, along, piece[:, 0])), float(np.interp(s, along, piece[:, 1])))
        for s in at * along[-1]
    ]
