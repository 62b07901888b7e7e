"""A study of a gear train with its efficiency shown as the power lost in per cent."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from .study_data import Study
from .words import HIGH, LOW

NAME = "efficiency"  # it keeps its name in all tables
TITLE = "loss, of the power in"
LOSS = "loss"  # [W]: called as in the other reports
OTHER_END = {LOW: HIGH, HIGH: LOW}


def with_lost_power(result: Study) -> Study:
    """Return the study of a train with the share of the power in that is lost [%], else itself."""
    if result.model != "train" or NAME not in result.figures:
        return result
    told: Any = result
    band: Any = result.figures[NAME]
    lost = replace(
        band,
        nominal=_lost(band.nominal),
        quantiles=dict(sorted((o, _lost(x)) for o, x in other_ends(band.quantiles).items())),
        confidence={
            level: (_lost(high), _lost(low))
            for level, (low, high) in other_ends(band.confidence).items()
        },
        mean=_lost(band.mean),
        standard_deviation=100.0 * band.standard_deviation,
        linear_deviation=None if band.linear_deviation is None else 100.0 * band.linear_deviation,
        usual=(_lost(band.usual[1]), _lost(band.usual[0])),
        unit="%",
        help=TITLE,
        error=None,
    )
    key = f"{NAME} (result)" if f"{NAME} (result)" in result.sample else NAME
    sample = {**result.sample}
    if key in sample:
        sample[key] = 100.0 * (1.0 - np.asarray(sample[key], float))
    nearest = {n: other_ends(x) if n == NAME else x for n, x in told.nearest.items()}
    own: Any = {NAME: lost}
    if LOSS in result.figures:
        own[LOSS] = replace(told.figures[LOSS], help=LOSS)
    figures = {n: own.get(n, x) for n, x in result.figures.items()}
    changed: Study = replace(told, figures=figures, sample=sample, nearest=nearest)
    return changed


def other_ends(by_level: Mapping[float, Any]) -> dict[float, Any]:
    """Return what is known by quantiles under those of the lost share."""
    return {OTHER_END.get(level, level): x for level, x in by_level.items()}


def _lost(efficiency: float) -> float:
    return 100.0 * (1.0 - efficiency)
