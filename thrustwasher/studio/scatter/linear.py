"""What a gradient at the nominal point says of the scatter, to be held against the sample."""

from collections.abc import Iterator, Mapping

import numpy as np

from ...units import format_quantity
from .result import Band, Probability
from .target import Target

DRAWS = 1000  # quantiles that a law's standard deviation is taken of
SHARE = 0.02  # of the standard deviation, to either side
APART = 0.2  # of the sampled deviation: more is worth a warning
ROUNDING = 1e-6  # of a nominal value: deviations below are none
SURE = 0.01  # probability below which the other branch does not count


def linear_deviations(target: Target) -> dict[str, float]:
    """Return the standard deviation of each figure [SI] if all were linear; {} with choices.

    Two runs for each source, next to the nominal values. NaN where one of them fails.
    """
    rows, spreads, widths = list[dict[str, float]](), [], []
    for source in target.scatter.sources:
        place, middle = source.place, source.place.nominal
        if place.choices or isinstance(middle, str):
            return {}
        u = (np.arange(DRAWS) + 0.5) / DRAWS
        spread = float(np.std(np.asarray(source.law.value(u), float)))
        ends = [
            min(max(middle + side * SHARE * spread, place.low), place.high) for side in (-1.0, 1.0)
        ]
        rows += [{place.name: end} for end in ends]
        spreads.append(spread)
        widths.append(ends[1] - ends[0])
    if not rows or not all(widths):
        return {}
    found = target.solve(rows, np.ones(len(rows), bool))[0][:, : len(target.figures)]
    moves = (found[1::2] - found[::2]) * (np.array(spreads) / np.array(widths))[:, np.newaxis]
    variance = np.einsum("if,ik,kf->f", moves, target.scatter.correlation, moves)
    names = (figure.name for figure in target.figures)
    return dict(zip(names, np.sqrt(np.maximum(variance, 0.0)).tolist(), strict=True))


def doubts_of_linear(
    figures: Mapping[str, Band], probabilities: Mapping[str, Probability]
) -> Iterator[str]:
    """Yield where a gradient must not be taken for the sample."""
    known = {name: band for name, band in figures.items() if band.linear_deviation is not None}
    apart = [
        f"{name} {_text(band, band.linear_deviation or 0.0)} against "
        f"{_text(band, band.standard_deviation)}"
        for name, band in known.items()
        if abs((band.linear_deviation or 0.0) - band.standard_deviation)
        > max(APART * band.standard_deviation, ROUNDING * abs(band.nominal))
    ]
    if apart:
        yield (
            "the standard deviation by gradient is more than 20 % off the sampled one, which "
            f"counts: {', '.join(apart)}"
        )
    lost = probabilities.get("film_lost")
    if known and lost and SURE < lost.value < 1.0 - SURE:
        yield (
            f"the film is lost in {100.0 * lost.value:.3g} % of the runs: a gradient knows one of "
            "both branches, its standard deviations do not count"
        )


def _text(band: Band, value: float) -> str:
    return format_quantity(value, band.unit, difference=True, digits=3)
