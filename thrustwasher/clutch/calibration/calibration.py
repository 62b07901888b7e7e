"""Fit the clutch's friction law to measured friction, and say what the points can tell."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...calibration.estimates import Calibration, Estimate, Series, size_text
from ...calibration.fit import chosen_names, fitted
from ...calibration.identifiability import Information, counted
from ...errors import ParameterError
from ...model.prepare import course_of
from ...numerics.jit import Array
from ...storage.digests import finite
from ..parameters import LOAD, OIL, SPEED, ClutchParams
from . import friction_law as law
from .data_warnings import warnings
from .friction_law import LawProblem

LARGEST_FRICTION = 2.0
SPEEDS = ("stick_speed", "decay_speed")
DEFAULT_FIT = ("plough_weight", "shear_floor", "stick_speed", "decay_speed")
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
    """A friction law fitted to measurements; ``str()`` of it is a summary in sentences."""

    end_frictions: tuple[Estimate, ...]
    """Coefficient at rest and at very high slip: often told where single constants are not."""
    load_test: LoadTest

    @property
    def friction(self) -> Array:
        """(points,) measured coefficient, less the shear that was taken off."""
        found: Array = self._problem.measured
        return found

    @property
    def all_estimates(self) -> tuple[Estimate, ...]:
        """The fitted constants and the coefficients at both ends."""
        return (*self.estimates, *self.end_frictions)

    def band(self, slip_speed: ArrayLike) -> tuple[Array, Array]:
        """Return (coefficient, half width of its confidence band) at slip speeds [m/s].

        The half width is infinite where the points do not tell the curve; so it is below the
        slowest point if the corner at stick_speed may lie there.
        """
        speed = np.abs(np.atleast_1d(np.asarray(slip_speed, float)))
        problem, told = self._problem, self._told
        curve = problem.curve(self._best, speed)
        rows = law.friction_slopes(problem.values(self._best), speed, problem.names)
        half = np.array([told.half_width_of(row) for row in rows])
        if any(e.name == "stick_speed" and not e.identifiable for e in self.estimates):
            half[speed < problem.speed.min()] = np.inf
        return curve, half

    def as_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        load = asdict(self.load_test) | {"is_significant": self.load_test.is_significant}
        return {
            **super().as_dict(),
            "friction_data": self.params.friction_data,
            "end_frictions": [finite(asdict(e)) for e in self.end_frictions],
            "load_test": load,
        }

    def shown(self) -> list[Series]:
        """Return friction over slip speed and load."""
        problem = self._problem
        inputs = {"slip speed": ("m/s", problem.speed), "load": ("N", problem.load)}
        return [self.series("friction_coefficient", "1", inputs)]

    def summary(self) -> list[str]:
        """Return sentences on what was fitted to what."""
        points = counted(len(self.residuals), "point")
        if self.params.friction_data == "total":
            data = "Points and law: total friction of a settled pack, shear of its oil included."
        else:
            data = "Law: asperities alone; the settled film's shear was taken off the points."
        return [size_text(self, points, f"{self.rms:.3g}"), data]

    def remarks(self) -> list[str]:
        """Return sentences on load and temperature."""
        lines = [f"Load: {self.load_test.text}."]
        if self.params.shear_temperature_slope != 0.0:
            warm = self.params.reference_temperature
            lines.append(
                f"Temperature: the points count as measured at reference_temperature ({warm:g} K); "
                "shear_temperature_slope acts away from it."
            )
        return lines


def calibrate(
    params: ClutchParams,
    *,
    speed: ArrayLike,
    load: ArrayLike,
    friction: ArrayLike,
    friction_error: ArrayLike | None = None,
    oil_temperature: ArrayLike | None = None,
    fit: Sequence[str] | None = None,
    confidence: float = 0.95,
    profile: bool = True,
) -> LawCalibration:
    """Fit constants of the friction law to measured coefficients of friction.

    The law's curve over slip speed is mu_inf + (mu_0 - mu_inf) e(v; stick_speed, decay_speed), with
    mu_0 = k P(x) + D(x, N) and mu_inf = k P(x) + D(x, N) S_inf. So the best of measurements tells
    four numbers, and plough_weight k, shear_floor S_inf, hardness_ratio N and indentation x act
    through two of them: at most two of these four can be fitted at once. Load does not act at all.

    Parameters
    ----------
    params : the pack: its friction radius, what is not fitted, the first guess; its
        ``friction_data`` says what the law describes. "total": the points as they are. "boundary":
        the points less the shear of the settled film. A table gives way to the law,
        ``friction_scale`` to 1: the law is that of the points
    speed : (points,) slip [rad/s]; the sign does not matter
    load : (points,) or one value [N], above 0; used to test that friction does not depend on it
    friction : (points,) measured coefficient of friction [-]
    friction_error : (points,) or one value, standard deviation of ``friction``
    oil_temperature : (points,) or one value [K]; wanted for friction_data "boundary" alone
    fit : names of constants: plough_weight, shear_floor, stick_speed, decay_speed (the default),
        hardness_ratio, indentation; constant_friction alone under friction_law "constant"
    confidence, profile : as in thrustwasher.calibrate, which calls this; errors too

    Returns
    -------
    LawCalibration : points that the law cannot follow are no error but ``warnings``

    Notes
    -----
    Source of the law: Wang, Wei & Wu (2012), Eq 12; the speed law is this package's (see
    docs/theory/calibration.md, also for the method).
    """
    law_of = "wang" if params.friction_law == "table" else params.friction_law
    params = replace(params, friction_law=law_of, friction_scale=1.0)
    acting = law.CONSTANT_LAW if law_of == "constant" else law.WANG_CONSTANTS
    usual = DEFAULT_FIT if law_of == "wang" else acting
    words = f"under friction_law {law_of!r}, which does not depend on load: {', '.join(acting)}"
    names = chosen_names(usual if fit is None else fit, acting, words)
    problem = checked_problem(params, names, speed, load, friction, friction_error)
    if params.friction_data == "boundary":
        problem = _of_asperities(params, problem, speed, oil_temperature)
    first = np.array([problem.base[name] for name in names])
    found, judged = fitted(problem, first, confidence, profile)
    best, told = found["_best"], found["_told"]
    changes: dict[str, Any] = {e.name: e.value for e in found["estimates"]}
    return LawCalibration(
        params=replace(params, **changes),
        end_frictions=() if names == law.CONSTANT_LAW else _end_estimates(problem, best, told),
        load_test=_load_test(problem, best, told),
        warnings=warnings(problem, best, first, judged),
        **found,
    )


def _end_estimates(problem: LawProblem, best: Array, told: Information) -> tuple[Estimate, ...]:
    """Return the coefficients at rest and at very high slip."""
    values = problem.values(best)
    rows = law.friction_slopes(
        {**values, "stick_speed": 0.0, "kink_width": 0.0}, np.array([0.0, 1e9]), problem.names
    )
    found = []
    for name, value, row in zip(
        ("friction_at_rest", "friction_at_speed"), law.end_frictions(values), rows, strict=True
    ):
        error, half = told.error_of(row), told.half_width_of(row)
        known = bool(half <= value)
        interval = (max(0.0, value - half), value + half) if known else (0.0, np.inf)
        reason = "" if known else "the points do not reach it"
        found.append(Estimate(name, "1", value, error, interval, None, known, "", reason))
    return tuple(found)


def _of_asperities(
    params: ClutchParams, problem: LawProblem, speed: ArrayLike, oil_temperature: ArrayLike | None
) -> LawProblem:
    """Return the problem without the shear of the settled film."""
    if oil_temperature is None:
        raise ParameterError(
            "oil_temperature is missing, wanted with friction_data = 'boundary': shear of the oil "
            "is taken off the measured friction"
        )
    oil = course_of("oil_temperature", oil_temperature, "K", *OIL.range, len(problem.measured))
    shear = law.settled_shear(params, np.asarray(speed, float), problem.load, oil)
    return replace(problem, measured=law.without_shear(problem.measured, shear))


def checked_problem(
    params: ClutchParams, names: tuple[str, ...], speed: ArrayLike, load: ArrayLike,
    friction: ArrayLike, friction_error: ArrayLike | None,
) -> LawProblem:  # fmt: skip
    """Return what is to be solved, or name the first value that cannot be used."""
    mu = course_of("friction", friction, "1", -LARGEST_FRICTION, LARGEST_FRICTION)
    count = len(mu)
    slips = np.atleast_1d(np.asarray(speed, object))  # one speed for all tells nothing
    slip = course_of("speed", slips, "rad/s", *SPEED.range, count)
    force = course_of("load", load, "N", *LOAD.range, count)
    weight = np.ones(count)
    if friction_error is not None:
        error = course_of("friction_error", friction_error, "1", 0.0, LARGEST_FRICTION, count)
        weight = 1.0 / _above_zero("friction_error", error)
    if mu.mean() <= 0.0:
        raise ParameterError(
            f"friction is {mu.mean():.3g} on average, allowed: above 0 (for either sign of speed)"
        )
    force, slip_speed = _above_zero("load", force, " N"), np.abs(slip) * params.friction_radius
    scale = np.where(np.isin(names, SPEEDS), float(slip_speed.max()) or 1.0, 1.0)
    if names == law.CONSTANT_LAW:
        scale[0] = float(mu.mean())
    low, high = law.bounds_of(names)
    units = {f.name: f.metadata["unit"] for f in fields(ClutchParams)}
    return LawProblem(
        base=law.law_values(params), names=names, speed=slip_speed, measured=mu, load=force,
        weight=weight, low=low, high=high, scale=scale, units=units,
        logarithmic=np.zeros(len(names), bool),
        is_constant=names == law.CONSTANT_LAW, known_errors=friction_error is not None,
    )  # fmt: skip


def _above_zero(name: str, array: Array, unit: str = "") -> Array:
    """Return the array, or name its first zero."""
    if (array == 0.0).any():
        i = int(np.argmax(array == 0.0))
        raise ParameterError(f"{name}[{i}] = 0{unit}, allowed: above 0")
    return array


def _load_test(problem: LawProblem, best: Array, told: Information) -> LoadTest:
    """Return the test of a term linear in load beside the law's own constants."""
    load = problem.load
    spread = float(np.ptp(load))
    if spread <= SAME_LOAD * float(load.max()):
        return LoadTest(None, None, "all points have one load: its influence cannot be tested")
    if told.freedom < 2:
        return LoadTest(None, None, "too few points to test the influence of load")
    column = (load - load.mean()) / spread * problem.weight
    basis = np.linalg.svd(problem.slopes(best) * problem.scale, full_matrices=False)[0]
    basis = basis[:, : told.rank]
    free = column - basis @ (basis.T @ column)
    if free @ free < FOLLOWS * (column @ column):
        text = "load changes only together with speed: its influence cannot be told from speed's"
        return LoadTest(None, None, text)
    return _tested(problem, best, free, told.freedom - 1)


def _tested(problem: LawProblem, best: Array, free: Array, freedom: int) -> LoadTest:
    """Return the size of the term and its significance."""
    from scipy.stats import norm, t

    misfit = -problem.misfit(best)
    slope = float(free @ misfit / (free @ free))
    left = max(problem.cost(best) - slope * slope * float(free @ free), 0.0)
    floor = 1e-13 * float(np.abs(problem.measured * problem.weight).max())
    deviation = max(1.0 if problem.known_errors else float(np.sqrt(left / freedom)), floor)
    score = abs(slope) * float(np.sqrt(free @ free)) / deviation
    p_value = 2.0 * float(norm.sf(score) if problem.known_errors else t.sf(score, freedom))
    change = slope / float(problem.measured.mean())
    where = f"from {problem.load.min():g} to {problem.load.max():g} N"
    if p_value < 0.01:
        text = (
            f"friction changes by {100 * change:+.2g} % {where}, more than scatter explains "
            f"(p = {p_value:.2g}); the law knows no load, fit narrower ranges of load one by one"
        )
    else:
        text = (
            f"no dependence on load beyond the scatter ({100 * change:+.2g} % {where}, "
            f"p = {p_value:.2g})"
        )
    return LoadTest(change, p_value, text)
