"""The washer's error on its named grids, against grid-converged values; prints Markdown.

python -m lab.benchmarks.accuracy [--quick]

Converged values: two fine grids of one family (all intervals refined alike), extrapolated with
second order; the third, coarser one shows the order that was observed.
"""

from __future__ import annotations

import math
import sys

from lab.benchmarks.printed import table_head, table_row
from thrustwasher import WasherParams, load_curve, solve_washer

# (what it is, speed rad/s, load N, branch)
CASES = [
    ("full film", 136.0, 50.0, "film"),
    ("full film", 136.0, 100.0, "film"),
    ("full film", 545.0, 100.0, "film"),
    ("full film", 545.0, 300.0, "film"),
    ("full film", 953.0, 300.0, "film"),
    ("full film", 1367.0, 100.0, "film"),
    ("full film", 1367.0, 300.0, "film"),
    ("full film", 1367.0, 600.0, "film"),
    ("transition", 136.0, 320.0, "film"),
    ("transition", 545.0, 880.0, "film"),
    ("transition", 953.0, 1080.0, "film"),
    ("mixed", 136.0, 450.0, "contact"),
    ("mixed", 136.0, 600.0, "contact"),
    ("boundary", 136.0, 1361.0, "contact"),
    ("contact below the fold", 545.0, 750.0, "contact"),
    ("contact below the fold", 953.0, 850.0, "contact"),
    ("post-distress", 545.0, 1200.0, "contact"),
    ("post-distress", 953.0, 1500.0, "contact"),
    ("post-distress", 1367.0, 1500.0, "contact"),
    ("post-distress", 1367.0, 2500.0, "contact"),
]
FAMILY = [(19, 64), (28, 96), (37, 128)]
TILT, OIL = 0.002, 297.15
PARAMS = WasherParams()


def order_of(values: list[float]) -> float:
    """Return the order of convergence seen on three grids with intervals 2 : 4/3 : 1."""
    a, b, c = values
    if (a - b) * (b - c) <= 0.0:
        return math.nan
    seen = (a - b) / (b - c)
    low, high = 0.1, 6.0
    for _ in range(60):  # (2^p - (4/3)^p)/((4/3)^p - 1) rises with p
        p = 0.5 * (low + high)
        expected = (2.0**p - (4.0 / 3.0) ** p) / ((4.0 / 3.0) ** p - 1.0)
        low, high = (p, high) if expected < seen else (low, p)
    return p


def converged(speed: float, load: float, branch: str) -> tuple[float, ...]:
    """Return torque, film ratio, temperature, extrapolated; and the order seen in the torque."""
    runs = [
        solve_washer(PARAMS, load=load, speed=speed, tilt=TILT, grid=grid, branch=branch)
        for grid in FAMILY
    ]
    values = [(r.friction_torque, r.film_ratio, r.temperature) for r in runs]
    far = [
        c + (c - b) / ((4.0 / 3.0) ** 2 - 1.0) for b, c in zip(values[1], values[2], strict=True)
    ]
    return (*far, order_of([v[0] for v in values]))


def case_table() -> None:
    """Print errors of the named fidelities case by case."""
    table_head(
        "case",
        "speed rad/s, load N",
        "torque N m, film ratio, rise K (converged; order seen)",
        *(f"`{name}` torque %, film ratio, K" for name in ("field", "fine")),
    )
    worst = {"field": [0.0, 0.0, 0.0, 0.0], "fine": [0.0, 0.0, 0.0, 0.0]}
    for what, speed, load, branch in CASES:
        torque, ratio, temperature, order = converged(speed, load, branch)
        cells = []
        for fidelity, most in worst.items():
            r = solve_washer(
                PARAMS, load=load, speed=speed, tilt=TILT, fidelity=fidelity, branch=branch
            )
            errors = [
                100.0 * (r.friction_torque / torque - 1.0),
                r.film_ratio - ratio,
                r.temperature - temperature,
                100.0 * (r.temperature - temperature) / (temperature - OIL),
            ]
            for k, e in enumerate(errors):
                most[k] = max(most[k], abs(e))
            cells.append(f"{errors[0]:+.3f}, {errors[1]:+.4f}, {errors[2]:+.3f}")
        far = f"{torque:.6f}, {ratio:.4f}, {temperature - OIL:.3f} ({order:.2f})"
        table_row(what, f"{speed:g}, {load:g}", far, *cells)
    for fidelity, most in worst.items():
        print(
            f"\n{fidelity}: worst torque {most[0]:.3f} %, film ratio {most[1]:.4f}, temperature "
            f"{most[2]:.3f} K ({most[3]:.3f} % of the rise)"
        )


def fold_table() -> None:
    """Print the fold loads on the named grids and on the finest."""
    print()
    table_head("speed rad/s", "fold", "`field` N", "`fine` N", "37 x 128 N", "field %", "fine %")
    for speed in (545.0, 953.0, 1367.0):
        curves = [
            load_curve(PARAMS, speed=speed, tilt=TILT, **grid)
            for grid in ({}, {"fidelity": "fine"}, {"grid": FAMILY[-1]})
        ]
        for a, b, c in zip(*(curve.folds for curve in curves), strict=True):
            loads = [f"{x.load:.2f}" for x in (a, b, c)]
            off = f"{100 * (a.load / c.load - 1):+.2f}", f"{100 * (b.load / c.load - 1):+.3f}"
            table_row(f"{speed:g}", a.kind, *loads, *off)


if __name__ == "__main__":
    if "--quick" in sys.argv:
        CASES = CASES[::5]
    case_table()
    if "--quick" not in sys.argv:
        fold_table()
