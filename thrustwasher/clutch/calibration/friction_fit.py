"""The clutch's friction law fitted to measured coefficients of friction.

The law's curve over slip speed is mu_inf + (mu_0 - mu_inf) e(v; stick_speed, decay_speed), with
mu_0 = k P(x) + D(x, N) and mu_inf = k P(x) + D(x, N) S_inf. So the best of measurements tells four
numbers, and plough_weight k, shear_floor S_inf, hardness_ratio N and indentation x act through two
of them: at most two of these four can be fitted at once. Load does not act at all.

``friction_data`` of the pack says what the law describes. "total": the points as they are.
"boundary": the points less the shear of the settled film, at their ``oil_temperature``. A table
gives way to the law, ``friction_scale`` to 1: the law is that of the points.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...calibration.estimates import Calibration, Estimate
from ...calibration.fit import chosen_names
from ...calibration.identifiability import Information, Verdict
from ...calibration.measured import Measured
from ...calibration.model_problem import ModelProblem
from ...errors import ParameterError
from ...model.record import OwnOutputs
from ...model.spec import ModelSpec
from ...numerics.jit import Array
from ...storage.digests import finite
from . import friction_law as law
from .reach import TABLE, hidden_fall, out_of_reach, rising

FRICTION = OwnOutputs(units={"friction": "1"})
LARGEST_FRICTION = 2.0
SPEEDS, LINEAR = ("stick_speed", "decay_speed"), ("plough_weight", "shear_floor")
N_STICK, N_DECAY, N_OTHER = 10, 7, 3  # values of each constant that the coarse search tries
N_STARTS = 4  # best of them, refined
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
        rows = law.friction_slopes(values, speed, self._problem.names)
        half = np.array([self._told.half_width_of(row) for row in rows])
        if any(e.name == "stick_speed" and not e.identifiable for e in self.estimates):
            half[speed < self._problem.speed.min()] = np.inf
        return self._problem.curve_over(values, speed), half

    def as_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        return {
            **super().as_dict(),
            "rms": self.rms,
            "friction_data": self.params.friction_data,
            "end_frictions": [finite(asdict(e)) for e in self.derived],
            "load_test": asdict(self.load_test) | {"is_significant": self.load_test.is_significant},
        }

    def remarks(self) -> list[str]:
        """Return sentences on what the points were measured on, on load and temperature."""
        lines = ["Law: asperities alone; the settled film's shear was taken off the points."]
        if self.params.friction_data == "total":
            lines = ["Points and law: total friction of a settled pack, shear of its oil included."]
        lines.append(f"Load: {self.load_test.text}.")
        if self.params.shear_temperature_slope != 0.0:
            warm = self.params.reference_temperature
            lines.append(
                f"Temperature: the points count as measured at reference_temperature ({warm:g} K); "
                "shear_temperature_slope acts away from it."
            )
        return lines


@dataclass(frozen=True, kw_only=True)
class FrictionProblem(ModelProblem):
    """Measured friction and the constants of the friction law; ``base``: every number of it."""

    rough, fine, resolution, evaluations = 1e-7, 1e-14, 1e-9, 250
    law, subject, counted_as, error_name = "law", "friction", "point", "friction_error"
    by_rung, profiles, typical, instead = False, True, 1.0, TABLE

    @classmethod
    def asked(
        cls, spec: ModelSpec, params: Any, fit: Sequence[str] | None, given: set[str]
    ) -> tuple[Any, tuple[str, ...]]:
        """Return the pack with the law, and the constants to fit."""
        law_of = "wang" if params.friction_law == "table" else params.friction_law
        acting = law.CONSTANT_LAW if law_of == "constant" else law.WANG_CONSTANTS
        usual = acting[: len(law.SHAPE)]
        words = f"under friction_law {law_of!r}, which does not depend on load: {', '.join(acting)}"
        if params.friction_data == "boundary" and "oil_temperature" not in given:
            raise ParameterError(
                "oil_temperature is missing, wanted with friction_data = 'boundary': shear of the "
                "oil is taken off the measured friction"
            )
        params = replace(params, friction_law=law_of, friction_scale=1.0)
        return params, chosen_names(usual if fit is None else fit, acting, words)

    @classmethod
    def checked(cls, points: Measured, names: tuple[str, ...]) -> Measured:
        """Return the points without what is not the law's, or name the first that is of no use."""
        if points.names != ("friction",) or len(points.plan.params) > 1:
            raise ParameterError("friction: allowed: without other outputs, all points of one pack")
        load, mu, mean = points.input("load"), points.value, points.value.mean()
        _refuse(points, "load", load, load == 0.0, "above 0 N")
        most = LARGEST_FRICTION
        _refuse(points, "friction", mu, np.abs(mu) > most, f"{-most:g} .. {most:g}")
        if mean <= 0.0:
            raise ParameterError(
                f"friction is {mean:.3g} on average, allowed: above 0 (for either sign of speed)"
            )
        params = points.plan.params[0]
        if params.friction_data == "total":
            return points
        speed, oil = points.input("speed"), points.input("oil_temperature")
        shear = law.settled_shear(params, speed, load, oil)
        cure = (
            "twice the shear of the settled film or more with friction_data = 'boundary'; leave "
            "the point out, or take friction_data = 'total'"
        )
        _refuse(points, "friction", mu, shear > 0.5 * mu, cure)
        return replace(points, value=mu - shear)

    @classmethod
    def change_of(cls, points: Measured, name: str) -> float:
        """Return the fastest slip for a speed, the mean for a coefficient, 1 for a ratio."""
        if name in SPEEDS:
            slip = np.abs(points.input("speed")) * points.plan.params[0].friction_radius
            return float(slip.max()) or 1.0
        return float(points.value.mean()) if name in law.CONSTANT_LAW else 1.0

    @classmethod
    def held(cls, params: Any) -> dict[str, Any]:
        """Return every number of the law."""
        return law.law_values(params)

    @property
    def is_constant(self) -> bool:
        """True for the constant law instead of Wang, Wei & Wu's."""
        return bool(self.points.plan.params[0].friction_law == "constant")

    @cached_property
    def speed(self) -> Array:
        """Slip speed of the points [m/s], not negative."""
        slip = np.abs(self.points.input("speed"))
        return np.asarray(slip * self.points.plan.params[0].friction_radius)

    @cached_property
    def load(self) -> Array:
        """Load of the points [N]; the law does not know it."""
        return self.points.input("load")

    def curve(self, guess: Array) -> Array:
        """Return the coefficients [-] at the measured slip speeds."""
        return self.curve_over(self.values(guess), self.speed)

    def curve_over(self, values: Mapping[str, float], speed: Array) -> Array:
        """Return the coefficients [-] of a law at slip speeds [m/s]."""
        return law.friction_over(values, speed, self.is_constant)

    def slopes_of_curve(self, guess: Array) -> Array:
        """Return the derivatives of the curve, (points, constants)."""
        return law.friction_slopes(self.values(guess), self.speed, self.names)

    def starts(self, first: Array) -> list[Array]:
        """Return the best points of a coarse search; the two weights follow by linear fits."""
        if self.is_constant:
            return []
        grids = [self._candidates(i, float(first[i])) for i in range(len(self.names))]
        linear = [i for i, name in enumerate(self.names) if name in LINEAR]
        tried = []
        for point in product(*grids):
            guess = np.array(point)
            if linear:
                columns = self.slopes(guess)[:, linear]
                guess[linear] += np.linalg.lstsq(columns, -self.misfit(guess), rcond=1e-10)[0]
            guess = np.clip(guess, self.low, self.high)
            tried.append((self.cost(guess), tuple(guess)))
        return [np.array(point) for _, point in sorted(tried)[:N_STARTS]]

    def missed_because(self, judged: list[Verdict]) -> str:
        """Return what keeps the law from the points."""
        if self.is_constant:
            return 'friction changes with speed, take friction_law = "wang"'
        return super().missed_because(judged)

    def _candidates(self, index: int, first: float) -> list[float]:
        """Return the values of one constant that the coarse search tries."""
        name, low, high = self.names[index], self.low[index], self.high[index]
        speeds = np.unique(self.speed)
        values: Any = [first, *np.geomspace(max(low, 2.0), high, N_OTHER)]
        if name in LINEAR:
            return [0.5]
        if name == "stick_speed":  # between neighbouring speeds the sum of squares is smooth
            middles = 0.5 * (speeds[1:] + speeds[:-1])
            ranks = np.linspace(0.0, 1.0, N_STICK)
            values = [first, *(np.quantile(middles, ranks) if len(middles) else speeds)]
        elif name == "decay_speed":
            values = np.geomspace(0.03, 3.0, N_DECAY) * max(float(speeds[-1]), 1e-3)
        elif name == "indentation":
            values = [first, 0.03, 0.3]
        return [float(v) for v in np.unique(np.clip(values, low, high))]

    def why_bound(self, best: Array, i: int, side: str) -> str:
        """Return what would free the weight of the ploughing share."""
        if self.names[i] != "plough_weight" or side != "lower":
            return ""
        return (
            f" (friction at rest cannot be below the adhesive share alone, "
            f"{law.shares(self.values(best))[1]:.4g}; a larger hardness_ratio lowers that)"
        )

    def why_not(self, best: Array, i: int) -> tuple[str, bool]:
        """Return what the points' speeds leave out."""
        name, fastest, slowest = self.names[i], self.speed.max(), self.speed.min()
        stick = self.values(best)["stick_speed"]
        if name in ("shear_floor", *SPEEDS) and fastest <= stick:
            return (
                f"all points lie below stick_speed ({stick:.4g} m/s; fastest slip {fastest:.4g} "
                "m/s), where friction does not change with speed"
            ), True
        if fastest == slowest:
            return f"all points have one slip speed ({fastest:.4g} m/s)", False
        if name == "stick_speed" and slowest >= stick:
            return f"all points lie above it (slowest slip {slowest:.4g} m/s)", False
        return "", False

    def drawn_over(self, output: str) -> dict[str, tuple[str, Array]]:
        """Return slip speed and load of the points."""
        return {"slip speed": ("m/s", self.speed), "load": ("N", self.load)}

    def result(
        self, params: Any, found: Mapping[str, Any], first: Array, judged: list[Verdict]
    ) -> LawCalibration:
        """Return the calibration, with the ends of the curve and the test of load."""
        best, told = found["_best"], found["_told"]
        return LawCalibration(
            params=params,
            points=self.points,
            derived=() if self.is_constant else _end_estimates(self, best, told),
            load_test=_load_test(self, best, told),
            warnings=self.warnings(best, first, judged),
            **found,
        )

    def warnings(self, best: Array, first: Array, judged: list[Verdict]) -> tuple[str, ...]:
        """Return what is wrong with the fit as a whole, the gravest first: "headline: details"."""
        scatter = 1.0 / self.weight
        if not self.known_errors:  # that of a point beside its neighbours in speed
            bends = np.diff(self.measured[np.argsort(self.speed, kind="stable")], 2)
            scatter[:] = float(np.sqrt(np.mean(bends**2) / 6.0)) if len(bends) else 0.0
        grave, hidden = [rising(self)], ""
        if not self.is_constant:
            grave = [out_of_reach(self, scatter, side) for side in (1, -1)] + grave
            hidden = hidden_fall(self, best, first)
        far, poor = self.misses(best, judged, scatter)
        grave = [text for text in grave if text] or [*far, *filter(None, [hidden])]
        return (*grave, *poor)


def _refuse(
    points: Measured, name: str, values: Array, bad: NDArray[np.bool_], allowed: str
) -> None:
    """Name the first value that cannot be used."""
    if bad.any():
        i = int(np.argmax(bad))
        where = f"{name}: point {points.row[i] + 1} is {float(values[i]):.6g}"
        raise ParameterError(f"{where}, allowed: {allowed}")


def _end_estimates(problem: FrictionProblem, best: Array, told: Information) -> tuple[Any, ...]:
    """Return the coefficients at rest and at very high slip."""
    values, names = problem.values(best), ("friction_at_rest", "friction_at_speed")
    sharp = {**values, "stick_speed": 0.0, "kink_width": 0.0}
    rows = law.friction_slopes(sharp, np.array([0.0, 1e9]), problem.names)
    found = []
    for name, value, row in zip(names, law.end_frictions(values), rows, strict=True):
        error, half = told.error_of(row), told.half_width_of(row)
        known = bool(half <= value)
        interval = (max(0.0, value - half), value + half) if known else (0.0, np.inf)
        reason = "" if known else "the points do not reach it"
        found.append(Estimate(name, "1", value, error, interval, None, known, "", reason))
    return tuple(found)


def _load_test(problem: FrictionProblem, best: Array, told: Information) -> LoadTest:
    """Return the test of a term linear in load beside the law's own constants."""
    from scipy.stats import norm, t

    load, freedom = problem.load, told.freedom - 1
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
