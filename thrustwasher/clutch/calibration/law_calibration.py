"""A friction law fitted to measurements: its ends at rest and at speed, and whether load acts."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...calibration.estimates import Calibration, Estimate, Series, size_text
from ...calibration.identifiability import Information, counted
from ...numerics.jit import Array
from ...storage.digests import finite
from .friction_law import LawProblem, friction_slopes

SAME_LOAD = 1e-6  # relative spread of loads below which there is nothing to compare
FOLLOWS = 1e-4  # share of the load's spread that the law's constants must leave free


@dataclass(frozen=True, slots=True)
class LoadTest:
    """Whether the residuals follow the load, the law's constants allowed to give way."""

    change: float | None
    """[-] change of friction over the range of loads, relative to its mean; None: no test."""
    p_value: float | None
    """Probability of a change as large if friction did not depend on load."""
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
        rows = friction_slopes(problem.values(self._best), speed, problem.names)
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


def load_test(problem: LawProblem, best: Array, told: Information) -> LoadTest:
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
