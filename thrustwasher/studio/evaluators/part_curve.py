"""The loads at which a washer loses its film and gets it back, as figures of a part."""

from collections.abc import Mapping, Sequence
from typing import Any

from ...washer.load_curve import MOST, LoadCurve, load_curve
from ...washer.parameters import face_of

FOLDS = {
    "film_lost_load": ("film_lost", "load at which the oil film is lost, from below"),
    "film_regained_load": ("film_regained", "load at which the oil film comes back, from above"),
}
SEARCHED = (9, 20)  # nodes of a load curve while designs are searched
MOST_LOAD = 1e4  # N, end of a load curve of the default face; of larger ones in proportion
AT = ("speed", "tilt", "oil_temperature", "far_face_temperature")  # inputs of a load curve


def curve_of(params: Any, inputs: Mapping[str, float], level: str, *, closely: bool) -> LoadCurve:
    """Return the load curve of a washer, to larger loads where it has no fold.

    On few nodes unless ``closely``. ParameterError, SolveError: as of ``load_curve``.
    """
    point: Any = {name: inputs[name] for name in AT}
    grid = None if closely else SEARCHED
    curve = load_curve(params, **point, fidelity=level, grid=grid)
    if not curve.folds:
        most = _most_load(params)
        curve = load_curve(params, **point, fidelity=level, grid=grid, load_max=most)
    return curve


def fold_loads(curve: LoadCurve) -> dict[str, float]:
    """Return the load of the first fold of each kind, by the figure's name."""
    first = {fold.kind: fold.load for fold in reversed(curve.folds)}
    return {name: first[kind] for name, (kind, _) in FOLDS.items() if kind in first}


def fold_slopes(
    curve: LoadCurve, parameters: Sequence[str]
) -> dict[str, tuple[float, Mapping[str, float]]]:
    """Return load and derivatives of the first fold of each kind that has them."""
    found: dict[str, tuple[float, Mapping[str, float]]] = {}
    tables = curve.fold_sensitivities(parameters)
    for name, (kind, _) in FOLDS.items():
        for fold, table in zip(curve.folds, tables, strict=True):
            if fold.kind == kind and table is not None and name not in found:
                found[name] = fold.load, table
    return found


def _most_load(params: Any) -> float:
    """Return the end of a load curve [N]."""
    usual = type(params)()
    faces = [face_of(p.inner_radius, p.outer_radius) for p in (params, usual)]
    return min(MOST_LOAD * max(faces[0] / faces[1], 1.0), MOST)
