"""Computed against measured: blind, in the band of the scatter, and after a fit."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import binomtest, qmc

from ...errors import ParameterError, SolveError
from ...shown import Card, Line, Tabled
from ..evaluators.evaluator import Remark, texts
from ..jobs.progress import shown
from .data_set_file import KINDS, DataSet

Array = NDArray[np.float64]
DRAWS, NOISE, SEED = 64, 256, 1
BAND = (0.05, 0.95)
READ = 0.05  # of a measured value: what it counts for in a fit without reading errors


@dataclass(frozen=True)
class Comparison(Tabled):
    """Measured and computed values of a data set; ``judged``: those that the figures are of."""

    data_set: DataSet
    computed: Array
    low: Array
    """Lower end of the band: 5 % of scatter and reading error together."""
    high: Array
    judged: NDArray[np.bool_]
    fitted: Mapping[str, float]
    """Parameters that were fitted to the points that are not judged."""
    remarks: tuple[Remark, ...] = ()

    @property
    def warnings(self) -> tuple[str, ...]:
        """What of ``remarks`` is a warning, in words."""
        return texts(self.remarks, "warning")

    @property
    def deviations(self) -> Array:
        """Computed over measured less 1, of the points judged."""
        return (self.computed / self.data_set.measured - 1.0)[self.judged]

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which of the points judged lie in the band."""
        m = self.data_set.measured
        return ((self.low <= m) & (m <= self.high))[self.judged]

    @property
    def interval(self) -> tuple[float, float]:
        """Interval of 95 % of the share inside (Clopper & Pearson)."""
        found = binomtest(int(self.inside.sum()), len(self.inside)).proportion_ci()
        return float(found.low), float(found.high)

    def _columns(self) -> dict[str, Any]:
        own = ("computed", "low", "high", "judged")
        found = {"measured": self.data_set.measured, **{name: getattr(self, name) for name in own}}
        return {**self.data_set.inputs, **found}

    def _card(self) -> Card:
        found = self.to_dict()
        lines = [
            Line("points", str(found["points"]), "that are judged"),
            Line("kind", self.data_set.kind, KINDS[self.data_set.kind]),
            Line("mean_deviation", f"{100.0 * found['mean_deviation']:+.3g} %", "with its sign"),
            Line("largest_deviation", f"{100.0 * found['largest_deviation']:+.3g} %", ""),
            Line("inside_band", f"{100.0 * found['inside_band']:.3g} %", "of the points"),
            *(Line(name, f"{value:.4g}", "fitted") for name, value in self.fitted.items()),
        ]
        title = f"{self.data_set.name}: computed against {len(self.computed)} measured values"
        return Card(title, lines, (), self.warnings)

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON has of it; deviations have their signs, as on the page."""
        d = self.deviations
        return {
            "data_set": self.data_set.name,
            "kind": self.data_set.kind,
            "points": int(self.judged.sum()),
            "mean_deviation": float(np.mean(d)),
            "largest_deviation": float(d[np.argmax(np.abs(d))]),
            "mean_absolute_deviation": float(np.mean(np.abs(d))),
            "inside_band": float(self.inside.mean()),
            "inside_band_interval": self.interval,
            "fitted": dict(self.fitted),
            "measured": self.data_set.measured.tolist(),
            "computed": self.computed.tolist(),
            "low": self.low.tolist(),
            "high": self.high.tolist(),
            "judged": self.judged.tolist(),
        }


def compare(
    data_set: DataSet,
    *,
    fit: int = 0,
    draws: int = DRAWS,
    progress: bool | Callable[[int, int], None] | None = None,
) -> Comparison:
    """Return computed against measured values.

    Parameters
    ----------
    data_set : as ``load_data_set`` returns it
    fit : number of parameters, the first of the data set's own list, that are fitted to every
        second point in the order of ``vary``; 0: blind, nothing is fitted
    draws : of the scatter, for the band
    progress : True: a bar of tqdm, or a line, on the terminal; or called with draws done and all

    Raises
    ------
    ParameterError : ``fit`` is more than the measured data set lists, or leaves no point to judge
    SolveError : a point has no solution
    """
    if not 0 <= fit <= len(data_set.fit):
        raise ParameterError(
            f"fit = {fit}, allowed: 0 .. {len(data_set.fit)}, the parameters that the measured "
            f"data set lists"
        )
    judged = np.ones(len(data_set.measured), bool)
    fitted: dict[str, float] = {}
    if fit:
        order = np.argsort(data_set.inputs[data_set.vary], kind="stable")
        judged[order[::2]] = False
        if judged.sum() < 1 or (~judged).sum() < fit:
            raise ParameterError(
                f"fit = {fit}, allowed with {len(judged)} points: at most half of them"
            )
        fitted = _fitted(data_set, data_set.fit[:fit], ~judged)
    computed = values_of(data_set, fitted)
    if not np.isfinite(computed).all():
        row = int(np.flatnonzero(~np.isfinite(computed))[0])
        why = data_set.evaluator.why({**data_set.rows[row % len(data_set.rows)], **fitted})
        raise SolveError(
            f"measured data set {data_set.name}: point {row + 1} has no solution here"
            + (f": {why}" if why else "")
        )
    show = shown(progress, data_set.texts["title"])
    low, high, lost = _band(data_set, fitted, computed, draws, show)
    said = tuple(Remark("warning", t, data_set.name) for t in (data_set.not_measured, lost) if t)
    return Comparison(data_set, computed, low, high, judged, fitted, said)


def values_of(data_set: DataSet, changes: Mapping[str, Any]) -> Array:
    """Return what is computed with changed parameters, a value per point; NaN without solution."""
    rows = [{**row, **changes} for row in data_set.rows]
    return data_set.evaluator.evaluate(rows, data_set.figures, "shown").values.T.ravel()  # type: ignore[no-any-return]


def _band(
    data_set: DataSet,
    fitted: Mapping[str, float],
    computed: Array,
    draws: int,
    progress: Callable[[int, int], None] | None,
) -> tuple[Array, Array, str]:
    """Return the ends of the band of scatter and reading error, and what is to be said of it.

    What was fitted scatters no more; the conditions of the points do not scatter.
    """
    scatter, known = data_set.evaluator.scattered(), data_set.evaluator.quantities
    kept = [
        s
        for s in scatter.sources
        if s.place.name in known and not known[s.place.name].is_input and s.place.name not in fitted
    ]
    rng = np.random.default_rng(SEED)
    rows = [computed]
    if kept:
        scatter = replace(scatter, sources=tuple(kept), pairs=())
        u = qmc.Sobol(len(kept), seed=SEED).random(draws)
        for i, draw in enumerate(scatter.values(u)):
            rows.append(values_of(data_set, {**draw, **fitted}))
            if progress:
                progress(i + 1, draws)
    sample = np.array(rows[1:] or rows)
    good = sample[np.isfinite(sample).all(axis=1)]
    lost = len(sample) - len(good)
    if not len(good):
        good = computed[None]
    noise = rng.standard_normal((NOISE, 1, len(computed))) * data_set.error
    low, high = np.quantile((good + noise).reshape(-1, len(computed)), BAND, axis=0)
    words = f"{lost} of {len(sample)} draws have no solution and are left out"
    return low, high, words if lost else ""


def _fitted(data_set: DataSet, names: Sequence[str], used: NDArray[np.bool_]) -> dict[str, float]:
    """Return the parameters that lie nearest to the measured values in least squares."""
    places = data_set.evaluator.quantities
    for name in names:
        if name not in places:
            raise ParameterError(
                f"measured data set {data_set.name}: fit has {name!r}, which is no parameter here"
            )
    own = [places[name] for name in names]
    start = np.array([float(p.nominal) for p in own])
    scale = np.where(start != 0.0, np.abs(start), np.array([p.high - p.low for p in own]) * 0.1)
    bounds = np.array([(p.low, p.high) for p in own]).T
    weight = np.where(data_set.error > 0.0, data_set.error, READ * np.abs(data_set.measured))

    def off(x: Array) -> Array:
        values = values_of(data_set, dict(zip(names, (x * scale).tolist(), strict=True)))
        gap = (values - data_set.measured) / weight
        return np.where(np.isfinite(gap), gap, 1e3)[used]

    found = least_squares(
        off, start / scale, bounds=(bounds[0] / scale, bounds[1] / scale), diff_step=1e-4
    )
    return dict(zip(names, (found.x * scale).tolist(), strict=True))
