"""Compute the effect of the washer's open physical choices; print the page's table.

    python docs/papers/open_choices.py

One choice is changed at a time, on the fine mesh; half a minute. The table stands in
docs/theory/washer/open-choices.md.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from thrustwasher import WasherParams, load_curve, solve_washer

TILT = 0.002  # rad
POINTS = ((953.0, 300.0), (136.0, 320.0))  # rad/s, N
FOLDS_AT = 545.0  # rad/s
BASE = WasherParams()


def thicker(factor: float) -> WasherParams:
    """Return a washer whose far faces are farther away: less cooling, more spread in the plane."""
    return replace(
        BASE,
        carrier_thickness=factor * BASE.carrier_thickness,
        gear_thickness=factor * BASE.gear_thickness,
    )


CHOICES = {
    "far faces cooled twice as well: `carrier_thickness`, `gear_thickness` x 0.5": thicker(0.5),
    '`cavity_shear = "liquid"`': replace(BASE, cavity_shear="liquid"),
    "`heat_split` 0, all into the washer": replace(BASE, heat_split=0.0),
    "`friction_law = \"constant\"`, 0.15": replace(BASE, friction_law="constant"),
    "**left out:** `oil_cooling = false`": replace(BASE, oil_cooling=False),
    'rings: `conduction = "all"`': replace(BASE, conduction="all"),
    "all of these: the preset \"paper\"": WasherParams.preset("paper"),
}  # fmt: skip


def figures(params: WasherParams) -> list[float]:
    """Return the torques at the points [N m] and the loads of both folds [N]."""
    torques = [
        solve_washer(params, load=load, speed=speed, tilt=TILT, fidelity="fine").friction_torque
        for speed, load in POINTS
    ]
    folds: list[Any] = load_curve(params, speed=FOLDS_AT, tilt=TILT, fidelity="fine").folds
    return torques + [fold.load for fold in folds]


def row(name: str, values: list[float], base: list[float]) -> str:
    """Return a line of the table: relative changes in percent."""
    changes = (100.0 * (x / x0 - 1.0) for x, x0 in zip(values, base, strict=True))
    return f"| {name} | " + " | ".join(f"{x:+.2g} %" for x in changes) + " |"


def main() -> list[str]:
    """Return the lines of the table."""
    base = figures(BASE)
    heads = [f"torque, {speed:g} rad/s, {load:g} N" for speed, load in POINTS]
    heads += [f"film {word}, {FOLDS_AT:g} rad/s" for word in ("lost", "regained")]
    lines = ["| choice | " + " | ".join(heads) + " |", "|---" * (len(heads) + 1) + "|"]
    default = [f"{x:.4f} N m" for x in base[:2]] + [f"{x:.0f} N" for x in base[2:]]
    lines.append("| **default** | " + " | ".join(default) + " |")
    lines += [row(name, figures(params), base) for name, params in CHOICES.items()]
    return lines


if __name__ == "__main__":
    print("\n".join(main()))
