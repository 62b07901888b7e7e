"""A model's outputs over its parameters: what is fitted, and what it cannot follow."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Self

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.parameters import allowed
from ...model.registry import find_model
from ...numerics.jit import Array
from ..evaluators.lines import check_level
from .estimates import Calibration
from .fit import chosen_names
from .identifiability import Verdict, counted
from .least_squares import FitProblem
from .measured import Measured, output_units

ModelCalibration = Calibration  # its name while a law's fit was another one
STEP = 1e-3  # of a parameter's scale, for differences of converged solutions
DECADE = 10.0  # a range this wide, above 0, is one of logarithms
LEAST_SHARE = 0.1  # of half the range: the minimum change that would certainly matter
ELSEWHERE = "(0:"  # in the meaning of a parameter whose 0 stands for another one's value
INSIDE = 1e-13  # of a logarithmic range: rounding does not lead out of it
MOST_KEPT = 200
POOR = 0.2  # of an output's mean: an rms residual above it is always worth a warning
MATERIAL = 0.02  # of the mean: less is not worth a warning
SCATTERS = 3.0  # a value further off than this many standard deviations is off


@dataclass(frozen=True, kw_only=True)
class ModelProblem(FitProblem):
    """Measured outputs of a model and its parameters; ``base``: what is held."""

    points: Measured
    kept: dict[tuple[Any, ...], Array] = field(default_factory=dict, repr=False)

    by_level: ClassVar[bool] = True  # what computes the outputs, else a closed form
    profiles: ClassVar[bool] = False  # are so quick that they need not be requested
    typical: ClassVar[float] = 0.0  # size of a value; 0: the mean of those measured
    instead: ClassVar[str] = ""  # what to take where the points cannot be followed

    @classmethod
    def asked(
        cls, points: Measured, fit: Sequence[str] | None, given: set[str]
    ) -> tuple[Measured, tuple[str, ...]]:
        """Return the points and the parameters to fit; the points have inputs ``given``."""
        spec = points.plan.spec
        real = [f.name for f in fields(spec.params) if f.metadata["kind"] == "real"]
        names = chosen_names(fit or (), real, f"real parameters of {spec.name}")
        if len(points.value) < len(names):
            sizes = f"{counted(len(points.value), 'value')} for {counted(len(names), 'parameter')}"
            raise ParameterError(f"data: {sizes}, allowed: as many values as parameters, or more")
        check_level(spec, points.plan.fidelity, points.plan.params[0])
        return points, names

    @classmethod
    def change_of(cls, points: Measured, name: str) -> float:
        """Return a change of a parameter that would certainly matter; 0: as its range says."""
        return 0.0

    @classmethod
    def held(cls, params: object) -> dict[str, Any]:
        """Return what the outputs depend on next to the fitted parameters and the points' own."""
        return {}

    @classmethod
    def of(
        cls, points: Measured, names: tuple[str, ...], bounds: Mapping[str, tuple[float, float]]
    ) -> tuple[Self, Array]:
        """Return what is to be solved and the guess before the fit."""
        metas = {f.name: f.metadata for f in fields(points.plan.spec.params)}
        for name in bounds:
            if name not in names:
                raise ParameterError(f"bounds of {name}: allowed: of {', '.join(names)}, as fitted")
        params, rows = points.plan.params[0], []
        for name in names:
            start, change = getattr(params, name), cls.change_of(points, name)
            rows.append(_range_of(name, metas[name], start, bounds.get(name), change))
        low, high, first, scale, by_logarithm = np.array(rows).T
        usual = cls.typical or np.abs(points.value).mean() or 1.0
        even = np.full(len(points.value), 1.0 / usual)
        if points.count is not None:
            even *= np.sqrt(points.count / points.count.mean())
        problem = cls(
            base=cls.held(params),
            names=names,
            measured=points.value,
            points=points,
            weight=even if points.error is None else 1.0 / points.error,
            low=low,
            high=high,
            scale=scale,
            logarithmic=by_logarithm > 0.0,
            units={name: metas[name]["unit"] for name in names},
            known_errors=points.error is not None,
        )
        return problem, first

    def curve(self, guess: Array) -> Array:
        """Return the outputs, in the order of the measured values; NaN where a point fails."""
        values = self.values(guess)
        key = tuple(sorted(values.items()))
        if key not in self.kept:
            if len(self.kept) > MOST_KEPT:
                self.kept.clear()
            self.kept[key] = self.points.computed(values)[0]
        return self.kept[key]

    def slopes_of_curve(self, guess: Array) -> Array:
        """Return the derivatives of the outputs: the model's, or differences of solutions.

        Central ones; at a bound, or where one side has no solution, those of the other side.
        """
        exact = self.points.slopes(self.values(guess), self.names)
        if exact is not None:
            return exact * self.derivative(guess)
        here, columns = self.curve(guess), []
        for i, step in enumerate(STEP * self.scale):
            places, values = [], []
            for end in (max(guess[i] - step, self.low[i]), min(guess[i] + step, self.high[i])):
                there = self.curve(np.where(np.arange(len(guess)) == i, end, guess))
                values.append(np.where(np.isfinite(there), there, here))
                places.append(np.where(np.isfinite(there), end, guess[i]))
            width = places[1] - places[0]
            if not width.any():
                raise SolveError(
                    f"fit = {self.names[i]!r}: next to {self.shown(guess)[i]:g} no point has a "
                    f"solution with fidelity level {self.points.plan.fidelity!r}; choose "
                    f"another fidelity level or "
                    "start"
                )
            rise = np.where(width > 0.0, values[1] - values[0], 0.0)
            columns.append(rise / np.where(width > 0.0, width, 1.0))
        return np.column_stack(columns)

    def check_first(self, first: Array) -> None:
        """Raise an error for the first point that the parameters before the fit do not solve."""
        points, plan = self.points, self.points.plan
        computed = self.curve(first)
        if np.isfinite(computed).all():
            return
        failed = points.computed(self.values(first))[1]
        i = int(np.argmin(np.isfinite(computed)))
        row, name, own = (
            int(points.row[i]),
            points.output[i],
            find_model(plan.spec.key).fits,
        )
        inputs = (f"{key} {plan.shown[key][row]:g}" for key in plan.shown if key in plan.units)
        where = f"point {row + 1} ({', '.join(inputs)}): {name}"
        if name in own.units:
            cure = "leave it out, or start nearer with --set NAME=VALUE"
            raise SolveError(f"{where} has no solution: {own.none}; {cure}")
        if row in failed:
            raise SolveError(f"{where} has no solution: {failed[row].advice}")
        raise ParameterError(f"{where} is {computed[i]}, allowed: finite outputs")

    def result(
        self, params: Any, found: Mapping[str, Any], first: Array, judged: list[Verdict]
    ) -> Calibration:
        """Return the calibration of parameters with fitted values; ``first`` are those before."""
        warnings = self.warnings(found["_best"], first, judged)
        return Calibration(params=params, points=self.points, warnings=warnings, **found)

    def drawn_over(self, output: str) -> dict[str, tuple[str, Array]]:
        """Return unit and values of the inputs of all measured values, over which one is drawn."""
        plan, own = self.points.plan, find_model(self.points.plan.spec.key).fits
        left_out = own.without if output in own.units else ""
        names = (name for name in plan.units if name != left_out)
        return {name: (plan.units[name], plan.shown[name][self.points.row]) for name in names}

    def warnings(self, best: Array, first: Array, judged: list[Verdict]) -> tuple[str, ...]:
        """Return what is wrong with the fit as a whole, the gravest first: "headline: details"."""
        far, poor = self.misses(best, judged, 1.0 / self.weight if self.known_errors else None)
        return (*self.doubts(), *far, *poor)

    def doubts(self) -> tuple[str, ...]:
        """Return what is doubtful about the points themselves."""
        count, few = len(self.names), tuple[str, ...]()
        if len(self.measured) == count:
            few = (
                f"as many values as parameters ({count}): the fit goes through all points, and "
                "nothing tells how good it is; measure more",
            )
        return (*self.points.plan.warnings, *few)

    def missed_because(self, judged: list[Verdict]) -> str:
        """Return what keeps the fit from the points."""
        stops = (
            f"{name} is at its {verdict.reason.rpartition('at its ')[2]}"
            for name, verdict in zip(self.names, judged, strict=True)
            if "pull beyond" in verdict.reason
        )
        return "; ".join(stops) or "its curve has another shape than theirs"

    def misses(
        self, best: Array, judged: list[Verdict], scatter: Array | None
    ) -> tuple[list[str], list[str]]:
        """Return sentences on outputs that are missed by more than the points scatter, if known.

        And on those whose residuals are a large part of the output itself.
        """
        far, poor, units = [], [], output_units(self.points.plan.spec)
        residuals, points = self.curve(best) - self.measured, self.points
        why = self.missed_because(judged)
        for name in points.names:
            chosen, unit = points.of(name), f" {units[name]}".removesuffix(" 1")
            rms = float(np.sqrt(np.mean(residuals[chosen] ** 2)))
            mean = float(np.abs(self.measured[chosen]).mean()) or 1.0
            usual = np.inf if scatter is None else float(np.sqrt(np.mean(scatter[chosen] ** 2)))
            share = f"{100 * rms / mean:.0f} % of the mean {name}"
            if rms > max(SCATTERS * usual, MATERIAL * mean):
                far.append(
                    f"The {self.law} misses the points by more than they scatter (rms residual "
                    f"{rms:.3g}{unit}, {share}; scatter about {usual:.2g}{unit}): "
                    f"{why}{self.instead and '; or ' + self.instead}."
                )
            if rms > POOR * mean:
                poor.append(
                    f"The rms residual is {share}: values and intervals describe the nearest curve "
                    f"of this {self.law}, not the part"
                    f"{self.instead and '; if they do not just scatter, ' + self.instead}."
                )
        return far, poor


def _range_of(
    name: str,
    meta: Mapping[str, Any],
    start: float,
    bounds: tuple[float, float] | None,
    change: float,
) -> tuple[float, float, float, float, bool]:
    """Return lower and upper bound, first guess and scale of a parameter, and if by logarithm."""
    least, largest, elsewhere = meta["min"], meta["max"], ELSEWHERE in meta["help"]
    if elsewhere and start == 0.0:
        raise ParameterError(
            f"fit = {name!r}: is 0, which stands for another value ({meta['help']}); "
            "give the value to start from"
        )
    low, high = bounds or (1e-3 * start if elsewhere else least, largest)
    if not least <= low < high <= largest:
        raise ParameterError(
            f"bounds of {name} = {low:g}:{high:g}, allowed: low < high in {allowed(meta)}"
        )
    start = min(max(start, low), high)
    if change > 0.0:
        return low, high, start, change, False
    if low > 0.0 and (high >= DECADE * low or largest >= DECADE * least > 0.0):
        a, b, c = np.log([low, high, start]).tolist()
        a, b = a + INSIDE, b - INSIDE
        return a, b, min(max(c, a), b), min(1.0, 0.5 * (b - a)), True
    half = 0.5 * (high - low)
    return low, high, start, max(min(abs(start) or half, half), LEAST_SHARE * half), False
