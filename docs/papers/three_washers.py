"""Compare what Jackson & Green (2006) print, their equations converged, and the full model.

    python docs/papers/three_washers.py [FOLDER]

Prints the table of docs/papers/jackson-green-2006.md and draws jg2006-three.png, by default into
the folder figures; half a minute.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from thrustwasher import WasherParams, load_curve, solve_washer
from thrustwasher.studio.report.palette import BLACK, BLUE, GREY, ORANGE
from thrustwasher.studio.report.style import label, legend_below, new_figure, styled
from thrustwasher.tribology.viscosity import viscosity

TILT = 0.002  # rad
SPEEDS = (136.0, 545.0, 953.0, 1367.0)  # rad/s
FAST = SPEEDS[1:]
PRINTED = {545.0: 1117.0, 953.0: 1728.0}  # N, where the paper's film is lost
WASHERS = {"paper": WasherParams.preset("paper"), "runs": WasherParams()}
LOOKS = {"paper": (ORANGE, "the paper's equations, converged"), "runs": (BLUE, "the full model")}
DRAWN = SPEEDS[:3]
Reading = Callable[[str], str]


@cache
def curve(which: str, speed: float) -> Any:
    """Return the load curve of one of the washers on the fine mesh."""
    return load_curve(
        WASHERS[which], speed=speed, tilt=TILT, fidelity="fine", load_min=25.0, load_max=2600.0
    )


@cache
def at(which: str, speed: float, load: float) -> Any:
    """Return the solution at a point, as loaded up from light load."""
    return solve_washer(WASHERS[which], load=load, speed=speed, tilt=TILT, fidelity="fine")


def fold(which: str, speed: float, kind: int = 0) -> Any:
    """Return where the film is lost (0) or regained (1)."""
    return curve(which, speed).folds[kind]


def growth(slow: float, fast: float) -> float:
    """Return the exponent of the speed between the distress loads at 545 and 953 rad/s."""
    return math.log(fast / slow) / math.log(953.0 / 545.0)


def stribeck_number(r: Any) -> float:
    """Return ZN/P [-] with the viscosity at the mean temperature of the oil."""
    p = r.params
    area = math.pi * (p.outer_radius**2 - p.inner_radius**2)
    oil = (p.viscosity_scale, p.viscosity_constant, p.viscosity_exponent)
    return float(viscosity(r.film_temperature, *oil)[0] * r.speed / (2 * math.pi) * area / r.load)


def valley(which: str, speed: float) -> tuple[float, float]:
    """Return film ratio and ZN/P of minimum friction on the stable branches."""
    points = [r for r in curve(which, speed).points if r.branch != "unstable"]
    i = min(range(1, len(points) - 1), key=lambda k: points[k].friction_coefficient)
    near = points[i - 1 : i + 2]
    fit = np.polyfit([r.film_ratio for r in near], [r.friction_coefficient for r in near], 2)
    ratio = float(-0.5 * fit[1] / fit[0])
    numbers = [stribeck_number(r) for r in reversed(near)]
    return ratio, float(np.interp(ratio, [r.film_ratio for r in reversed(near)], numbers))


def over(speeds: Sequence[float], read: Callable[[float], float], form: str) -> str:
    """Return a reading at several speeds."""
    return ", ".join(format(read(speed), form) for speed in speeds)


@dataclass(frozen=True)
class Row:
    """A line of the table: what, what the paper says, how both washers are read."""

    what: str
    printed: str
    read: Reading


def film_share(which: str) -> str:
    """Return the film's share of 1361 N at 136 rad/s."""
    return f"{100.0 * at(which, 136.0, 1361.0).fluid_load / 1361.0:.1f} %"


ROWS = (
    *(Row(f"film lost at {speed:g} rad/s", f"{PRINTED[speed]:g} N" if speed in PRINTED else "-",
          lambda w, v=speed: f"{fold(w, v).load:.0f} N") for speed in FAST),
    Row("that load grows as speed to the power of", f"{growth(1117.0, 1728.0):.2f}",
        lambda w: f"{growth(fold(w, 545.0).load, fold(w, 953.0).load):.2f}"),
    Row("film regained at 545, 953, 1367 rad/s", "-",
        lambda w: over(FAST, lambda v: fold(w, v, 1).load, ".0f") + " N"),
    Row("film ratio where it is lost", "about 3",
        lambda w: over(FAST, lambda v: fold(w, v).film_ratio, ".2f")),
    Row("film ratio of minimum friction at 136, 545, 953, 1367 rad/s", "3",
        lambda w: over(SPEEDS, lambda v: valley(w, v)[0], ".2f")),
    Row("ZN/P of minimum friction, in 1e-6", "2.0 (experiment 1.0)",
        lambda w: over(SPEEDS, lambda v: 1e6 * valley(w, v)[1], ".1f")),
    Row("share of the film at 136 rad/s, 1361 N", "2 %", film_share),
    Row("torque at 953 rad/s, 300 N: full film", "experiment above the paper's own curve",
        lambda w: f"{at(w, 953.0, 300.0).friction_torque:.4f} N m"),
)  # fmt: skip


def table() -> list[str]:
    """Return the lines of the table."""
    lines = [
        "| | paper | equations | model |",
        "|---" * 4 + "|",
    ]
    return lines + [
        f"| {r.what} | {r.printed} | {r.read('paper')} | {r.read('runs')} |" for r in ROWS
    ]


def draw(axes: Axes, which: str, speed: float, name: str) -> None:
    """Draw a load curve, what is unstable dashed; each part begins where the one before ends."""
    before: list[Any] = []
    for unstable, found in groupby(curve(which, speed).points, lambda r: r.branch == "unstable"):
        part = before[-1:] + list(found)
        axes.plot(
            [r.load for r in part], [getattr(r, name) for r in part], color=LOOKS[which][0],
            ls=(0, (4, 3)) if unstable else "-", lw=1.1 if unstable else 1.6,
        )  # fmt: skip
        before = part


@styled
def figure() -> Figure:
    """Return film ratio and friction torque over the load at three speeds."""
    drawn, panels = new_figure(11.0, 6.6, 2, len(DRAWN), foot=1, sharex=True)
    readings = (
        ("film_ratio", "film ratio [1]", (0.2, 60.0)),
        ("friction_torque", "friction torque [N·m]", (0.05, 8.0)),
    )
    for i, (name, words, limits) in enumerate(readings):
        for axes, speed in zip(panels[i * len(DRAWN) :], DRAWN, strict=False):
            for which in WASHERS:
                draw(axes, which, speed, name)
            if speed in PRINTED:
                axes.axvline(PRINTED[speed], color=BLACK, ls=":", lw=1.2)
            axes.set_yscale("log")
            axes.set_ylim(*limits)
            axes.set_xlim(0.0, 2000.0)
            label(axes, f"{speed:g} rad/s", "load [N]", words)
    handles = [Line2D([], [], color=colour, label=words) for colour, words in LOOKS.values()]
    handles += [
        Line2D([], [], color=GREY, ls=(0, (4, 3)), label="unstable"),
        Line2D([], [], color=BLACK, ls=":", label="film lost, as the paper prints it"),
    ]
    legend_below(drawn, handles, [h.get_label() for h in handles], columns=4)
    return drawn


def main(folder: str | Path | None = None) -> Path:
    """Print the table and draw the figure; return its file."""
    print("\n".join(table()))
    target = Path(folder) if folder else Path(__file__).parents[1] / "images"
    target.mkdir(parents=True, exist_ok=True)
    file = target / "jg2006-three.png"
    figure().savefig(file, dpi=110, metadata={"Software": None})
    return file


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default="figures", help="to write to; default figures")
    main(parser.parse_args().folder)
