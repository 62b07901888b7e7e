"""What of a washer can be fitted in addition to its outputs, and how it depends on parameters."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from ..errors import FIRST_FAILURE, ParameterError, SolveError
from ..model.prepare import filled
from ..model.record import Fits
from ..numerics.jit import Array
from .kernels import step as k
from .kernels.newton import LOAD
from .load_curve import LoadCurve, load_curve
from .parameters import SPEC, WasherParams
from .sensitivities import OUTPUTS, Linearised, fold_derivatives, free_parameters
from .solve import GRIDS
from .washer_result import INPUTS

NAMES = {"film_lost": "film_loss_load", "film_regained": "film_regain_load"}


def _folded_curve(
    params: WasherParams, point: Mapping[str, float], fidelity: str
) -> LoadCurve | None:
    place: Any = {name: value for name, value in point.items() if name != "load"}
    for load_max in (3e3, 1e4):
        try:
            curve = load_curve(params, **place, fidelity=fidelity, load_max=load_max)
        except SolveError:
            return None
        if curve.folds:
            return curve
    return None


def fold_loads(params: WasherParams, point: Mapping[str, float], fidelity: str) -> dict[str, float]:
    """Return the loads [N] at which the film is lost and regained; no such fold: not in it."""
    curve = _folded_curve(params, point, fidelity)
    return {NAMES[fold.kind]: fold.load for fold in reversed(curve.folds)} if curve else {}


def slopes(
    params: WasherParams,
    inputs: Array,
    fidelity: str,
    wanted: Sequence[tuple[int, str]],
    names: Sequence[str],
) -> Array | None:
    """Return exact derivatives (wanted, names) of outputs of a line's rows and of fold loads.

    The rows are walked as a sweep does. None: the level is a table, an output or parameter has no
    such derivative, a row no solution, or a fold is too flat.
    """
    measured, folded = {o for _, o in wanted} - set(NAMES.values()), set(NAMES.values())
    if fidelity == "map" or not measured <= OUTPUTS.keys():
        return None
    try:
        rows = _of_rows(params, inputs, fidelity, names) if measured else {}
        curves = {
            row: _of_folds(params, inputs[row], fidelity, names)
            for row in {row for row, output in wanted if output in folded}
        }
        found = [curves[r][o] if o in folded else rows[r][OUTPUTS[o]] for r, o in wanted]
    except (ParameterError, SolveError, KeyError):
        return None
    return np.array(found)


@lru_cache(maxsize=16)
def _constants(params: WasherParams, fidelity: str) -> Any:
    """Return the kernel's ``par``; many lines share their parameters."""
    return filled(SPEC, params, fidelity, k.NPAR, k.derive)


def _of_rows(
    params: WasherParams, inputs: Array, fidelity: str, names: Sequence[str]
) -> dict[int, Array]:
    """Return the derivatives (outputs, names) of each row that has a solution."""
    par = _constants(params, fidelity)
    state, work, out = np.zeros(k.NSTATE), np.zeros(k.NWORK), np.zeros(k.NOUT)
    by_name = {v.name: v for v in free_parameters(params, names)}
    varied, found = [by_name[name] for name in names], {}
    for row, point in enumerate(inputs):
        status = k.step(par, point, state, work, out, np.zeros(k.NIOUT, np.int32), 0.0, 1.0)
        if status >= FIRST_FAILURE:
            continue
        load, speed, tilt, oil, far = point.tolist()
        here = Linearised(params, GRIDS[fidelity], (load, speed, tilt, oil, far), state)
        found[row] = here.changes(LOAD, varied).T
    return found


def _of_folds(
    params: WasherParams, point: Array, fidelity: str, names: Sequence[str]
) -> dict[str, list[float]]:
    """Return the derivatives of a curve's fold loads over the named parameters."""
    curve = _folded_curve(params, dict(zip(INPUTS, point.tolist(), strict=True)), fidelity)
    found = {}
    for fold in reversed(curve.folds if curve else []):
        row = fold_derivatives(*curve.around(fold), names) if curve else None
        if row is None:
            raise SolveError(f"{fold.kind}: its slope does not show it")
        found[NAMES[fold.kind]] = [row[name] for name in names]
    return found


FITS = Fits(
    sliding_radius=lambda params: params.outer_radius,
    units={"film_loss_load": "N", "film_regain_load": "N"},
    computed=fold_loads,
    without="load",
    none="no such fold on the load curve",
    slopes=slopes,
)
