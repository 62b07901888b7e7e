"""The error to expect of a washer's result: from the card of its rung, where one speaks."""

from __future__ import annotations

from ..store.cards import error_estimate
from .washer_constants import SIMPLE
from .washer_result import WasherResult


def with_card_error(result: WasherResult) -> WasherResult:
    """Return a result of a named rung with the error that its card gives for this point.

    Without a fresh card for these parameters, or outside its box, the result stays as it is. Rungs
    that know one branch only are judged by the worst of all branches.
    """
    point = {
        "load": result.load, "speed": result.speed, "tilt": result.tilt,
        "oil_temperature": result.oil_temperature,
    }  # fmt: skip
    branch = None if result.fidelity in SIMPLE else result.branch
    found = error_estimate(
        "washer", result.fidelity, result.params, point, branch=branch,
        film_ratio=None if branch is None else result.film_ratio,
    )  # fmt: skip
    if found is not None:
        # nobody else has this result yet, and a copy takes longer than a look-up
        object.__setattr__(result, "error_estimate", found)
    return result
