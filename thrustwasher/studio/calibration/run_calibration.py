"""Fit parameters of a model, or a law of its own, to measured outputs: ``calibrate``."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ...errors import ParameterError
from ...model.parameters import written_out
from ...model.part_file import PartFile, find_part
from ...model.registry import find_model, models_with_points
from ...storage.tables.given import columns_given, is_table
from .engagement.trace_fit import TRACES
from .fit import fitted
from .friction.friction_fit import FrictionFit
from .least_squares import best_fit
from .measured import column_units, measured
from .model_fit import ModelProblem
from .row_groups import grouped
from .traces.recording import Traces

# Model -> what fits the outputs that no solution at a point has, by a law of the model's own.
LAWS: dict[str, type[ModelProblem]] = {"clutch": FrictionFit}
# Model -> what fits it to recordings over time.
RECORDED: dict[str, Traces] = {"clutch": TRACES}
PASSES = 2  # of a fit to means, each with the curvature at the one before


def calibrate(
    part: object,
    data: Any = None,
    *,
    fit: Sequence[str] | None = None,
    errors: Mapping[str, float | str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    at: Mapping[str, object] | None = None,
    fidelity: str | None = None,
    confidence: float = 0.95,
    profile: bool | None = None,
    **columns: object,
) -> Any:
    """Fit parameters of a model to measured outputs, and say what the points can tell.

    Measured ``friction`` [-] of a clutch gives constants of its law of friction (see
    thrustwasher.studio.calibration.friction).

    Parameters
    ----------
    part : parameters, a part (``load_part``), or the key of a model with its defaults; the first
        guess, and what is not fitted
    data : a path, a ``pandas.DataFrame`` (units in ``attrs["units"]``) or an ``asammdf.MDF``; or
        columns of one length by name [SI], also as keywords: inputs and parameters of the
        points (one number is that of all), measured outputs (None where not measured),
        ``<output>_error``: their standard deviation. Points with the same number in a column
        ``line`` are walked as a sweep does. A washer's folds are ``film_loss_load`` and
        ``film_regain_load`` [N]
    fit : names of real parameters; of a law, by default those that a curve can tell
    errors : standard deviation by output, for all points: a number [SI], or a text with a unit;
        "2 %" is of the measured value. Several outputs need errors; without, scatter of one counts
    bounds : narrower range by parameter [SI]
    at : inputs and parameters that all points share; of what is fitted, the first guess
    fidelity : level of the model, default that of the part
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
    start, params = _start(part)
    spec = start.spec
    if is_table(data):
        data = columns_given(data, column_units(spec))
    elif not isinstance(data, Mapping | None):
        raise ParameterError(
            f"data: {type(data).__name__}, allowed: columns by name, a path, a DataFrame, an MDF"
        )
    data, at = {**(data or {}), **columns}, at or {}
    own = find_model(spec.key).fits
    is_law = not own.computed and not own.units.keys().isdisjoint(data)
    kind = LAWS.get(spec.key, ModelProblem) if is_law else ModelProblem
    points = measured(start, params, data, at, errors or {}, fidelity or start.fidelity)
    held = tuple(p and written_out(p, fit or ()) for p in points.plan.params)
    points = replace(points, plan=replace(points.plan, params=held))
    groups = grouped(points) if kind.by_level else None
    points, names = kind.asked(groups.means if groups else points, fit, {*data, *at})
    if twice := set(names) & set(data):
        raise ParameterError(
            f"fit = {twice.pop()!r}: is a column of the data, allowed: one of both"
        )
    problem, first = kind.of(points, names, bounds or {})
    problem.check_first(first)
    guess = first
    for _ in range(PASSES if groups else 0):
        assert groups is not None
        there = groups.straightened(problem.values(guess))
        problem = replace(problem, points=there, measured=there.value)
        guess = best_fit(problem, guess)
    found, judged = fitted(
        problem, first, confidence, kind.profiles if profile is None else profile
    )
    changes = {e.name: e.value for e in found["estimates"]}
    return problem.result(replace(points.plan.params[0], **changes), found, first, judged)


def _start(part: object) -> tuple[PartFile, Any]:
    """Return the part and its parameters before the fit."""
    part = find_part(part) if isinstance(part, str) else part
    if isinstance(part, PartFile):
        return part, part.params
    for model in models_with_points().values():
        if isinstance(part, model.spec.params):
            return find_part(model.key), part
    known = ", ".join(models_with_points())
    raise ParameterError(f"part: {type(part).__name__}, allowed: a part or parameters of {known}")
