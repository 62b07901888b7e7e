"""Rows of a long recording that say the same, taken together before a model is fitted to them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array
from ..evaluators.evaluator import Rows
from ..sweep.sweep_plan import Plan
from .measured import Measured

MOST_ROWS = 1000  # that are solved one by one
GROUPS = 256  # a power of 2
SAMPLE = 8  # rows of a group that show how far its outputs are from straight


@dataclass(frozen=True)
class Groups:
    """Means of groups of rows, and some rows of each group."""

    means: Measured
    sample: Measured  # of rows, SAMPLE per group and output
    middle: Measured  # of the means of these rows
    base: Array
    """(values,) measured means, as they are."""

    def straightened(self, changes: Mapping[str, float]) -> Measured:
        """Return the means less what the model's curvature adds to a mean over a group.

        It is the mean of the outputs less the output at the mean of the inputs, over the sample.
        """
        rows = self.sample.values(changes).reshape(-1, SAMPLE)
        bend = rows.mean(axis=1) - self.middle.values(changes)
        value = self.base - np.where(np.isfinite(bend), bend, 0.0)
        return replace(self.means, value=value)


def grouped(points: Measured) -> Groups | None:
    """Return long recordings as means of groups of neighbouring rows, with a line that says so.

    The rows are halved again and again at the median of the input that is spread most over its
    range, so that groups hold the same number of rows. Means count by the number of their rows.
    None where there are few rows, or where they have parameters of their own or lack an output.
    """
    plan, names = points.plan, points.names
    n = plan.n_rows
    whole = len(points.value) == n * len(names) and len(plan.params) == 1
    if n <= MOST_ROWS or not whole or len(plan.starts) != n + 1:
        return None
    group = _halved(plan.inputs)
    size = np.bincount(group)
    inputs = _means(plan.inputs, group, size)
    shown: dict[str, Any] = {
        name: _means(np.asarray(column, float)[:, None], group, size)[:, 0]
        for name, column in plan.shown.items()
    }
    value, error, count, output = [], [], [], list[str]()
    for name in names:
        own = points.of(name)
        value.append(_means(points.value[own][:, None], group[points.row[own]], size)[:, 0])
        count.append(size.astype(float))
        output += [name] * len(size)
        if points.error is not None:
            variance = points.error[own][:, None] ** 2
            error.append(np.sqrt(_means(variance, group[points.row[own]], size)[:, 0] / size))
    kept = _kept_share(plan.inputs, inputs, size)
    shares = ", ".join(
        f"{100.0 * share:.4g} % of the variance of {s.name}"
        for s, share in zip(plan.spec.inputs, kept, strict=True)
        if share < 1.0
    )
    said = (
        f"{n} rows are fitted as {len(size)} means of {size.min()} to {size.max()} neighbouring "
        f"rows" + (f", which keep {shares}" if shares else "")
    )
    means = Measured(
        _plan(points, inputs, shown, said),
        np.tile(np.arange(len(size)), len(names)),
        tuple(output),
        np.concatenate(value),
        np.concatenate(error) if error else None,
        np.concatenate(count),
    )
    order, first = np.argsort(group, kind="stable"), np.cumsum(size) - size
    chosen = order[first[:, None] + (np.arange(SAMPLE) * (size[:, None] - 1)) // (SAMPLE - 1)]
    rows = plan.inputs[chosen]  # (groups, SAMPLE, inputs)
    sample = points_at(points, rows.reshape(-1, rows.shape[2]), names)
    return Groups(means, sample, points_at(points, rows.mean(axis=1), names), means.value)


def points_at(points: Measured, inputs: Array, names: tuple[str, ...]) -> Measured:
    """Return points with these inputs, at which outputs are computed, none measured."""
    n = len(inputs)
    output = tuple(name for name in names for _ in range(n))
    return Measured(
        _plan(points, inputs, {}, ""),
        np.tile(np.arange(n), len(names)),
        output,
        np.zeros(n * len(names)),
        None,
    )


def _plan(points: Measured, inputs: Array, shown: dict[str, Any], said: str) -> Plan:
    """Return the plan of other rows, all with the same parameters."""
    plan = points.plan
    assert plan.rows is not None
    columns = {s.name: inputs[:, i] for i, s in enumerate(plan.spec.inputs)}
    same = {n: x[0] for n, x in plan.rows.columns.items() if n not in columns}
    starts = np.arange(len(inputs) + 1)
    return replace(
        plan,
        rows=Rows(columns=columns, starts=starts, held={**plan.rows.held, **same}),
        columns=columns,
        shown=shown,
        starts=starts,
        params_of=np.zeros(len(inputs), np.int64),
        warnings=(*plan.warnings, *filter(None, [said])),
    )


def _halved(inputs: Array) -> NDArray[np.int64]:
    """Return the group of each row."""
    scale = np.ptp(inputs, axis=0)
    scaled = inputs / np.where(scale > 0.0, scale, 1.0)
    group = np.zeros(len(inputs), np.int64)
    parts = [np.arange(len(inputs))]
    while len(parts) < GROUPS:
        halves = []
        for part in parts:
            wide = int(np.argmax(np.ptp(scaled[part], axis=0)))
            order = part[np.argsort(scaled[part, wide], kind="stable")]
            halves += [order[: len(order) // 2], order[len(order) // 2 :]]
        parts = halves
    for i, part in enumerate(parts):
        group[part] = i
    return group


def _means(columns: Array, group: NDArray[np.int64], size: NDArray[np.int64]) -> Array:
    """Return the means of columns over groups; exact where a group has one value."""
    first = np.zeros((len(size), columns.shape[1]))
    first[group[::-1]] = columns[::-1]
    rest = [np.bincount(group, c) for c in (columns - first[group]).T]
    return np.asarray(first + np.array(rest).T / size[:, None])


def _kept_share(inputs: Array, means: Array, size: NDArray[np.int64]) -> Array:
    """Return the variance of each input between groups over that between rows; 1 if it has none."""
    centre = inputs.mean(axis=0)
    rows = ((inputs - centre) ** 2).sum(axis=0)
    between = (size[:, None] * (means - centre) ** 2).sum(axis=0)
    flat = np.ptp(inputs, axis=0) == 0.0
    return np.where(flat, 1.0, between / np.where(rows > 0.0, rows, 1.0))
