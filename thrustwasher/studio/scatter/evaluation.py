"""From the numbers of all runs of a study to its result."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from ...errors import SolveError
from ...model.quantity import Figure
from ..evaluators.evaluator import Array, Codes
from .estimates import (
    LEAST_BOUNDED,
    LEVELS,
    index_confidence,
    probability_bounds,
    quantile_bounds,
    quantiles,
    sobol_indices,
)
from .linear import doubts_of_linear, linear_deviations
from .result import Band, Index, Probability, ScatterResult, Series, SourceLine
from .study import Study

NONE = Index(first=None, total=None, confidence=None, first_confidence=None, total_confidence=None)
NO_EFFECT = Index(first=0.0, total=0.0, confidence=0.0, first_confidence=0.0, total_confidence=0.0)


class Runs:
    """The numbers of a study's runs, base points first."""

    def __init__(self, study: Study, numbers: Array, codes: Codes) -> None:
        self.study, self.target, self.design = study, study.target, study.design
        shape = self.design.n, self.design.rows_per_point, -1
        self.numbers = numbers.reshape(shape)
        self.base = self.numbers[:, 0]
        """(N, m)"""
        self.base_codes: Codes = codes.reshape(shape[:2])[:, 0]
        self.codes = codes
        reasons = self.target.reasons
        counts = Counter(reasons[code - 1] for code in codes[codes > 0].tolist())
        self.failed = dict(counts.most_common())

    def result(self, *, reached: str, seed: int, warnings: tuple[str, ...]) -> ScatterResult:
        """Return what the runs say."""
        target, scatter = self.target, self.target.scatter
        error = target.evaluator.error()
        linear = linear_deviations(target) if target.kind == "part" else {}
        try:
            nominal = target.nominal()
        except SolveError as problem:
            nominal = np.full(self.base.shape[1], np.nan)
            warnings = (*warnings, f"the nominal run has no solution: {problem}")
        sample = self.sample()
        n_figures = len(target.figures)
        at = quantiles(self.base)
        indices = self._indices(n_figures)
        figures = {
            figure.name: replace(
                self._band(figure, i, float(nominal[i]), at[:, i], indices[i], error),
                linear_deviation=_finite(linear.get(figure.name)),
            )
            for i, figure in enumerate(target.figures)
        }
        probabilities = {
            name: _probability(self.base[:, n_figures + i])
            for i, name in enumerate(target.outcomes)
        }
        return ScatterResult(
            target=target.name,
            kind=target.kind,
            runs=self.design.n,
            solves=self.design.n_rows,
            failed=self.failed,
            reached=reached,
            seed=seed,
            sources=tuple(
                SourceLine(s.place.name, s.law.words(), s.reason, s.place.nominal)
                for s in scatter.sources
            ),
            figures=figures,
            probabilities=probabilities,
            series=dict(self._series(nominal, at)),
            nearest={f.name: self._nearest(i, at[:, i], sample) for i, f in self._present(at)},
            sample=sample,
            units=self.units,
            groups=tuple(self._joined(group) for group in scatter.groups),
            warnings=(
                *(*scatter.warnings, *warnings, *self._warnings(figures)),
                *doubts_of_linear(figures, probabilities),
            ),
            correlations=tuple(
                (scatter.names[i], scatter.names[k], float(scatter.correlation[i, k]))
                for i, k in np.argwhere(np.triu(scatter.correlation, 1))
            ),
            model=getattr(target.evaluator, "model", ""),
            setting=target.setting,
            notes=target.notes,
        )

    def sample(self) -> dict[str, Any]:
        """Return the base runs as columns: sources, figures, outcomes, status."""
        target = self.target
        rows = target.scatter.values(self.design.a)
        columns: dict[str, Any] = {}
        for source in target.scatter.sources:
            values = [row[source.place.name] for row in rows]
            columns[source.place.name] = values if source.place.choices else np.array(values)
        names = [*(f.name for f in target.figures), *target.outcomes]
        for i, name in enumerate(names):
            columns[name if name not in columns else f"{name} (result)"] = self.base[:, i].copy()
        words = ("OK", *target.reasons)
        columns["status"] = [words[code] for code in self.base_codes.tolist()]
        return columns

    @property
    def units(self) -> dict[str, str]:
        """Units of the sample's columns."""
        sources = {s.place.name: s.place.unit for s in self.target.scatter.sources}
        return {f.name: f.unit for f in self.target.figures} | sources

    def _band(
        self,
        figure: Figure,
        i: int,
        nominal: float,
        at: Array,
        indices: tuple[dict[str, Index], int],
        error: Any,
    ) -> Band:
        values = self.base[:, i]
        there = values[np.isfinite(values)]
        outside = None
        if np.isfinite([figure.low, figure.high]).any():
            beyond = ((values < figure.low) | (values > figure.high)) * 1.0
            outside = _probability(np.where(np.isnan(values), np.nan, beyond))
        absent = int(np.isnan(values[self.base_codes == 0]).sum())
        return Band(
            nominal=nominal,
            quantiles=dict(zip(LEVELS, at.tolist(), strict=True)),
            confidence={level: quantile_bounds(values, level) for level in LEVELS},
            mean=float(there.mean()) if len(there) else np.nan,
            standard_deviation=float(there.std(ddof=1)) if len(there) > 1 else np.nan,
            indices=indices[0],
            left_out=indices[1],
            absent=absent,
            unit=figure.unit,
            relative=figure.relative,
            help=figure.help,
            usual=(figure.low, figure.high),
            outside=outside,
            error=error.get(figure.name),
        )

    @property
    def _names(self) -> list[str]:
        """Names of the groups that are exchanged."""
        return [self._joined(group) for group in self.design.groups]

    def _joined(self, group: tuple[int, ...]) -> str:
        return " + ".join(self.target.scatter.names[i] for i in group)

    def _indices(self, n_figures: int) -> list[tuple[dict[str, Index], int]]:
        """Return the indices of each figure by source, and how many base points they leave out."""
        nothing: list[tuple[dict[str, Index], int]] = [({}, 0)] * n_figures
        if not self.design.groups:
            return nothing
        target, names = self.target, self._names
        without = [self._joined(g) for g in target.scatter.groups]
        without = [name for name in without if name not in names]
        known = [
            i
            for i, figure in enumerate(target.figures)
            if self.study.costly or figure.name not in target.costly
        ]
        if not known:
            return nothing
        a, b, ab = self._exchanged(known)
        first, total, left_out = sobol_indices(a, b, ab)
        halves = index_confidence(a, b, ab)
        for column, i in enumerate(known):
            found = {
                name: _index(*(float(x[g, column]) for x in (first, total, *halves)))
                for g, name in enumerate(names)
            }
            varies = any(index.total is not None for index in found.values())
            found |= dict.fromkeys(without, NO_EFFECT if varies else NONE)
            order = [self._joined(g) for g in target.scatter.groups]
            nothing[i] = ({name: found[name] for name in order}, int(left_out[column]))
        return nothing

    def _exchanged(self, columns: list[int] | slice) -> tuple[Array, Array, Array]:
        """Return what A, B (N, m) and AB (G, N, m) gave."""
        found = self.numbers[:, :, columns]
        return found[:, 0], found[:, 1], np.moveaxis(found[:, 2:], 1, 0)

    def _series(self, nominal: Array, at: Array) -> Iterator[tuple[str, Series]]:
        """Yield each signal with its bands over time."""
        n_t = len(self.target.time)
        start = len(self.target.figures) + len(self.target.outcomes)
        for name in self.target.series:
            where, start = slice(start, start + n_t), start + n_t
            indices = {}
            if self.design.groups:
                total = sobol_indices(*self._exchanged(where)).total
                indices = dict(zip(self._names, total, strict=True))
            yield (
                name,
                Series(
                    time=self.target.time,
                    nominal=nominal[where],
                    quantiles=dict(zip(LEVELS, at[:, where], strict=True)),
                    indices=indices,
                    unit=self.target.evaluator.signals[name],
                ),
            )

    def _present(self, at: Array) -> Iterator[tuple[int, Figure]]:
        """Yield the figures that some run has."""
        yield from (
            (i, f) for i, f in enumerate(self.target.figures) if np.isfinite(at[:, i]).all()
        )

    def _nearest(self, i: int, at: Array, sample: dict[str, Any]) -> dict[float, dict[str, Any]]:
        """Return the sources' values of the base run nearest to each quantile of a figure."""
        found = {}
        for level, value in zip(LEVELS, at.tolist(), strict=True):
            row = int(np.nanargmin(np.abs(self.base[:, i] - value)))
            found[level] = {name: _plain(sample[name][row]) for name in self.target.scatter.names}
        return found

    def _warnings(self, figures: dict[str, Band]) -> Iterator[str]:
        n, failed = self.design.n, int((self.base_codes > 0).sum())
        if self.failed:
            words = ", ".join(f"{count} {reason}" for reason, count in self.failed.items())
            text = (
                f"{sum(self.failed.values())} of {len(self.codes)} runs failed ({words}), "
                f"{failed} of them of the {n} base runs: confidence of quantiles and "
                "probabilities has these at either end"
            )
            points = int((self.codes.reshape(n, -1) > 0).any(1).sum())
            text += f"; indices leave out {points} of {n} base points" if self.design.groups else ""
            why = (self.target.evaluator.why(row) for row in self._failed_base())
            example = next(filter(None, why), "")
            yield f"{text}; for example: {example}" if example else text
        every = [f.name for f in self.target.figures]
        yield from self.target.evaluator.doubts(every, self.base[:, : len(every)])
        for absent in sorted({band.absent for band in figures.values()} - {0}):
            names = ", ".join(name for name, band in figures.items() if band.absent == absent)
            yield f"{absent} of {n} base runs have no {names}: quantiles are of the others"
        if n < LEAST_BOUNDED:
            yield (
                f"runs = {n}: fewer than {LEAST_BOUNDED} cannot bound 5 and 95 % quantiles with "
                "95 % confidence; the minimum and the maximum value are given"
            )

    def _failed_base(self) -> list[dict[str, Any]]:
        """Return the values of the base runs that failed."""
        rows = self.target.scatter.values(self.design.a)
        return [row for row, code in zip(rows, self.base_codes, strict=True) if code]


def _index(first: float, total: float, first_half: float, total_half: float) -> Index:
    """Return an index; None where nothing varies."""
    if not np.isfinite([first, total]).all():
        return NONE
    return Index(
        first=first,
        total=total,
        confidence=max(first_half, total_half),
        first_confidence=first_half,
        total_confidence=total_half,
    )


def _finite(value: float | None) -> float | None:
    return value if value is not None and np.isfinite(value) else None


def _probability(values: Array) -> Probability:
    """Return the probability of 1 among 0 and 1; NaN: a run that does not say."""
    known = values[~np.isnan(values)]
    value = float(known.mean()) if len(known) else float("nan")
    low, high = probability_bounds(values)
    return Probability(value=value, low=low, high=high)


def _plain(value: object) -> Any:
    """Return a Python number, word or truth."""
    return value.item() if isinstance(value, np.generic) else value
