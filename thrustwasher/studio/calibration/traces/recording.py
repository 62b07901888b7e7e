"""Rows over time, checked, and cut into pieces where time jumps."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import ParameterError, suggestion
from ....model.spec import ModelSpec
from ....numerics.jit import Array

GAP = 20.0  # usual steps of time: a longer one parts two recordings, or is bridged
SHORT = 0.1  # s: a gap that is bridged, if the part is pressed at both ends or at none
BETWEEN = 10  # rows that are put into a gap
ON = 0.1  # of the largest load: the part is pressed above
LEAST_ROWS = 5  # of a recording, and of a piece of it
SLOW = 600.0  # s: a recording that lasts longer is doubted


@dataclass(frozen=True, kw_only=True)
class Traces:
    """Recordings over time that a model is fitted to."""

    columns: Mapping[str, str]  # that count, with their SI units
    measured: tuple[str, ...]  # those that are outputs
    needed: tuple[tuple[str, ...], ...]  # groups of columns; of each a recording has one
    spec: ModelSpec  # the model with the parameters of the test rig around it
    fit: Callable[..., Any]
    """Called with (part, columns by recording, fit=, errors=, ..., options of the test measured
    data set)."""


@dataclass(frozen=True, eq=False)
class Recording:
    """Rows over time, SI units; one that does not return or jump in time."""

    name: str
    time: Array  # (n,) [s], never falling
    inputs: Mapping[str, Array]  # (n,) each
    outputs: Mapping[str, Array]  # (n,) each; NaN where not measured
    gaps: tuple[slice, ...] = ()  # rows that were put into gaps

    @property
    def is_recorded(self) -> NDArray[np.bool_]:
        """Tell of each row if it was recorded, (n,)."""
        found = np.ones(len(self.time), bool)
        for gap in self.gaps:
            found[gap] = False
        return found


def recording(
    name: str, columns: Mapping[str, Any], known: Mapping[str, str], measured: Sequence[str]
) -> Recording:
    """Return the rows of one recording, which may still have jumps of time.

    Parameters
    ----------
    name : of the recording, for messages
    columns : ``time`` [s] and columns of its length, None or NaN where an output is not measured;
        one number stands for all rows
    known : SI unit of every column that counts
    measured : the names among them that are outputs

    Raises
    ------
    ParameterError : a column is unknown, of another length, or has a cell that is no number; no
        time, or too few rows
    """
    for key in columns:
        if key not in known:
            hint = suggestion(str(key), known, "did you mean {}? ")
            raise ParameterError(
                f"{name}: column {key} is not known; {hint}known: {', '.join(known)}"
            )
    if "time" not in columns:
        raise ParameterError(f"{name}: has no column time [s]; points without it are for calibrate")
    time = _column(name, "time", columns["time"], None)
    if len(time) < LEAST_ROWS:
        raise ParameterError(f"{name}: {len(time)} rows, allowed: {LEAST_ROWS} or more")
    found = {key: _column(name, key, x, len(time)) for key, x in columns.items() if key != "time"}
    for key, values in {"time": time, **found}.items():
        holes = ~np.isfinite(values)
        if key not in measured and holes.any():
            raise ParameterError(f"{name}: {key} of row {int(np.argmax(holes)) + 1} is missing")
    outputs = {key: x for key, x in found.items() if key in measured and np.isfinite(x).any()}
    inputs = {key: x for key, x in found.items() if key not in measured}
    return Recording(name, time, inputs, outputs)


def pieces(whole: Recording, pressing: str) -> list[Recording]:
    """Return the pieces between which time goes back or leaps, by more than 20 usual steps.

    A leap of 0.1 s or less is bridged where the part is pressed at both ends, or at none: by rows
    whose inputs lie straight in between and whose outputs are not measured.

    ParameterError names a row that is out of order, or next to which a piece is too short.

    Parameters
    ----------
    whole : rows of one recording
    pressing : the input that presses the part
    """
    steps = np.diff(whole.time)
    ahead = steps[steps > 0.0]
    if not len(ahead):
        raise ParameterError(f"{whole.name}: time does not rise, rising times [s] are required")
    usual = float(np.median(ahead))
    back = (steps < 0.0) & (steps > -GAP * usual)
    if back.any():
        row = int(np.argmax(back)) + 2
        raise ParameterError(
            f"{whole.name}: time goes back by {-steps[row - 2]:.4g} s at row {row}, too little for "
            "a new recording; put the rows in the order of their time"
        )
    leaps = steps > GAP * usual
    pressed = whole.inputs[pressing] > ON * float(whole.inputs[pressing].max())
    bridged = leaps & (steps <= SHORT) & (pressed[1:] == pressed[:-1])
    jumps = (steps < 0.0) | (leaps & ~bridged)
    ends = [0, *(np.flatnonzero(jumps) + 1).tolist(), len(whole.time)]
    found = []
    for k, (first, end) in enumerate(pairwise(ends)):
        if end - first < LEAST_ROWS:
            at = first if k else end
            step = steps[at - 1]
            raise ParameterError(
                f"{whole.name}: time jumps by {step:.4g} s before row {at + 1}, which leaves "
                f"{end - first} rows alone, allowed: {LEAST_ROWS} or more between two jumps; put "
                "the rows in the order of their time, or leave these out"
            )
        part = slice(first, end)
        piece = Recording(
            whole.name,
            whole.time[part],
            {key: x[part] for key, x in whole.inputs.items()},
            {key: x[part] for key, x in whole.outputs.items() if np.isfinite(x[part]).any()},
        )
        found.append(_bridged(piece, np.flatnonzero(bridged[first : end - 1]) + 1))
    return found


def _bridged(piece: Recording, behind: NDArray[np.int64]) -> Recording:
    """Return a piece with rows put into the gaps before the rows ``behind``."""
    if not len(behind):
        return piece
    share = np.arange(1, BETWEEN + 1) / (BETWEEN + 1.0)

    def between(x: Array) -> Array:
        low, high = x[behind - 1, None], x[behind, None]
        return np.insert(x, np.repeat(behind, BETWEEN), (low + share * (high - low)).ravel())

    def unknown(x: Array) -> Array:
        return np.insert(x, np.repeat(behind, BETWEEN), np.nan)

    starts = behind + BETWEEN * np.arange(len(behind))
    return Recording(
        piece.name,
        between(piece.time),
        {key: between(x) for key, x in piece.inputs.items()},
        {key: unknown(x) for key, x in piece.outputs.items()},
        tuple(slice(int(k), int(k) + BETWEEN) for k in starts),
    )


def measured_part(piece: Recording, output: str) -> Recording:
    """Return a piece from the first to the last row of a measured output.

    ParameterError: there are too few such rows.
    """
    known = np.flatnonzero(np.isfinite(piece.outputs.get(output, np.full(1, np.nan))))
    if len(known) < LEAST_ROWS:
        raise ParameterError(
            f"{piece.name}: {output} has {len(known)} values from {piece.time[0]:.6g} to "
            f"{piece.time[-1]:.6g} s, and slip is found by it; allowed: {LEAST_ROWS} or more, or a "
            "column speed"
        )
    first, end = int(known[0]), int(known[-1]) + 1
    gaps = (g for g in piece.gaps if first <= g.start and g.stop <= end)
    return Recording(
        piece.name,
        piece.time[first:end],
        {key: x[first:end] for key, x in piece.inputs.items()},
        {key: x[first:end] for key, x in piece.outputs.items()},
        tuple(slice(g.start - first, g.stop - first) for g in gaps),
    )


def row_scatter(values: Array) -> float:
    """Return the standard deviation of a row next to its neighbours; 0 where nothing scatters.

    From second differences, so that a signal that rises or falls does not count as scatter. The
    median keeps corners out; where most rows repeat their neighbour the mean square counts.
    """
    known = values[np.isfinite(values)]
    bends = np.abs(np.diff(known, 2))
    if not len(bends):
        return 0.0
    middle = float(np.median(bends)) / 0.6744897501960817
    return (middle or float(np.sqrt(np.mean(bends**2)))) / float(np.sqrt(6.0))


def _column(name: str, key: str, values: Any, length: int | None) -> Array:
    """Return a column as numbers, NaN for None."""
    try:
        column = np.asarray(values, float)
    except (TypeError, ValueError):
        raise ParameterError(f"{name}: {key} holds something that is no number") from None
    if length is not None and column.ndim == 0:
        column = np.full(length, float(column))
    if column.ndim != 1 or (length is not None and len(column) != length):
        raise ParameterError(
            f"{name}: {key} has the shape {column.shape}, allowed: one number per row"
            + (f" ({length})" if length else "")
        )
    if np.isinf(column).any():
        row = int(np.argmax(np.isinf(column))) + 1
        raise ParameterError(f"{name}: {key} of row {row} is infinite, allowed: finite numbers")
    return column
