"""A made-up study with the face of a real one: fast input for its page and the shift's report."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from thrustwasher.studio.scatter.result import (
    Band,
    Index,
    Probability,
    ScatterResult,
    Series,
    SourceLine,
)

N = 64
U = (np.arange(N) + 0.5) / N
SHARE, OIL = 0.04 + 0.12 * U, 353.15 + 3.0 * np.sin(37.0 * np.arange(N))
CAVITY = ["cyclic", "none"] * (N // 2)
NOTHING = Index(
    first=None, total=None, confidence=None, first_confidence=None, total_confidence=None
)
SOURCES = (
    SourceLine("transmission.thrust_share", "uniform 0.04 .. 0.16", "estimate", 0.1),
    SourceLine("oil_temperature", "normal, standard deviation 3 K", "ISO 0815", 353.15),
    SourceLine("washer.cavity_shear", "either cyclic or none", "", "cyclic"),
)
LEVELS = (0.05, 0.5, 0.95)


def index(total: float, half: float = 0.04) -> Index:
    """Return a total index with half its confidence interval."""
    return Index(
        first=total - 0.01,
        total=total,
        confidence=half,
        first_confidence=half,
        total_confidence=half,
    )


def band(values: np.ndarray, unit: str, help: str, *totals: float, **more: object) -> Band:
    """Return the band of values, decided by the sources to these totals; none: no indices."""
    at = dict(zip(LEVELS, np.nanquantile(values, LEVELS).tolist(), strict=True))
    names, wide = [source.name for source in SOURCES], 0.1 * (at[0.95] - at[0.05])
    usual = {"usual": (-np.inf, np.inf), "nominal": at[0.5], **more}
    return Band(
        quantiles=at,
        confidence={level: (x - wide, x + wide) for level, x in at.items()},
        mean=float(np.nanmean(values)),
        standard_deviation=float(np.nanstd(values)),
        indices=dict(zip(names, map(index, totals), strict=False)),
        unit=unit,
        help=help,
        **usual,
    )


def study(**changes: object) -> ScatterResult:
    """Return a study of a scene: the shift's lock-up and heat, the washers' film."""
    film, heat = 0.4 / SHARE, 11e3 + 50.0 * (OIL - 353.15)
    lock, jerk = 0.84 + 0.002 * (OIL - 353.15), np.full(N, 12.0)
    time = np.linspace(0.0, 2.5, 21)
    profile = np.outer(np.array([0.8, 1.0, 1.2]), 200.0 * np.clip(time, 0.0, 1.0))
    torque = Series(
        time=time,
        nominal=profile[1],
        quantiles=dict(zip(LEVELS, profile, strict=True)),
        indices={
            "oil_temperature": np.where(time > 0.0, 0.8, np.nan),
            "washer.cavity_shear": np.where(time > 0.0, 0.1, np.nan),
        },
        unit="N.m",
    )
    outside = Probability(value=0.3125, low=0.2, high=0.44)
    figures = {
        "lock_after_ramp_start": band(
            lock, "s", "shift duration, start until clutch locks", 0.0, 0.97, 0.01, outside=outside,
            usual=(0.3, 0.8), error=0.002,
        ),
        "slip_energy": band(heat, "J", "heat in the clutch", 0.0, 0.99, 0.0),
        "peak_jerk": replace(
            band(jerk, "m/s3", "maximum jerk"),
            indices={source.name: NOTHING for source in SOURCES},
        ),
        "minimum_washer_film_ratio": band(film, "1", "minimum film ratio of the washers"),
    }  # fmt: skip
    columns = zip(figures, (lock, heat, jerk, film), strict=True)
    sample = {s.name: x for s, x in zip(SOURCES, (SHARE, OIL, CAVITY), strict=True)}
    rows = [{n: x[i] for n, x in sample.items()} for i in (0, N // 2, N - 1)]
    given = ScatterResult(
        target="made-up",
        kind="scene",
        runs=N,
        solves=5 * N,
        failed={},
        reached="below",
        seed=1,
        sources=SOURCES,
        figures=figures,
        probabilities={"film_lost": Probability(value=0.25, low=0.16, high=0.36)},
        series={"clutch.torque_capacity": torque},
        nearest={
            "minimum_washer_film_ratio": dict(zip(LEVELS, rows, strict=True)),
            "slip_energy": dict(zip(LEVELS, rows, strict=True)),
        },
        sample=sample | dict(columns) | {"film_lost": (U > 0.75) * 1.0, "status": ["OK"] * N},
        units={"oil_temperature": "K", "transmission.thrust_share": "1"},
        wall_time=12.0,
    )
    return replace(given, **changes)
