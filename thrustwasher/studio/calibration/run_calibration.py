"""Fit parameters of a model, or a law of its own, to measured outputs: ``calibrate``."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from typing import Any

from ...errors import ParameterError
from ...model.registry import find_model
from ...storage.tables.given import columns_given, is_table
from ...storage.tables.table import Columns
from ..evaluators.evaluator import texts
from ..evaluators.make import part_of
from ..jobs.progress import counted_runs
from .engagement.trace_fit import TRACES
from .estimates import Calibration, remarks
from .fit import Asked
from .friction.friction_fit import fit_law
from .measured import Measured, column_units, decided, measured
from .model_fit import fit_points
from .traces.recording import Traces

# Model -> what fits the outputs that no solution at a point has, by a law of the model's own.
LAWS: dict[str, Callable[[Measured, Asked], Calibration]] = {"clutch": fit_law}
# Model -> what fits it to recordings over time.
RECORDED: dict[str, Traces] = {"clutch": TRACES}


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
    progress: bool | Callable[[int, int | None], None] | None = None,
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
    progress : True: a bar of tqdm, or a line, on the terminal; or called with evaluations of all
        points done and None: nobody knows how many there will be; at the end with their number

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
    start, at = part_of(part), at or {}
    name = str(data) if isinstance(data, str | PathLike) else type(data).__name__
    if is_table(data):
        data = columns_given(data, column_units(start.spec))
    elif not isinstance(data, Mapping | None):
        raise ParameterError(
            f"data: {type(data).__name__}, allowed: columns by name, a path, a DataFrame, an MDF"
        )
    written = data.units if isinstance(data, Columns) else {}
    said = data.remarks if isinstance(data, Columns) else ()
    data = {start.flat_name(name): column for name, column in {**(data or {}), **columns}.items()}
    fit = (fit,) if isinstance(fit, str) else fit
    fit = fit and [start.flat_name(name) for name in fit]
    bounds = {start.flat_name(name): ends for name, ends in (bounds or {}).items()}
    errors = {start.flat_name(name): error for name, error in (errors or {}).items()}
    own = find_model(start.spec.key).fits
    is_law = not own.computed and not own.units.keys().isdisjoint(data)
    points = measured(start, data, at, errors, fidelity or start.fidelity)
    fit_to = LAWS.get(start.spec.key, fit_points) if is_law else fit_points
    with counted_runs(progress, "fit, evaluations") as ran:
        asked = Asked(fit, {*data}, {*at}, bounds, confidence, profile, ran)
        found = fit_to(decided(points, fit or ()), asked)
    notes = [
        *texts(found.remarks, "note"),
        *([f"{name}: read with {', '.join(said)}."] if said else []),
    ]
    return replace(found, remarks=remarks(texts(found.remarks, "warning"), notes), written=written)
