"""The clutch's friction law fitted to measured coefficients of friction.

The law's curve over slip speed is mu_inf + (mu_0 - mu_inf) e(v; stick_speed, decay_speed), with
mu_0 = k P(x) + D(x, N) and mu_inf = k P(x) + D(x, N) S_inf. So the best of measurements tells four
numbers, and plough_weight k, shear_floor S_inf, hardness_ratio N and indentation x act through two
of them: at most two of these four can be fitted at once. Load does not act at all.

``friction_data`` of the pack says what the law describes. "total": the points as they are.
"boundary": the points less the shear of the settled film, at their ``oil_temperature``. A table
gives way to the law, ``friction_scale`` to 1: the law is that of the points. Where their
``oil_temperature`` is given, friction changes with it by the pack's ``friction_temperature``, which
is written out; its slope can be fitted too.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....clutch.parameters import ClutchParams
from ....numerics.jit import Array
from ....storage.digests import finite
from ..estimates import STEADY, Calibration, Estimate, Series, closer, remarks
from ..fit import Asked, fitted
from ..identifiability import Information, Verdict
from ..least_squares import FitProblem
from ..measured import Measured
from ..model_fit import misses, values_of
from .friction_law import WARMTH, LawPoints, end_frictions, friction_slopes, law_problem
from .reach import hidden_fall, out_of_reach, rising

SAME_LOAD = 1e-6  # relative spread of loads below which there is nothing to compare
FOLLOWS = 1e-4  # share of the load's spread that the law's constants must leave free


@dataclass(frozen=True, slots=True)
class LoadTest:
    """Whether the residuals follow the load, the law's constants allowed to give way."""

    change: float | None
    """[-] change of friction over the range of loads, relative to its mean; None: no test."""
    p_value: float | None  # Probability of a change as large if friction did not depend on load
    text: str

    @property
    def is_significant(self) -> bool:
        """True if a test at the 1 % level finds a dependence on load."""
        return self.p_value is not None and self.p_value < 0.01


@dataclass(frozen=True, eq=False, kw_only=True)
class LawCalibration(Calibration):
    """Constants of the friction law; ``derived`` are the coefficients at both ends of its curve."""

    load_test: LoadTest
    without: ClassVar[tuple[str, ...]] = ("load",)
    _law: LawPoints = field(repr=False)

    @property
    def end_frictions(self) -> tuple[Estimate, ...]:
        """Coefficient at rest and at very high slip."""
        return self.derived

    def band(self, slip_speed: ArrayLike) -> tuple[Array, Array]:
        """Return (coefficient, half width of its confidence band) at slip speeds [m/s].

        The half width is infinite where the points do not tell the curve; so it is below the
        slowest point if the corner at stick_speed may lie there.
        """
        speed = np.abs(np.atleast_1d(np.asarray(slip_speed, float)))
        values = self._problem.values(self._best)
        rows = friction_slopes(values, speed, self._problem.names)
        half = np.array([self._learned.half_width_of(row) for row in rows])
        if any(e.name == "stick_speed" and not e.identifiable for e in self.estimates):
            half[speed < self._law.speed.min()] = np.inf
        return self._law.over(values, speed), half

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        return {
            **super().to_dict(),
            "rms": self.rms,
            "friction_data": self.params.friction_data,
            "end_frictions": [finite(asdict(e)) for e in self.derived],
            "load_test": asdict(self.load_test) | {"is_significant": self.load_test.is_significant},
        }

    def curve_over(self, output: str, over: str, own: NDArray[np.bool_]) -> Series | None:
        """Return the law over slip speed; load does not act, temperature is the points' mean."""
        warmed, law = self._law.warmed(self._problem.values(self._best))[own], self._law
        if over != "slip speed" or np.ptp(warmed) > STEADY * warmed.max():
            return None
        points = law.points
        place = [s.name for s in points.plan.spec.inputs].index("speed")
        rows = points.plan.inputs[points.row[own]]
        rows[:, place] = np.abs(rows[:, place])
        inputs = closer(rows, place)
        slip = inputs[:, place] * law.params.friction_radius
        return self._curve(output, over, slip, inputs, own)

    def _law_at(self, points: Measured) -> dict[str, Any]:
        law = LawPoints(points)
        return {"computed": law.friction, "exact_slopes": law.slopes}

    def _drawn_over(self, output: str) -> Mapping[str, tuple[str, Array]]:
        """Return slip speed and load of the points; their temperature where it acts."""
        law = self._law
        found = {"slip speed": ("m/s", law.speed), "load": ("N", law.load)}
        if np.ptp(law.warmed(self._problem.values(self._best))) > 0.0:
            found["oil temperature"] = "K", self.points.input("oil_temperature")
        return found


def fit_law(points: Measured, asked: Asked) -> LawCalibration:
    """Return constants of the law fitted to measured friction."""
    law, problem, first = law_problem(points, asked)
    profile = asked.profile is not False  # they are quick
    found, judged = fitted(problem, first, asked.confidence, profile)
    best, told = found["_best"], found["_learned"]
    load_test = _load_test(law, problem, best, told)
    params = replace(law.params, **values_of(found))
    said = _warnings(law, problem, best, first, judged)
    return LawCalibration(
        params=params,
        points=law.points,
        derived=() if law.is_constant else _end_estimates(problem, best, told),
        load_test=load_test,
        remarks=remarks(said, _notes(law, params, load_test)),
        _law=law,
        **found,
    )


def _warnings(
    law: LawPoints, problem: FitProblem, best: Array, first: Array, judged: list[Verdict]
) -> list[str]:
    """Return what is wrong with the fit as a whole, the gravest first: "headline: details"."""
    scatter = 1.0 / problem.weight
    if not problem.known_errors:  # that of a point next to its neighbours in speed
        bends = np.diff(problem.measured[np.argsort(law.speed, kind="stable")], 2)
        scatter[:] = float(np.sqrt(np.mean(bends**2) / 6.0)) if len(bends) else 0.0
    grave, hidden = [rising(law, problem)], ""
    if not law.is_constant and WARMTH not in problem.names:
        grave = [out_of_reach(law, problem, scatter, side) for side in (1, -1)] + grave
        hidden = hidden_fall(law, problem, best, first)
    flat = 'friction changes with speed, take friction_law = "wang"' if law.is_constant else ""
    far, poor = misses(law.points, problem, best, judged, scatter, flat)
    grave = [text for text in grave if text] or [*far, *filter(None, [hidden])]
    return [*law.points.plan.warnings, *grave, *poor]


def _notes(law: LawPoints, params: ClutchParams, load_test: LoadTest) -> list[str]:
    """Return sentences on what the points were measured on, on load and temperature."""
    lines = ["Law: asperities alone; the settled film's shear was taken off the points."]
    if params.friction_data == "total":
        lines = ["Points and law: total friction of a settled pack, shear of its oil included."]
    lines.append(f"Load: {load_test.text}.")
    warm, acts = params.reference_temperature, params.temperature_law()
    slope = params.friction_temperature_slope if acts == "slope" else 0.0
    if np.all(law.warmer == 0.0):
        if acts or params.shear_temperature_slope != 0.0:
            lines.append(
                f"Temperature: the points count as measured at reference_temperature "
                f"({warm:g} K); friction changes away from it."
            )
    else:
        how = f"by {100 * slope:.2g} % per kelvin of" if acts != "points" else "by its points at"
        lines.append(
            f"Temperature: friction changes {how} a point's "
            f"oil_temperature; the law is that of reference_temperature ({warm:g} K)."
        )
    return lines


def _end_estimates(problem: FitProblem, best: Array, told: Information) -> tuple[Any, ...]:
    """Return the coefficients at rest and at very high slip."""
    values, names = problem.values(best), ("friction_at_rest", "friction_at_speed")
    sharp = {**values, "stick_speed": 0.0, "kink_width": 0.0}
    rows = friction_slopes(sharp, np.array([0.0, 1e9]), problem.names)
    found = []
    for name, value, row in zip(names, end_frictions(values), rows, strict=True):
        error, half = told.error_of(row), told.half_width_of(row)
        known = bool(half <= value)
        interval = (max(0.0, value - half), value + half) if known else (0.0, np.inf)
        reason = "" if known else "the points do not reach it"
        found.append(Estimate(name, "1", value, error, interval, None, known, "", reason))
    return tuple(found)


def _load_test(law: LawPoints, problem: FitProblem, best: Array, told: Information) -> LoadTest:
    """Return the test of a term linear in load next to the law's own constants."""
    from scipy.stats import norm, t

    load, freedom = law.load, told.freedom - 1
    spread = float(np.ptp(load))
    if spread <= SAME_LOAD * float(load.max()):
        return LoadTest(None, None, "all points have one load: its influence cannot be tested")
    if freedom < 1:
        return LoadTest(None, None, "too few points to test the influence of load")
    column = (load - load.mean()) / spread * problem.weight
    basis = np.linalg.svd(problem.slopes(best) * problem.scale, full_matrices=False)[0]
    basis = basis[:, : told.rank]
    free = column - basis @ (basis.T @ column)
    if free @ free < FOLLOWS * (column @ column):
        text = "load changes only together with speed: its influence cannot be told from speed's"
        return LoadTest(None, None, text)
    slope = float(free @ -problem.misfit(best) / (free @ free))
    left = max(problem.cost(best) - slope * slope * float(free @ free), 0.0)
    floor = 1e-13 * float(np.abs(problem.measured * problem.weight).max())
    deviation = max(1.0 if problem.known_errors else float(np.sqrt(left / freedom)), floor)
    score = abs(slope) * float(np.sqrt(free @ free)) / deviation
    p_value = 2.0 * float(norm.sf(score) if problem.known_errors else t.sf(score, freedom))
    change = slope / float(problem.measured.mean())
    size = f"{100 * change:+.2g} %"
    where = f"from {load.min():g} to {load.max():g} N"
    text = f"no dependence on load beyond the scatter ({size} {where}, p = {p_value:.2g})"
    if p_value < 0.01:
        text = (
            f"friction changes by {size} {where}, more than scatter explains (p = {p_value:.2g}); "
            "the law knows no load, fit narrower ranges of load one by one"
        )
    return LoadTest(change, p_value, text)
