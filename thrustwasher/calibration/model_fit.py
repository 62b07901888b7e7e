"""Fit parameters of a model, or a law of its own, to measured outputs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ..errors import ParameterError
from ..model.part_file import PartFile, find_part
from ..model.record import resolve
from ..model.registry import find_model, models_with_points
from ..model.spec import ModelSpec
from .estimates import Calibration
from .fit import fitted
from .measured import measured, own_outputs
from .model_problem import ModelProblem

ModelCalibration = Calibration  # its name while a law's fit was another one


def calibrate(
    part: Any,
    data: Mapping[str, Any] | None = None,
    *,
    fit: Sequence[str] | None = None,
    errors: Mapping[str, float | str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    at: Mapping[str, Any] | None = None,
    fidelity: str | None = None,
    confidence: float = 0.95,
    profile: bool | None = None,
    **columns: Any,
) -> Any:
    """Fit parameters of a model to measured outputs, and say what the points can tell.

    Measured ``friction`` [-] of a clutch gives constants of its law of friction (see
    thrustwasher.clutch.calibration.friction_fit).

    Parameters
    ----------
    part : parameters, a part (``load_part``), or the key of a model with its defaults; the first
        guess, and what is not fitted
    data : columns of one length by name [SI], also as keywords: inputs and parameters of the
        points (one number is that of all), measured outputs (None where not measured),
        ``<output>_error``: their standard deviation. Points with the same number in a column
        ``line`` are walked as a sweep does. A washer's folds are ``film_loss_load`` and
        ``film_regain_load`` [N]
    fit : names of real parameters; of a law, by default those that a curve can tell
    errors : standard deviation by output, for all points: a number [SI], or a text with a unit;
        "2 %" is of the measured value. Several outputs need errors; without, scatter of one counts
    bounds : narrower range by parameter [SI]
    at : inputs and parameters that all points share; of what is fitted, the first guess
    fidelity : rung of the model, default that of the part
    confidence : probability of the intervals, above 0 and below 1
    profile : also compute profile intervals, which takes several times as long; a law's are quick
        and computed unless False

    Returns
    -------
    Calibration : fitted ``params``; value, interval and verdict of every parameter; ``warnings`` of
        points that the fit cannot follow

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
    >>> data = {"power": power, "speed": 180.0, "friction_torque": loss}
    >>> start = GearMeshParams(friction_law="constant")
    >>> found = calibrate(start, data, fit=["constant_friction"])
    >>> round(found.params.constant_friction, 6)
    0.06
    """
    spec, params, rung = _start(part)
    data, at = {**(data or {}), **columns}, at or {}
    own = own_outputs(spec)
    is_law = not own.computed and not own.units.keys().isdisjoint(data)
    kind: type[ModelProblem] = resolve(find_model(spec.key).fits.law) if is_law else ModelProblem
    params, names = kind.asked(spec, params, fit, {*data, *at})
    if twice := set(names) & set(data):
        raise ParameterError(
            f"fit = {twice.pop()!r}: is a column of the data, allowed: one of both"
        )
    points = measured(spec, params, data, at, errors or {}, fidelity or rung)
    points = kind.checked(points, names)
    problem, first = kind.of(points, names, bounds or {})
    problem.check_first(first)
    found, judged = fitted(
        problem, first, confidence, kind.profiles if profile is None else profile
    )
    changes = {e.name: e.value for e in found["estimates"]}
    return problem.result(replace(points.plan.params[0], **changes), found, first, judged)


def _start(part: Any) -> tuple[ModelSpec, Any, str]:
    """Return the model, its parameters before the fit and its usual rung."""
    part = find_part(part) if isinstance(part, str) else part
    if isinstance(part, PartFile):
        return part.spec, part.params, part.fidelity
    for model in models_with_points().values():
        if isinstance(part, model.spec.params):
            return model.spec, part, model.spec.default_fidelity
    known = ", ".join(models_with_points())
    raise ParameterError(f"part: {type(part).__name__}, allowed: a part or parameters of {known}")
