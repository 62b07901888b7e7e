"""The worst values of a shift, when they were reached, and the washer solved again there."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.registry import models_with_points
from ..checks.rule_data import LEAST_LOAD
from ..key_figures.figure_list import FILM_SPEED
from .shift_record import Part, Record

WITH_FIELDS = ("field", "fine")  # levels that leave maps over the washer

Find = Callable[[Record], float | None]


class Extreme(NamedTuple):
    """A value in SI units and the time [s] it was reached."""

    value: float
    time: float


def highest(record: Record, name: str) -> Extreme | None:
    """Return the largest value of a signal; None if the run has no such signal."""
    values = record.series(name)
    if values is None:
        return None
    return Extreme(float(np.nanmax(values)), float(record.time[np.nanargmax(values)]))


def worst_film(record: Record) -> Extreme | None:
    """Return the washer's minimum film ratio above FILM_SPEED; None without such a time."""
    values, turns = (record.series(f"washer.{n}") for n in ("film_ratio", "speed"))
    if values is None or turns is None:
        return None
    where = np.flatnonzero(np.abs(turns) > FILM_SPEED)
    if not where.size:
        return None
    index = where[np.argmin(values[where])]
    return Extreme(float(values[index]), float(record.time[index]))


def of_meshes(name: str, pick: Callable[..., float] = np.min) -> Find:
    """Return what finds the minimum, or by ``pick`` the maximum, of all meshes that turn."""

    def find(r: Record) -> float | None:
        found: list[float] = []
        for part in ("mesh", "ring_mesh") if r.rated_teeth else ():
            values, speed = r.series(f"{part}.{name}"), r.series(f"{part}.speed")
            if values is not None and speed is not None:
                found += values[(np.abs(speed) >= FILM_SPEED) & np.isfinite(values)].tolist()
        return float(pick(found)) if found else None

    return find


class Moment(NamedTuple):
    """One moment [s], the inputs recorded there, and the washer solved again."""

    time: float
    point: dict[str, float]
    result: Any
    recorded_film_ratio: float


def level_with_fields(part: Part) -> str:
    """Return the washer's level if it leaves maps, else its usual one."""
    level = part.parameters.get("fidelity")
    return str(level) if level in WITH_FIELDS else part.spec.default_fidelity


def solve_moment(record: Record, time: float) -> Moment | None:
    """Return the washer at ``time``; None if the scene has none or no solution is found.

    Of the branches that exist there the one nearest to the recorded film ratio is taken.
    """
    part = record.part("washer")
    recorded = record.at("washer.film_ratio", time)
    model = models_with_points().get(part.spec.key) if part else None
    if part is None or recorded is None or model is None or model.command is None:
        return None
    fidelity, params = level_with_fields(part), part.params()
    point = {s.name: record.at(f"washer.{s.name}", time) or 0.0 for s in part.spec.inputs}
    point["load"] = max(point["load"], LEAST_LOAD)
    found = []
    for branch in (None, "film", "contact"):
        with suppress(ParameterError, SolveError):
            found.append(model.solve(params, **point, fidelity=fidelity, branch=branch))
    if not found:
        return None
    nearest = min(found, key=lambda r: abs(r.film_ratio - recorded))
    return Moment(time, point, nearest, recorded)
