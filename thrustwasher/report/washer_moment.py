"""The washer's fields at one moment of a shift: solved again at the recorded inputs."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, NamedTuple

from ..errors import ParameterError, SolveError
from .shift_record import Record

LEAST_LOAD = 1.0  # [N] the washer in a run takes a smaller load as this


class Moment(NamedTuple):
    """One moment [s], the inputs recorded there, and the washer solved again."""

    time: float
    point: dict[str, float]
    result: Any
    recorded_film_ratio: float


WITH_FIELDS = ("coarse", "field", "fine")  # rungs that leave maps over the washer


def solve_moment(record: Record, time: float) -> Moment | None:
    """Return the washer at ``time``; None if the scene has none or no solution is found.

    Of the branches that exist there the one nearest to the recorded film ratio is taken.
    """
    part = record.part("washer")
    recorded = record.at("washer.film_ratio", time)
    if part is None or recorded is None:
        return None
    from ..models.washer import solve_washer
    from ..models.washer_params import SPEC, WasherParams

    known = {f.name for f in fields(WasherParams)}
    params = WasherParams(**{k: v for k, v in part.parameters.items() if k in known})
    fidelity = str(part.parameters.get("fidelity", SPEC.default_fidelity))
    if fidelity not in WITH_FIELDS:
        fidelity = SPEC.default_fidelity
    point: dict[str, Any] = {
        name: record.at(f"washer.{name}", time) or 0.0
        for name in ("load", "speed", "tilt", "oil_temperature")
    }
    point["load"] = max(point["load"], LEAST_LOAD)
    found = []
    for branch in (None, "film", "contact"):
        try:
            found.append(solve_washer(params, **point, fidelity=fidelity, branch=branch))
        except (ParameterError, SolveError):
            continue
    if not found:
        return None
    nearest = min(found, key=lambda r: abs(r.film_ratio - recorded))
    return Moment(time, point, nearest, recorded)
