"""Recordings and the parameters that are fitted to them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....errors import SolveError
from ....numerics.jit import Array
from ....units import format_quantity
from ..identifiability import MOST_TOGETHER, Verdict, counted, widening
from ..measured import Measured, output_units
from ..model_fit import ModelProblem
from .binned import Run
from .patterns import Pattern, lag_one, pattern_of
from .recording import BETWEEN
from .trace_result import TraceCalibration
from .traced import Traced

TORQUE = "friction_torque"
FEW = 5  # means with the open pack that tell an offset
OFFSET = 0.002  # of the largest torque: a smaller offset is not worth a word
DRAWS = 24  # of the inputs' scatter: widths by it are good to 15 %
DECADE_ASIDE = 2.302585092994046  # of a logarithm
MANY_DECADES = 4.0 * DECADE_ASIDE


@dataclass(frozen=True, kw_only=True)
class TraceProblem(ModelProblem):
    """Means of recordings and a part's parameters."""

    points: Traced
    deviation: Array | None = None  # (n,) of each value by its rows' own scatter, where it is known
    error_name: str = "their error"
    notes: tuple[str, ...] = ()  # what was read and how, sentences

    @classmethod
    def change_of(cls, points: Measured, name: str) -> float:
        """Return a change of a parameter that would certainly matter; 0: as its range says."""
        return float(points.matters.get(name, 0.0)) if isinstance(points, Traced) else 0.0

    def starts(self, first: Array) -> list[Array]:
        """Return places a decade aside for each constant that may lie anywhere over decades."""
        wide = self.logarithmic & (self.high - self.low > MANY_DECADES)
        ways = [
            side * DECADE_ASIDE * row for row in np.eye(len(first))[wide] for side in (1.0, -1.0)
        ]
        return [np.clip(first + way, self.low, self.high) for way in ways]

    def input_shifts(self, guess: Array) -> tuple[Array, Array] | None:
        """Return changes of the misfit by independent scatter of the inputs, and what they share.

        By 24 draws, the same in every run, of what recorded inputs scatter: a film remembers the
        force that pressed it, so scatter of the force is no scatter of torque that is independent
        from row to row. Where inputs follow from measured values, by each of these.
        """
        points, values = self.points, self.values(guess)
        moved, shared = [], []
        if any(run.scatter.get(name) for run in points.runs for name in run.inputs):
            here = self.curve(guess)
            rows = [points.shifted(seed).computed(values)[0] - here for seed in range(DRAWS)]
            kept = [row * self.weight for row in rows if np.isfinite(row).all()]
            moved += [np.array(kept).T / max(len(kept), 1) ** 0.5] if kept else []
            shared += [np.zeros_like(x) for x in moved]
        if points.follows:
            computed, measured = points.follows(points, values)
            moved.append(computed * self.weight[:, None])
            shared.append(-measured * self.weight[:, None])
        return (np.hstack(moved), np.hstack(shared)) if moved else None

    def check_first(self, first: Array) -> None:
        """Raise SolveError for the first recording that the part cannot be stepped along."""
        computed = self.curve(first)
        if np.isfinite(computed).all():
            return
        failed = self.points.computed(self.values(first))[1]
        i = int(np.argmin(np.isfinite(computed)))
        run = self.points.runs[int(self.points.run_of[i])]
        why = failed[int(self.points.row[i])].advice
        raise SolveError(f"{run.name}: the part cannot be stepped along it: {why}")

    def drawn_over(self, output: str) -> dict[str, tuple[str, Array]]:
        """Return the time of every value, the recordings one after the other."""
        return {"time": ("s", _laid_out(self.points)[self.points.row])}

    def doubts(self) -> tuple[str, ...]:
        """Return what is doubtful about the recordings themselves."""
        return tuple(self.points.plan.warnings)

    def correlation(self, guess: Array) -> float:
        """Return the correlation of neighbouring residuals, within recordings and outputs."""
        off = (self.measured - self.curve(guess)) * self.weight
        parts = [x for name in self.points.names for x in self.points.parts(name, off)]
        return lag_one(parts)

    def patterns(self, best: Array) -> tuple[Pattern, ...]:
        """Return for each output how its residuals follow each other."""
        points, off = self.points, self.measured - self.curve(best)
        return tuple(
            pattern_of(
                name,
                points.parts(name, off),
                points.parts(name, self.measured),
                None
                if self.deviation is None
                else np.concatenate(points.parts(name, self.deviation)),
            )
            for name in points.names
        )

    def warnings(self, best: Array, first: Array, judged: list[Verdict]) -> tuple[str, ...]:
        """Return what is wrong with the fit as a whole, the gravest first."""
        units = output_units(self.points.plan.spec)
        shapes = (_shape_text(p, units[p.output]) for p in self.patterns(best) if p.is_found)
        return (*shapes, *super().warnings(best, first, judged), *self._zero_offset(best))

    def _zero_offset(self, best: Array) -> tuple[str, ...]:
        """Return a hint where the torque of the open pack lies off that of the model."""
        points, name = self.points, TORQUE
        own = points.is_open & points.of(name) if name in points.names else np.zeros(0, bool)
        if np.count_nonzero(own) < FEW:
            return ()
        off = (self.measured - self.curve(best))[own]
        size = np.ones(len(off)) if points.count is None else points.count[own]
        mean = float(np.average(off, weights=size))
        error = float(np.sqrt(np.average((off - mean) ** 2, weights=size) / len(off)))
        error *= widening(min(max(lag_one([off - mean]), 0.0), MOST_TOGETHER))
        largest = float(np.abs(self.measured[points.of(name)]).max())
        if abs(mean) <= max(3.0 * error, OFFSET * largest):
            return ()
        share = f" ({100.0 * abs(mean) / largest:.2g} % of the largest torque)" if largest else ""
        return (
            f"With the open pack the recorded torque lies {mean:+.3g} N.m off the model's drag"
            f"{share}: if that is a zero offset of the sensor, give torque_offset, or fit it.",
        )

    def result(
        self, params: Any, found: Mapping[str, Any], first: Array, judged: list[Verdict]
    ) -> TraceCalibration:
        """Return the calibration of parameters with fitted values; ``first`` are those before."""
        best = found["_best"]
        return TraceCalibration(
            params=params,
            points=self.points,
            warnings=self.warnings(best, first, judged),
            patterns=self.patterns(best),
            engagements=self.points.n_engagements,
            notes=self.notes,
            **found,
        )


def _laid_out(points: Traced) -> Array:
    """Return the times of all rows, each recording behind the one before."""
    parts, end = [], 0.0
    for run in points.runs:
        parts.append(run.time - run.time[0] + end)
        end = float(parts[-1][-1]) + 0.05 * float(run.time[-1] - run.time[0])
    return np.concatenate(parts)


def _shape_text(found: Pattern, unit: str) -> str:
    """Say that residuals hang together in time."""
    if not found.span:
        return (
            f"The recorded {found.output} is one number in all rows, the model's is not: is its "
            "channel connected, in this file and in this column?"
        )
    size = f"{found.size:.3g} {unit}".removesuffix(" 1")
    rows = ""
    if found.chi_square is not None and found.chi_square > 2.0:
        rows = f", {found.chi_square**0.5:.2g} times what single rows scatter"
    return (
        f"The model does not describe the time history of {found.output}: its residuals "
        f"hang together in "
        f"time ({found.runs} runs of one sign where chance gives {found.expected:.0f}, p = "
        f"{found.p_value:.1g}; {size}, {100.0 * found.size / found.span:.2g} % of its span{rows}). "
        "Another law or parameter is missing; no interval holds what that changes."
    )


def size_text(runs: tuple[Run, ...], engagements: int) -> str:
    """Say how many recordings and engagements were found, and how many rows became means."""
    rows, means = sum(run.n_rows for run in runs), sum(len(run.time) for run in runs)
    names = dict.fromkeys(run.name for run in runs)
    words = f"{counted(engagements, 'engagement')} in {counted(len(runs), 'recording')}"
    if len(names) != len(runs):
        words += f", parted where time jumps, of {', '.join(names)}"
    gaps = [gap for run in runs for gap in run.gaps]
    if gaps:
        words += (
            f", {counted(len(gaps), 'gap')} up to {format_quantity(max(gaps), 's')} bridged, load "
            "and slip straight in between"
        )
    if all(run.n_rows + BETWEEN * len(run.gaps) == len(run.time) for run in runs):
        return f"{words}; {rows} rows, each as it is"
    lost = sorted({name for run in runs for name in run.kept})
    kept = ", ".join(
        f"{100.0 * min(run.kept.get(name, 1.0) for run in runs):.4g} % of the variance of {name}"
        for name in lost
    )
    return f"{words}; {rows} rows are fitted as {means} means of neighbours, which keep {kept}"
