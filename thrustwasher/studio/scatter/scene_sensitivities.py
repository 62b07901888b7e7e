"""How the figures of a gear shift follow the numbers of its scene: differences that are checked."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...errors import ParameterError, suggestion
from ...model.quantity import Quantity
from ...shift.scene.places import scene_places
from ...shift.scene.scene import Scene
from ..evaluators.scene import scene_evaluator

FIGURES = ("lock_time", "slip_energy", "peak_jerk")
STEP = 1e-3  # of a value
AGREE = 0.02  # of the larger: as far as slopes of two steps may differ
STILL = 1e-6  # of a figure for one percent of a value: it does not move
USUAL = ("pressure.", "engine.torque_scale", "clutch.friction_scale", "brake.friction_scale")
Slopes = dict[str, dict[str, float | None]]


def scene_sensitivities(
    scene: Scene, figures: Sequence[str] | None = None, paths: Sequence[str] | None = None
) -> Slopes:
    """Return {figure: {path: derivative}}, SI, of a gear shift.

    Central differences of whole runs over 1e-3 and 5e-4 of a value, extrapolated. None where both
    differ by more than 2 %: the figure has a corner there (another peak of the jerk becomes the
    maximum, a pack locks in another phase) or is lost.

    Parameters
    ----------
    scene : one shift, as ``load_scene`` returns it
    figures : key figures; None: lock-up time, slip energy and jerk, as far as the scene has them
    paths : numbers of the scene, as in ``[scatter]``; None: the values of its pressure profiles,
        factors of friction and of the engine's torque

    Raises
    ------
    ParameterError : there is no such figure or number, one is 0, or the scene has a sequence
    SolveError : the scene cannot be run
    """
    evaluator, places = scene_evaluator(scene), scene_places(scene)
    known = [n for n, f in evaluator.figures.items() if f.kind == "real"]
    figures = [n for n in FIGURES if n in known] if figures is None else list(figures)
    for name in figures:
        if name not in known:
            hint = suggestion(name, known, "; did you mean {}?")
            raise ParameterError(f"figure {name!r}: allowed: {', '.join(known)}{hint}")
    chosen = _usual(places) if paths is None else {path: _place(path, places) for path in paths}
    ends = {path: _ends(place) for path, place in chosen.items()}
    rows: list[dict[str, Any]] = [{p: x} for p, xs in ends.items() for x in xs]
    found = evaluator.evaluate(rows, figures).values.reshape(len(chosen), 4, -1)
    at = evaluator.nominal(figures, ()).values[0]
    slopes: Slopes = {name: {} for name in figures}
    for (path, xs), own in zip(ends.items(), found, strict=True):
        wide, narrow = ((own[k + 1] - own[k]) / (xs[k + 1] - xs[k]) for k in (0, 2))
        for i, name in enumerate(figures):
            slopes[name][path] = _checked(
                float(wide[i]),
                float(narrow[i]),
                STILL * abs(at[i] / (STEP * float(chosen[path].nominal))),
            )
    return slopes


def _usual(places: Mapping[str, Quantity]) -> dict[str, Quantity]:
    return {
        path: place
        for path, place in places.items()
        if path.startswith(USUAL) and ".times." not in path and _moves(place)
    }


def _moves(place: Quantity) -> bool:
    return not place.choices and place.nominal != 0.0


def _place(path: str, places: Mapping[str, Quantity]) -> Quantity:
    if path not in places or places[path].choices:
        hint = suggestion(path, places, "; did you mean {}?")
        raise ParameterError(f"{path}: is no real number of the scene{hint}")
    if not _moves(places[path]):
        raise ParameterError(f"{path}: is 0, of which there is no step; leave it out")
    return places[path]


def _ends(place: Quantity) -> tuple[float, ...]:
    """Return values on both sides, far and near; inside the range."""
    x, step = float(place.nominal), STEP * abs(float(place.nominal))
    every = (x - step, x + step, x - 0.5 * step, x + 0.5 * step)
    return tuple(min(max(value, place.low), place.high) for value in every)


def _checked(wide: float, narrow: float, still: float) -> float | None:
    if not np.isfinite([wide, narrow]).all():
        return None
    largest = max(abs(wide), abs(narrow))
    if largest <= still:
        return narrow
    return (4.0 * narrow - wide) / 3.0 if abs(wide - narrow) <= AGREE * largest else None
