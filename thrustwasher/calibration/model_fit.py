"""Fit parameters of any model that is solved at operating points to measured outputs."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from ..errors import ParameterError, SolveError
from ..model.parameters import allowed
from ..model.part_file import PartFile, find_part
from ..model.record import absent_outputs, resolve
from ..model.registry import find_model, models_with_points
from ..numerics.jit import Array
from ..sweep.solve_rows import check_rung
from .estimates import Calibration, Series, size_text
from .fit import chosen_names, fitted
from .identifiability import counted
from .least_squares import Problem
from .measured import Measured, measured, output_units

STEP = 1e-3  # of a parameter's scale, for differences of converged solutions
DECADE = 10.0  # a range this wide, above 0, is one of logarithms
LEAST_SHARE = 0.1  # of half the range: the least change that would certainly matter
ELSEWHERE = "(0:"  # in the meaning of a parameter whose 0 stands for another one's value
INSIDE = 1e-13  # of a logarithmic range: rounding does not lead out of it
MOST_KEPT = 200


@dataclass(frozen=True, kw_only=True)
class ModelProblem(Problem):
    """Measured outputs of a model and its parameters; ``base``: parameters that are held."""

    points: Measured
    kept: dict[tuple[Any, ...], Array] = field(default_factory=dict, repr=False)

    rough, fine, resolution, evaluations = 1e-5, 1e-8, 1e-7, 80
    subject, counted_as, error_name = "outputs", "value", "their error"

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
        """Return the derivatives of the outputs from differences of converged solutions.

        Central ones; at a bound, or where one side has no solution, those of the other side.
        """
        here, columns = self.curve(guess), []
        for i, step in enumerate(STEP * self.scale):
            places, values = [], []
            for end in (max(guess[i] - step, self.low[i]), min(guess[i] + step, self.high[i])):
                there = self.curve(np.where(np.arange(len(guess)) == i, end, guess))
                values.append(np.where(np.isfinite(there), there, here))
                places.append(np.where(np.isfinite(there), end, guess[i]))
            width = places[1] - places[0]
            if not width.any():
                name, rung = self.names[i], self.points.plan.fidelity
                raise SolveError(
                    f"fit = {name!r}: beside {self.shown(guess)[i]:g} no point has a solution with "
                    f"rung {rung!r}; choose another rung or start"
                )
            columns.append(np.where(width > 0.0, values[1] - values[0], 0.0)
                           / np.where(width > 0.0, width, 1.0))  # fmt: skip
        return np.column_stack(columns)


@dataclass(frozen=True, eq=False, kw_only=True)
class ModelCalibration(Calibration):
    """Parameters of a model fitted to measured outputs; ``str()`` of it is a summary."""

    points: Measured
    fitted: Array
    """(n,) computed outputs, in the order of ``points.value``."""

    def residuals_of(self, output: str) -> Array:
        """Return measured less fitted values of one output [SI]."""
        found: Array = self.residuals[np.array(self.points.output) == output]
        return found

    def rms_of(self, output: str) -> float:
        """Return the root mean square of an output's residuals [SI]."""
        return float(np.sqrt(np.mean(self.residuals_of(output) ** 2)))

    def as_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; None stands for infinite and for not known."""
        points = self.points
        return {
            **super().as_dict(),
            "model": points.plan.spec.key,
            "fidelity": points.plan.fidelity,
            "rms": {name: self.rms_of(name) for name in points.names},
            "point": (points.row + 1).tolist(),
            "output": list(points.output),
            "measured": points.value.tolist(),
            "computed": self.fitted.tolist(),
            "error": None if points.error is None else points.error.tolist(),
        }

    def shown(self) -> list[Series]:
        """Return the outputs to be drawn over their inputs."""
        points, plan, found = self.points, self.points.plan, []
        fits = find_model(plan.spec.key).fits
        for name in points.names:
            chosen = np.array(points.output) == name
            left_out = fits.without if name in fits.more else ""
            known = {n: unit for n, unit in plan.units.items() if n != left_out}
            inputs = {n: (unit, plan.shown[n][points.row[chosen]]) for n, unit in known.items()}
            found.append(self.series(name, output_units(plan.spec)[name], inputs, chosen))
        return found

    def summary(self) -> list[str]:
        """Return sentences on what was fitted to what."""
        points, units = self.points, output_units(self.points.plan.spec)
        parts = ", ".join(f"{points.output.count(name)} {name}" for name in points.names)
        told = f"{counted(len(points.value), 'value')} ({parts}), rung {points.plan.fidelity}"
        rms = (f"{self.rms_of(n):.3g} {units[n]}".removesuffix(" 1") for n in points.names)
        said = " ".join(e.reason for e in self.estimates)
        blurred = [f"Together: {text}." for text in self.confounded if text not in said]
        return [size_text(self, told, ", ".join(rms)), *blurred]


def calibrate(
    part: Any, data: Mapping[str, Sequence[Any]] | None = None, *,
    fit: Sequence[str] | None = None, errors: Mapping[str, float | str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None, at: Mapping[str, Any] | None = None,
    fidelity: str | None = None, confidence: float = 0.95, profile: bool | None = None,
    **law: Any,
) -> Any:  # fmt: skip
    """Fit parameters of a model to measured outputs, and say what the points can tell.

    Without ``data`` the model's own law is fitted: the clutch's friction law to ``speed``,
    ``load`` and ``friction`` (see thrustwasher.clutch.calibration.calibration.calibrate).

    Parameters
    ----------
    part : parameters, a part (``load_part``), or the key of a model with its defaults; the first
        guess, and what is not fitted
    data : columns of one length by name [SI]: inputs and parameters of the points, measured
        outputs (None where not measured), ``<output>_error``: their standard deviation. Points
        with the same number in a column ``line`` are walked as a sweep does. A washer's folds are
        ``film_loss_load`` and ``film_regain_load`` [N]
    fit : names of real parameters
    errors : standard deviation by output, for all points: a number [SI], or a text with a unit;
        "2 %" is of the measured value. Several outputs need errors; without, scatter of one counts
    bounds : narrower range by parameter [SI]
    at : inputs and parameters that all points share; of what is fitted, the first guess
    fidelity : rung of the model, default that of the part
    confidence : probability of the intervals, above 0 and below 1
    profile : also compute profile intervals, which takes several times as long

    Returns
    -------
    ModelCalibration : fitted ``params``; value, interval and verdict of every parameter

    Raises
    ------
    ParameterError : wrong columns, numbers or names, fewer values than parameters
    SolveError : a point has no solution before the fit, or the fit did not converge

    Notes
    -----
    Source: derived in docs/theory/calibration.md.

    Examples
    --------
    >>> from thrustwasher import GearMeshParams, solve_gearmesh
    >>> truth = GearMeshParams(friction_law="constant", constant_friction=0.06)
    >>> power = [2e3, 5e3, 9e3]
    >>> loss = [solve_gearmesh(truth, power=p, speed=180.0).friction_torque for p in power]
    >>> data = {"power": power, "speed": [180.0] * 3, "friction_torque": loss}
    >>> start = GearMeshParams(friction_law="constant")
    >>> found = calibrate(start, data, fit=["constant_friction"])
    >>> round(found.params.constant_friction, 6)
    0.06
    """
    start, params = _start(part)
    spec = start.spec
    if data is None:
        own = find_model(spec.key).fits.law
        if not own:
            raise ParameterError(f"data is missing: measured points of {spec.name}")
        profile = profile is None or profile
        return resolve(own)(params, **law, fit=fit, confidence=confidence, profile=profile)
    if law:
        raise ParameterError(f"{next(iter(law))}: allowed: without data, for a law of friction")
    real = [f.name for f in fields(spec.params) if f.metadata["kind"] == "real"]
    names = chosen_names(fit or (), real, f"real parameters of {spec.name}")
    if twice := set(names) & set(data):
        raise ParameterError(
            f"fit = {twice.pop()!r}: is a column of the data, allowed: one of both"
        )
    points = measured(
        start, params, data, at or {}, errors or {}, fidelity or start.fidelity
    )  # fmt: skip
    if len(points.value) < len(names):
        told = f"{counted(len(points.value), 'value')} for {counted(len(names), 'parameter')}"
        raise ParameterError(f"data: {told}, allowed: as many values as parameters, or more")
    check_rung(spec, points.plan.fidelity, points.plan.params[0])
    problem, first = _problem(points, names, bounds or {})
    _check_first(points, problem.values(first))
    found, _ = fitted(problem, first, confidence, bool(profile))
    changes = {e.name: e.value for e in found["estimates"]}
    return ModelCalibration(
        params=replace(points.plan.params[0], **changes), points=points,
        warnings=tuple(_doubts(points, len(names))),
        fitted=problem.curve(found["_best"]), **found,
    )  # fmt: skip


def _doubts(points: Measured, unknowns: int) -> Iterator[str]:
    """Yield what a reader of a fit must not miss beside its verdicts."""
    yield from points.plan.warnings
    if len(points.value) == unknowns:
        yield (f"as many values as parameters ({unknowns}): the fit goes through all points, and "
               "nothing tells how good it is; measure more")  # fmt: skip


def _start(part: Any) -> tuple[PartFile, Any]:
    """Return the part and its parameters before the fit."""
    part = find_part(part) if isinstance(part, str) else part
    if isinstance(part, PartFile):
        return part, part.params
    for model in models_with_points().values():
        if isinstance(part, model.spec.params):
            return find_part(model.key), part
    known = ", ".join(models_with_points())
    raise ParameterError(f"part: {type(part).__name__}, allowed: a part or parameters of {known}")


def _problem(
    points: Measured, names: tuple[str, ...], bounds: Mapping[str, tuple[float, float]]
) -> tuple[ModelProblem, Array]:
    """Return what is to be solved and the guess before the fit."""
    metas = {f.name: f.metadata for f in fields(points.plan.spec.params)}
    for name in bounds:
        if name not in names:
            raise ParameterError(f"bounds of {name}: allowed: of {', '.join(names)}, the fitted")
    start = points.plan.params[0]
    rows = [_range_of(n, metas[n], getattr(start, n), bounds.get(n)) for n in names]
    low, high, first, scale, by_logarithm = np.array(rows).T
    known = points.error is not None
    weight = np.full(len(points.value), 1.0 / (np.abs(points.value).mean() or 1.0))
    problem = ModelProblem(
        base={}, names=names, measured=points.value, points=points, known_errors=known,
        weight=weight if points.error is None else 1.0 / points.error, low=low, high=high,
        scale=scale, logarithmic=by_logarithm > 0.0, units={n: metas[n]["unit"] for n in names},
    )  # fmt: skip
    return problem, first


def _range_of(
    name: str, meta: Mapping[str, Any], start: float, bounds: tuple[float, float] | None
) -> tuple[float, float, float, float, bool]:
    """Return least, largest and first guess of a parameter, its scale, and if by its logarithm."""
    least, largest, elsewhere = meta["min"], meta["max"], ELSEWHERE in meta["help"]
    if elsewhere and start == 0.0:
        raise ParameterError(f"fit = {name!r}: is 0, which stands for another value "
                             f"({meta['help']}); give the value to start from")  # fmt: skip
    low, high = bounds or (1e-3 * start if elsewhere else least, largest)
    if not least <= low < high <= largest:
        raise ParameterError(
            f"bounds of {name} = {low:g}:{high:g}, allowed: low < high in {allowed(meta)}"
        )
    start = min(max(start, low), high)
    if low > 0.0 and (high >= DECADE * low or largest >= DECADE * least > 0.0):
        a, b, c = np.log([low, high, start]).tolist()
        a, b = a + INSIDE, b - INSIDE
        return a, b, min(max(c, a), b), min(1.0, 0.5 * (b - a)), True
    half = 0.5 * (high - low)
    return low, high, start, max(min(abs(start) or half, half), LEAST_SHARE * half), False


def _check_first(points: Measured, values: Mapping[str, float]) -> None:
    """Raise an error for the first point that the parameters before the fit do not solve."""
    computed, failed = points.computed(values)
    if np.isfinite(computed).all():
        return
    i = int(np.argmin(np.isfinite(computed)))
    row, name, plan = int(points.row[i]), points.output[i], points.plan
    inputs = (f"{key} {plan.shown[key][row]:g}" for key in plan.shown if key in plan.units)
    where = f"point {row + 1} ({', '.join(inputs)}): {name}"
    if name in find_model(plan.spec.key).fits.more:
        raise SolveError(f"{where} has no solution: no such fold on the load curve; leave it "
                         "out, or start nearer with --set NAME=VALUE")  # fmt: skip
    if row in failed:
        raise SolveError(f"{where} has no solution: {failed[row].advice}")
    if name in absent_outputs(plan.spec, plan.params[0]):
        about = next(s.help for s in plan.spec.outputs if s.name == name)
        raise ParameterError(f"{name}: has no value with these parameters ({about})")
    raise ParameterError(f"{where} is {computed[i]}, allowed: finite outputs")
