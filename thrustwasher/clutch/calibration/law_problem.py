"""The friction law as a problem of least squares: its curve, its starts, what its points hide."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Any

import numpy as np

from ...calibration.least_squares import Problem
from ...numerics.jit import Array
from ..parameters import ClutchParams
from .friction_law import friction_over, friction_slopes, shares

N_STICK, N_DECAY, N_OTHER = 10, 7, 3  # values of each constant that the coarse search tries
N_STARTS = 4  # best of them, refined
_LINEAR = ("plough_weight", "shear_floor")


@dataclass(frozen=True, kw_only=True)
class LawProblem(Problem):
    """Measured friction and the constants of the friction law; ``base``: every number of it."""

    speed: Array  # (points,) slip speed [m/s], not negative
    load: Array  # [N]; the law does not know it
    is_constant: bool = False  # the constant law instead of Wang, Wei & Wu's

    def curve(self, guess: Array, speed: Array | None = None) -> Array:
        """Return the coefficients [-] at the measured or other slip speeds."""
        at = self.speed if speed is None else speed
        return friction_over(self.values(guess), at, self.is_constant)

    def slopes_of_curve(self, guess: Array) -> Array:
        """Return the derivatives of the curve, (points, constants)."""
        return friction_slopes(self.values(guess), self.speed, self.names)

    def starts(self, first: Array) -> list[Array]:
        """Return the best points of a coarse search; the two weights follow by linear fits."""
        if self.is_constant:
            return []
        grids = [self._candidates(i, float(first[i])) for i in range(len(self.names))]
        linear = [i for i, name in enumerate(self.names) if name in _LINEAR]
        tried = []
        for point in product(*grids):
            guess = np.array(point)
            if linear:
                columns = self.slopes(guess)[:, linear]
                step = np.linalg.lstsq(columns, -self.misfit(guess), rcond=1e-10)[0]
                guess[linear] += step
            guess = np.clip(guess, self.low, self.high)
            tried.append((self.cost(guess), tuple(guess)))
        return [np.array(point) for _, point in sorted(tried)[:N_STARTS]]

    def _candidates(self, index: int, first: float) -> list[float]:
        """Return the values of one constant that the coarse search tries."""
        name, low, high = self.names[index], self.low[index], self.high[index]
        speeds = np.unique(self.speed)
        if name in _LINEAR:
            return [0.5]
        if name == "stick_speed":  # between neighbouring speeds the sum of squares is smooth
            middles = 0.5 * (speeds[1:] + speeds[:-1])
            ranks = np.linspace(0.0, 1.0, N_STICK)
            picked = np.quantile(middles, ranks) if len(middles) else speeds
            values: Any = [first, *picked]
        elif name == "decay_speed":
            values = np.geomspace(0.03, 3.0, N_DECAY) * max(float(speeds[-1]), 1e-3)
        elif name == "indentation":
            values = [first, 0.03, 0.3]
        else:
            values = [first, *np.geomspace(max(low, 2.0), high, N_OTHER)]
        return [float(v) for v in np.unique(np.clip(values, low, high))]

    def why_bound(self, best: Array, i: int, side: str) -> str:
        """Return what would free the weight of the ploughing share."""
        if self.names[i] != "plough_weight" or side != "lower":
            return ""
        return (
            f" (friction at rest cannot be below the adhesive share alone, "
            f"{shares(self.values(best))[1]:.4g}; a larger hardness_ratio lowers that)"
        )

    def why_not(self, best: Array, i: int) -> tuple[str, bool]:
        """Return what the points' speeds leave out."""
        name, fastest, slowest = self.names[i], self.speed.max(), self.speed.min()
        stick = self.values(best)["stick_speed"]
        if name in ("shear_floor", "decay_speed", "stick_speed") and fastest <= stick:
            return (
                f"all points lie below stick_speed ({stick:.4g} m/s; fastest slip {fastest:.4g} "
                "m/s), where friction does not change with speed"
            ), True
        if fastest == slowest:
            return f"all points have one slip speed ({fastest:.4g} m/s)", False
        if name == "stick_speed" and slowest >= stick:
            return f"all points lie above it (slowest slip {slowest:.4g} m/s)", False
        return "", False


def bounds_of(names: Sequence[str]) -> tuple[Array, Array]:
    """Return the least and the largest value that ClutchParams allows."""
    meta = {f.name: f.metadata for f in fields(ClutchParams)}
    limits = np.array([(meta[n]["min"], meta[n]["max"]) for n in names], float)
    return limits[:, 0], limits[:, 1]
