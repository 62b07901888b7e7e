"""The clutch's friction law over its constants: values, derivatives, what is fitted to points."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....clutch.kernels.layout import TEMPERATE
from ....clutch.kernels.pack_friction import (
    ploughing,
    settled_slope,
    temperature_factor,
    viscous_slopes,
)
from ....clutch.parameters import ClutchParams
from ....clutch.solve import prepare
from ....errors import ParameterError
from ....numerics.jit import Array
from ..fit import Asked, chosen_names
from ..least_squares import FitProblem, Search, Terms
from ..measured import Measured
from ..model_fit import problem_of

SHAPE = ("plough_weight", "shear_floor", "stick_speed", "decay_speed")
WANG_CONSTANTS = (*SHAPE, "hardness_ratio", "indentation")
CONSTANT_LAW = ("constant_friction",)
WARMTH = "friction_temperature_slope"  # of either law; needs points at several temperatures
LARGEST_FRICTION = 2.0
SPEEDS, LINEAR = ("stick_speed", "decay_speed"), ("plough_weight", "shear_floor")
N_STICK, N_DECAY, N_OTHER = 10, 7, 3  # values of each constant that the coarse search tries
N_STARTS = 4  # best of them, refined
N_SEARCHED = 4000  # points of the coarse search at most
TABLE = (
    'take friction_law = "table" (ClutchParams.with_table), which follows a measured curve '
    "in up to six points"
)
STEEPEST = 1.0 - 1e-9  # the derivative over the indentation is infinite at 1


def law_values(params: ClutchParams) -> dict[str, float]:
    """Return every number the law depends on, by the name of its parameter."""
    names = (*WANG_CONSTANTS, *CONSTANT_LAW, WARMTH, "kink_width", "adhesion_factor")
    return {name: float(getattr(params, name)) for name in names}


def settled_shear(params: ClutchParams, slip: Array, load: Array, oil: Array) -> Array:
    """Return what shear of the settled film's oil adds to the coefficient [-] of a pack.

    ``slip`` [rad/s], ``load`` [N], temperature of the oil [K], one value per point.
    """
    par = prepare(params, "field")
    lever = params.faces * params.friction_radius * load
    points = zip(slip.tolist(), load.tolist(), oil.tolist(), strict=True)
    torque = [
        viscous_slopes(par, w, 0.0, settled_slope(par, f, 1.0)[0], t)[0] for w, f, t in points
    ]
    return np.asarray(np.array(torque) / lever)


def shares(values: Mapping[str, float]) -> tuple[float, float]:
    """Return (ploughing share P(x) for weight 1, adhesive share D at full shear strength) [-]."""
    x = values["indentation"]
    root = math.sqrt((1.0 - x) * (1.0 + x))
    hardness = values["hardness_ratio"] / values["adhesion_factor"]
    return float(ploughing(x)), 4.0 / (math.pi * hardness * (1.0 + root))


def end_frictions(values: Mapping[str, float]) -> tuple[float, float]:
    """Return the coefficient at rest and the one at very high slip [-].

    These two numbers are all that plough weight, shear floor, hardness ratio and indentation do to
    the curve: k P(x) + D(x, N) and k P(x) + D(x, N) S_inf.
    """
    plough, adhesion = shares(values)
    base = values["plough_weight"] * plough
    return base + adhesion, base + adhesion * values["shear_floor"]


def friction_over(values: Mapping[str, float], speed: Array, constant: bool = False) -> Array:
    """Return the coefficient [-] at slip speeds [m/s] at the friction radius, none negative.

    Notes
    -----
    Source: Wang, Wei & Wu (2012), Eq 12; the same numbers as the kernels' at the reference
    temperature, over arrays.
    """
    if constant:
        return np.full(speed.shape, values["constant_friction"])
    at_rest, at_speed = end_frictions(values)
    return at_speed + (at_rest - at_speed) * _decay(values, speed)[0]


def friction_slopes(values: Mapping[str, float], speed: Array, names: Sequence[str]) -> Array:
    """Return the derivatives of ``friction_over`` over the named constants, (points, names).

    At the sharp corner the derivative over stick_speed is that from below it.
    """
    if set(names) <= {*CONSTANT_LAW, WARMTH}:
        return np.column_stack([np.full(speed.shape, float(n != WARMTH)) for n in names])
    x, floor, hardness = (values[n] for n in ("indentation", "shear_floor", "hardness_ratio"))
    plough, adhesion = shares(values)
    decay, by_stick, by_decay = _decay(values, speed)
    shear = floor + (1.0 - floor) * decay
    x = min(x, STEEPEST)
    root = math.sqrt((1.0 - x) * (1.0 + x))
    plough_by_x = 4.0 / (math.pi * root) - 2.0 * plough / x
    fall = adhesion * (1.0 - floor)
    slopes: dict[str, Any] = {
        "plough_weight": plough,
        "shear_floor": adhesion * (1.0 - decay),
        "stick_speed": fall * by_stick,
        "decay_speed": fall * by_decay,
        "hardness_ratio": -adhesion * shear / hardness,
        "indentation": values["plough_weight"] * plough_by_x
        + adhesion * shear * x / (root * (1.0 + root)),
        WARMTH: 0.0,  # the law is that of the reference temperature
    }
    return np.column_stack([np.broadcast_to(slopes[name], speed.shape) for name in names])


def _decay(values: Mapping[str, float], speed: Array) -> tuple[Array, Array, Array]:
    """Return exp(-beyond/decay_speed) and its derivatives over stick_speed and decay_speed."""
    width, length = values["kink_width"], values["decay_speed"]
    beyond = speed - values["stick_speed"]
    if width > 0.0:
        u = beyond / width
        beyond = np.where(u < 30.0, width * np.logaddexp(0.0, np.minimum(u, 30.0)), beyond)
        active = 1.0 / (1.0 + np.exp(-np.clip(u, -700.0, 700.0)))
    else:
        active = (beyond > 0.0).astype(float)
        beyond = np.maximum(beyond, 0.0)
    decay = np.exp(-np.minimum(beyond / length, 700.0))
    return decay, decay * active / length, decay * beyond / length**2


SEARCH = Search(rough=1e-7, fine=1e-14, evaluations=250, resolution=1e-9)
TERMS = Terms("law", "friction", "point", "friction_error", TABLE)


@dataclass(frozen=True)
class LawPoints:
    """Points of a pack at which its law of friction is computed, from all its numbers by name."""

    points: Measured

    @property
    def params(self) -> ClutchParams:
        """The pack."""
        params: ClutchParams = self.points.plan.params[0]
        return params

    @property
    def is_constant(self) -> bool:
        """True for the constant law instead of Wang, Wei & Wu's."""
        return bool(self.params.friction_law == "constant")

    @cached_property
    def speed(self) -> Array:
        """Slip speed of the points [m/s], not negative."""
        return np.asarray(np.abs(self.points.input("speed")) * self.params.friction_radius)

    @cached_property
    def load(self) -> Array:
        """Load of the points [N]; the law does not know it."""
        return self.points.input("load")

    @cached_property
    def warmer(self) -> Array:
        """Temperature of the points over the law's [K], as far as the slope acts."""
        warm = np.clip(self.points.input("oil_temperature"), *TEMPERATE)
        return np.asarray(warm - self.params.reference_temperature)

    @cached_property
    def by_points(self) -> Array | None:
        """Friction over that of the law [-] where points over temperature say it, else None."""
        if self.params.friction_temperature != "points":
            return None
        par, warm = prepare(self.params, "field"), self.points.input("oil_temperature").tolist()
        return np.array([temperature_factor(par, t)[0] for t in warm])

    def warmed(self, values: Mapping[str, float]) -> Array:
        """Return friction at the points over that at the law's temperature [-]."""
        if self.by_points is not None:
            return self.by_points
        return np.asarray(np.exp(values[WARMTH] * self.warmer))

    def friction(self, values: Mapping[str, float]) -> Array:
        """Return the coefficients [-] of a law at the points."""
        return np.asarray(self.over(values, self.speed) * self.warmed(values))

    def over(self, values: Mapping[str, float], speed: Array) -> Array:
        """Return the coefficients [-] of a law at slip speeds [m/s], at its temperature."""
        return friction_over(values, speed, self.is_constant)

    def slopes(self, values: Mapping[str, float], names: Sequence[str]) -> Array:
        """Return the derivatives of ``friction``, (points, names)."""
        slopes = friction_slopes(values, self.speed, names) * self.warmed(values)[:, None]
        if WARMTH in names:
            slopes[:, list(names).index(WARMTH)] = self.friction(values) * self.warmer
        return np.asarray(slopes)

    def matters(self, name: str) -> float:
        """Return the fastest slip for a speed, the mean for a coefficient, 1 for a ratio."""
        if name in SPEEDS:
            return float(self.speed.max()) or 1.0
        if name == WARMTH:
            return 1e-3
        return float(self.points.value.mean()) if name in CONSTANT_LAW else 1.0


def law_problem(points: Measured, asked: Asked) -> tuple[LawPoints, FitProblem, Array]:
    """Return the points of a pack with the law, what is to be solved, and the guess before it."""
    points, names = _with_law(points, asked)
    law = LawPoints(points)
    problem, first = problem_of(
        points,
        names,
        asked.bounds,
        changes={name: law.matters(name) for name in names},
        typical=1.0,
        computed=law.friction,
        exact_slopes=law.slopes,
        base=law_values(law.params),
        terms=TERMS,
        search=SEARCH,
        ran=asked.ran,
        starts=partial(_starts, law),
        why_not=partial(_why_not, law),
        why_bound=_why_bound,
    )
    return law, problem, first


def _with_law(points: Measured, asked: Asked) -> tuple[Measured, tuple[str, ...]]:
    """Return the points of a pack with the law, without what is not the law's; the constants.

    A table gives way to the law, ``friction_scale`` to 1: the law is that of the points.
    """
    if points.names != ("friction",) or len(points.plan.params) > 1:
        raise ParameterError("friction: allowed: without other outputs, all points of one pack")
    params = points.plan.params[0]
    law_of = "wang" if params.friction_law == "table" else params.friction_law
    own, usual = (CONSTANT_LAW,) * 2 if law_of == "constant" else (WANG_CONSTANTS, SHAPE)
    acting, warm = (*own, WARMTH), "oil_temperature" in {*asked.columns, *asked.at}
    words = f"under friction_law {law_of!r}, which does not depend on load: {', '.join(acting)}"
    names = chosen_names(usual if asked.fit is None else asked.fit, acting, words, asked.columns)
    if WARMTH in names and not warm:
        raise ParameterError(
            f"oil_temperature is missing, required with {WARMTH}: the temperature each point "
            "was measured at"
        )
    load, mu, mean = points.input("load"), points.value, points.value.mean()
    most, shear = LARGEST_FRICTION, np.zeros(len(mu))
    _refuse(points, "load", load, load == 0.0, "above 0 N")
    _refuse(points, "friction", mu, np.abs(mu) > most, f"{-most:g} .. {most:g}")
    if mean <= 0.0:
        raise ParameterError(
            f"friction is {mean:.3g} on average, allowed: above 0 (for either sign of speed)"
        )
    if params.friction_temperature == "points" and set(names) & {WARMTH, *CONSTANT_LAW}:
        raise ParameterError(
            f"fit = {', '.join(names)}: friction_temperature = points stands in place of "
            f"{WARMTH} and constant_friction, allowed: friction_temperature = slope"
        )
    written = _temperature_law(params, WARMTH in names)
    params = replace(params, friction_law=law_of, friction_scale=1.0, **written)
    if params.friction_data == "boundary":
        if not warm:
            raise ParameterError(
                "oil_temperature is missing, required with friction_data = 'boundary': shear "
                "of the oil is taken off the measured friction"
            )
        oil = points.input("oil_temperature")
        shear = settled_shear(params, points.input("speed"), load, oil)
        cure = (
            "twice the shear of the settled film or more with friction_data = 'boundary'; "
            "leave the point out, or take friction_data = 'total'"
        )
        _refuse(points, "friction", mu, shear > 0.5 * mu, cure)
    columns = dict(points.plan.columns)
    if not warm:  # then they count as measured where the law holds
        columns["oil_temperature"] = np.full(points.plan.n_rows, params.reference_temperature)
    plan = replace(points.plan, params=(params,), columns=columns)
    return replace(points, plan=plan, value=mu - shear), names


def _starts(law: LawPoints, problem: FitProblem, first: Array) -> list[Array]:
    """Return the best points of a coarse search; the two weights follow by linear fits.

    Of many points it takes ``N_SEARCHED``, evenly among the ranks of their speeds.
    """
    if law.is_constant:
        return []
    if len(law.speed) > N_SEARCHED:
        ranks = np.linspace(0, len(law.speed) - 1, N_SEARCHED).astype(int)
        rows = np.argsort(law.speed, kind="stable")[ranks]
        law = LawPoints(law.points.some(rows))
        problem = replace(
            problem,
            computed=law.friction,
            exact_slopes=law.slopes,
            measured=problem.measured[rows],
            weight=problem.weight[rows],
            kept={},
        )
    grids = [_candidates(law, problem, i, float(first[i])) for i in range(len(first))]
    linear = [i for i, name in enumerate(problem.names) if name in LINEAR]
    tried = []
    for point in product(*grids):
        guess = np.array(point)
        if linear:
            columns = problem.slopes(guess)[:, linear]
            guess[linear] += np.linalg.lstsq(columns, -problem.misfit(guess), rcond=1e-10)[0]
        guess = np.clip(guess, problem.low, problem.high)
        tried.append((problem.cost(guess), tuple(guess)))
    return [np.array(point) for _, point in sorted(tried)[:N_STARTS]]


def _candidates(law: LawPoints, problem: FitProblem, index: int, first: float) -> list[float]:
    """Return the values of one constant that the coarse search tries."""
    name, low, high = problem.names[index], problem.low[index], problem.high[index]
    speeds = np.unique(law.speed)
    values: Any = [first, *np.geomspace(max(low, 2.0), high, N_OTHER)]
    if name in LINEAR:
        return [0.5]
    if name == WARMTH:
        return [first]
    if name == "stick_speed":  # between neighbouring speeds the sum of squares is smooth
        middles = 0.5 * (speeds[1:] + speeds[:-1])
        ranks = np.linspace(0.0, 1.0, N_STICK)
        values = [first, *(np.quantile(middles, ranks) if len(middles) else speeds)]
    elif name == "decay_speed":
        values = np.geomspace(0.03, 3.0, N_DECAY) * max(float(speeds[-1]), 1e-3)
    elif name == "indentation":
        values = [first, 0.03, 0.3]
    return [float(v) for v in np.unique(np.clip(values, low, high))]


def _why_bound(problem: FitProblem, best: Array, i: int, side: str) -> str:
    """Return what would free the weight of the ploughing share."""
    if problem.names[i] != "plough_weight" or side != "lower":
        return ""
    return (
        f" (friction at rest cannot be below the adhesive share alone, "
        f"{shares(problem.values(best))[1]:.4g}; a larger hardness_ratio lowers that)"
    )


def _why_not(law: LawPoints, problem: FitProblem, best: Array, i: int) -> tuple[str, bool]:
    """Return what the points' speeds leave out."""
    name, fastest, slowest = problem.names[i], law.speed.max(), law.speed.min()
    if name == WARMTH:
        told = float(np.ptp(law.warmer)) > 0.0
        return ("" if told else "all points have one temperature"), False
    stick = problem.values(best)["stick_speed"]
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


def _temperature_law(params: ClutchParams, fits_slope: bool) -> dict[str, Any]:
    """Return the fields that write out how friction changes with temperature, as the pack's did."""
    acts = params.temperature_law()
    if fits_slope or acts:
        return {"friction_temperature": "slope" if fits_slope else acts}
    return {"friction_temperature": "slope", WARMTH: 0.0}


def _refuse(
    points: Measured, name: str, values: Array, bad: NDArray[np.bool_], allowed: str
) -> None:
    """Name the first value that cannot be used."""
    if bad.any():
        i = int(np.argmax(bad))
        where = f"{name}: point {points.row[i] + 1} is {float(values[i]):.6g}"
        raise ParameterError(f"{where}, allowed: {allowed}")
