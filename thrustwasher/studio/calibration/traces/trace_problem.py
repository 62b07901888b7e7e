"""Recordings and the parameters that are fitted to them."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ....errors import SolveError
from ....numerics.jit import Array
from ....units import format_quantity
from ..estimates import remarks
from ..fit import Asked, fitted
from ..identifiability import MOST_TOGETHER, counted, widening
from ..least_squares import FitProblem, Terms
from ..measured import output_units
from ..model_fit import misses, problem_of, values_of
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


def fit_traces(
    points: Traced,
    asked: Asked,
    names: tuple[str, ...],
    deviation: Array | None,
    errors: str,
    notes: Sequence[str],
) -> TraceCalibration:
    """Return parameters of a part fitted to means of its recordings.

    Parameters
    ----------
    points : the means, and the part that is stepped along them
    asked : bounds, confidence, profile
    names : parameters that are fitted
    deviation : (n,) of each value by its rows' own scatter, where it is known
    errors : what the standard deviations are, in words
    notes : what was read and how, sentences
    """
    problem, first = problem_of(
        points,
        names,
        asked.bounds,
        changes=points.matters,
        terms=Terms(error_name=errors, fidelity=points.plan.fidelity),
        starts=_decades_aside,
        input_shifts=partial(input_shifts, points),
        correlation=partial(_correlation, points),
    )
    _check_first(points, problem, first)
    found, judged = fitted(problem, first, asked.confidence, bool(asked.profile))
    off = problem.measured - found["fitted"]
    patterns = _patterns(points, off, deviation)
    units = output_units(points.plan.spec)
    far, poor = misses(points, problem, found["_best"], judged)
    said = [_shape_text(p, units[p.output]) for p in patterns if p.is_found]
    said += [*points.plan.warnings, *far, *poor, *_zero_offset(points, off)]
    return TraceCalibration(
        params=replace(points.plan.params[0], **values_of(found)).pack(),
        points=points,
        remarks=remarks(said, notes),
        patterns=patterns,
        engagements=points.n_engagements,
        **found,
    )


def _decades_aside(problem: FitProblem, first: Array) -> list[Array]:
    """Return places a decade aside for each constant that may lie anywhere over decades."""
    wide = problem.logarithmic & (problem.high - problem.low > MANY_DECADES)
    ways = [side * DECADE_ASIDE * row for row in np.eye(len(first))[wide] for side in (1.0, -1.0)]
    return [np.clip(first + way, problem.low, problem.high) for way in ways]


def input_shifts(points: Traced, problem: FitProblem, guess: Array) -> tuple[Array, Array] | None:
    """Return changes of the misfit by independent scatter of the inputs, and what they share.

    By 24 draws, the same in every run, of what recorded inputs scatter: a film remembers the
    force that pressed it, so scatter of the force is no scatter of torque that is independent
    from row to row. Where inputs follow from measured values, by each of these.
    """
    values = problem.values(guess)
    moved, shared = [], []
    if any(run.scatter.get(name) for run in points.runs for name in run.inputs):
        here = problem.curve(guess)
        rows = [points.shifted(seed).values(values) - here for seed in range(DRAWS)]
        kept = [row * problem.weight for row in rows if np.isfinite(row).all()]
        moved += [np.array(kept).T / max(len(kept), 1) ** 0.5] if kept else []
        shared += [np.zeros_like(x) for x in moved]
    if points.follows:
        computed, measured = points.follows(points, values)
        moved.append(computed * problem.weight[:, None])
        shared.append(-measured * problem.weight[:, None])
    return (np.hstack(moved), np.hstack(shared)) if moved else None


def _correlation(points: Traced, problem: FitProblem, guess: Array) -> float:
    """Return the correlation of neighbouring residuals, within recordings and outputs."""
    off = (problem.measured - problem.curve(guess)) * problem.weight
    return lag_one([x for name in points.names for x in points.parts(name, off)])


def _check_first(points: Traced, problem: FitProblem, first: Array) -> None:
    """Raise SolveError for the first recording that the part cannot be stepped along."""
    computed = problem.curve(first)
    if np.isfinite(computed).all():
        return
    failed = points.computed(problem.values(first))[1]
    i = int(np.argmin(np.isfinite(computed)))
    run = points.runs[int(points.run_of[i])]
    why = failed[int(points.row[i])].advice
    raise SolveError(f"{run.name}: the part cannot be stepped along it: {why}")


def _patterns(points: Traced, off: Array, deviation: Array | None) -> tuple[Pattern, ...]:
    """Return for each output how its residuals ``off`` (n,) follow each other."""
    return tuple(
        pattern_of(
            name,
            points.parts(name, off),
            points.parts(name, points.value),
            None if deviation is None else np.concatenate(points.parts(name, deviation)),
        )
        for name in points.names
    )


def _zero_offset(points: Traced, residuals: Array) -> tuple[str, ...]:
    """Return a hint where the torque of the open pack lies off that of the model."""
    own = points.is_open & points.of(TORQUE) if TORQUE in points.names else np.zeros(0, bool)
    if np.count_nonzero(own) < FEW:
        return ()
    off = residuals[own]
    size = np.ones(len(off)) if points.count is None else points.count[own]
    mean = float(np.average(off, weights=size))
    error = float(np.sqrt(np.average((off - mean) ** 2, weights=size) / len(off)))
    error *= widening(min(max(lag_one([off - mean]), 0.0), MOST_TOGETHER))
    largest = float(np.abs(points.value[points.of(TORQUE)]).max())
    if abs(mean) <= max(3.0 * error, OFFSET * largest):
        return ()
    share = f" ({100.0 * abs(mean) / largest:.2g} % of the largest torque)" if largest else ""
    return (
        f"With the open pack the recorded torque lies {mean:+.3g} N.m off the model's drag"
        f"{share}: if that is a zero offset of the sensor, give torque_offset, or fit it.",
    )


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
