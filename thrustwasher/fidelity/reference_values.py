"""What a reference says: values, each with an uncertainty of its own, and by which routes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ReferenceValues:
    """The equations of `field` (clutch, gear mesh: of `fine`), solved as well as can be; SI units.

    ``uncertainty`` bounds the numerical error, by what the last refinement changed. Whether the
    equations are those of a real part is another question.
    """

    values: dict[str, float]
    uncertainty: dict[str, float]
    routes: tuple[str, ...]


def extrapolated(
    rows: list[dict[str, float]], ratios: tuple[float, float], order: float
) -> tuple[dict[str, float], dict[str, float]]:
    """Return values from the two finest of three rows, and what each may still be off by.

    ``ratios`` of the resolution from row to row, ``order`` of the error. The uncertainty is the
    correction or, if larger, the difference from the value that the two coarser rows give.
    """
    before, gain = (ratio**order - 1.0 for ratio in ratios)
    values, uncertainty = {}, {}
    for name in rows[0]:
        a, b, c = (row[name] for row in rows)
        values[name] = c + (c - b) / gain
        other = b + (b - a) / before
        uncertainty[name] = max(abs(c - b) / gain, abs(values[name] - other))
    return values, uncertainty
