"""The error to expect of a washer's result: from the card of its rung, where one speaks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..store.cards import error_estimate
from .washer_constants import SIMPLE

if TYPE_CHECKING:
    from .washer_result import WasherResult


class Unread(float):
    """The error of a rung in general; the card may know better for the point at hand."""


class ErrorEstimate:
    """The field ``error_estimate`` of a result: its card is asked when somebody wants to know.

    That takes longer than many a solve, and most solves in a loop are never asked.
    """

    def __init__(self, field: Any) -> None:
        self.field = field

    def __get__(self, result: WasherResult | None, owner: object = None) -> Any:
        """Return the error; the card is looked at once."""
        if result is None:
            return self.field
        value = self.field.__get__(result)
        if type(value) is Unread:
            known = card_error(result)
            value = float(value) if known is None else known
            self.field.__set__(result, value)
        return value

    def __set__(self, result: WasherResult, value: float) -> None:
        """Keep the error."""
        self.field.__set__(result, value)


def card_error(result: WasherResult) -> float | None:
    """Return the error that the card of a result's rung gives for its point.

    None without a fresh card for these parameters, and outside its box. Rungs that know one branch
    only are judged by the worst of all branches.
    """
    point = {
        "load": result.load, "speed": result.speed, "tilt": result.tilt,
        "oil_temperature": result.oil_temperature,
    }  # fmt: skip
    branch = None if result.fidelity in SIMPLE else result.branch
    return error_estimate(
        "washer", result.fidelity, result.params, point, branch=branch,
        film_ratio=None if branch is None else result.film_ratio,
    )  # fmt: skip
