"""Draw Figures 6-15 of Jackson & Green (2006) from its own equations, converged.

    python docs/papers/figures.py [FOLDER]

Writes jg2006-fig06.png ... jg2006-fig15.png, by default to the folder
figures, in about half a minute.
The preset "paper" has these equations and nothing more. Lines are all solutions that exist;
markers are the load steps of a washer that is loaded up from light load, as in the paper.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from thrustwasher import WasherParams, load_curve, solve_washer
from thrustwasher.studio.report.palette import BLACK, BLUE, GREEN, GREY, ORANGE, RED
from thrustwasher.studio.report.style import label, legend_below, new_figure, styled
from thrustwasher.tribology.viscosity import viscosity

TILT = 0.002  # rad
GRID = (19, 64)
LARGEST_LOAD = 1850.0  # N
LOAD_STEP = 122.0  # N; the loads printed in the paper are multiples of about this
SPEEDS = {136.0: (BLUE, "o"), 545.0: (ORANGE, "s"), 953.0: (GREEN, "X"), 1367.0: (RED, "D")}
DASHES = (0, (4, 3))
KINDS = [
    Line2D([], [], color=GREY, label="stable"),
    Line2D([], [], color=GREY, ls=DASHES, lw=1.1, label="unstable"),
    Line2D([], [], color=GREY, ls=":", lw=1.1, label="falls to (loading up)"),
    Line2D([], [], color=BLACK, marker="v", ls="", ms=6, label="film lost (fold)"),
    Line2D([], [], color=BLACK, marker="^", ls="", ms=6, mfc="white", label="film regained"),
]
Reading = Callable[[Any], float]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Plot:
    """What one figure shows."""

    number: int
    title: str
    axis: str
    read: Reading
    log: bool = False
    limits: tuple[float, float] | None = None
    lines: tuple[tuple[float, str], ...] = ()
    across: str = "load [N]"
    read_across: Reading = lambda r: float(r.load)
    log_across: bool = False
    limits_across: tuple[float, float] = (0.0, 1900.0)


def stribeck_number(r: Any) -> float:
    """Return Z N/P [-]: viscosity at the mean film temperature, rev/s, load over annulus."""
    p = r.params
    area = math.pi * (p.outer_radius**2 - p.inner_radius**2)
    oil = (p.viscosity_scale, p.viscosity_constant, p.viscosity_exponent)
    return float(viscosity(r.temperature, *oil)[0] * r.speed / (2.0 * math.pi) * area / r.load)


STRIBECK: dict[str, Any] = {
    "across": "ZN/P [1]  (viscosity at the mean temperature x rev/s / mean pressure)",
    "read_across": stribeck_number,
    "log_across": True,
    "limits_across": (3e-8, 2e-4),
}
PLOTS = (
    Plot(6, "Friction coefficient", "friction coefficient [1]",
         lambda r: r.friction_coefficient, log=True, limits=(0.015, 0.4)),
    Plot(7, "Mean film temperature above the oil's 24 °C", "mean temperature rise [K]",
         lambda r: r.temperature - r.oil_temperature, log=True, limits=(0.3, 700.0),
         lines=((200.0, "200 K: the paper stops here"),)),
    Plot(8, "Least film thickness", r"film ratio $h_{min}/\sigma$ [1]", lambda r: r.film_ratio,
         log=True, limits=(0.1, 100.0), lines=((3.0, "3: asperities begin to touch"),)),
    Plot(9, "Tilt of the washer about x", r"$\gamma_x/\gamma_{tilt}$ [1]",
         lambda r: r.washer_tilt_x / r.tilt, limits=(-0.0108, 0.0005), lines=((0.0, "static"),)),
    Plot(10, "Tilt of the washer about y", r"$\gamma_y/\gamma_{tilt}$ [1]",
         lambda r: r.washer_tilt_y / r.tilt, limits=(0.45, 1.03),
         lines=((1.0, "washer lies on the gear"), (0.5, "static"))),
    Plot(11, "Share of the load on the film", r"$F_{fluid}/F_{tot}$ [1]",
         lambda r: r.fluid_load / r.load, limits=(0.0, 1.05)),
    Plot(12, "Share of the load on the asperities", r"$F_{cont}/F_{tot}$ [1]",
         lambda r: max(r.contact_load / r.load, 1e-30), log=True, limits=(1e-12, 3.0)),
    Plot(13, "Contact share over film ratio", r"$F_{cont}/F_{tot}$ [1]",
         lambda r: max(r.contact_load / r.load, 1e-30), limits=(-0.02, 1.05),
         across=r"film ratio $h_{min}/\sigma$ [1]", read_across=lambda r: r.film_ratio,
         limits_across=(0.0, 6.0)),
    Plot(14, "Stribeck curve", "friction coefficient [1]", lambda r: r.friction_coefficient,
         log=True, limits=(0.015, 0.4), **STRIBECK),
)  # fmt: skip


@dataclass(frozen=True)
class Traced:
    """All solutions at one speed, the load steps on the way up, the first ones past the fold."""

    curve: Any
    steps: list[Any]
    landing: Any  # None if the film is never lost


@cache
def trace(speed: float, friction: float = 0.0) -> Traced:
    """Solve for a curve and its load steps; ``friction`` > 0 is a constant dry friction."""
    params = WasherParams.preset("paper")
    if friction > 0.0:
        params = WasherParams.preset("paper", friction_law="constant", dry_friction=friction)
    curve = load_curve(
        params, speed=speed, tilt=TILT, grid=GRID, load_min=25.0, load_max=LARGEST_LOAD
    )

    def loaded(load: float) -> Any:
        return solve_washer(params, load=load, speed=speed, tilt=TILT, fidelity="fine")

    steps = [loaded(float(x)) for x in np.arange(LOAD_STEP, LARGEST_LOAD, LOAD_STEP)]
    landing = loaded(1.0005 * curve.folds[0].load) if curve.folds else None
    return Traced(curve, steps, landing)


def smooth(points: Sequence[Any], read: Reading, log: bool, ratios: Array) -> Array:
    """Return a reading at film ratios between the traced ones (monotone cubics)."""
    ordered = sorted(points, key=lambda r: r.film_ratio)
    values = np.array([read(r) for r in ordered])
    fit = PchipInterpolator([r.film_ratio for r in ordered], np.log(values) if log else values)
    found = fit(ratios)
    return np.asarray(np.exp(found) if log else found)


def branches(curve: Any) -> Iterator[tuple[bool, Array]]:
    """Yield (stable, film ratios) of each stretch between the ends of the curve and its folds."""
    ends = [curve.points[0], *curve.folds, curve.points[-1]]
    for i, (first, last) in enumerate(pairwise(ends)):
        # even in the logarithm of the distance from the thinnest film, which may be negative
        shift = 0.2 - curve.points[-1].film_ratio
        span = np.geomspace(first.film_ratio + shift, last.film_ratio + shift, 150) - shift
        yield i % 2 == 0, np.clip(span, last.film_ratio, first.film_ratio)


def draw(axes: Axes, traced: Traced, plot: Plot, colour: str, marker: str, name: str) -> None:
    """Draw one speed: branches, folds, load steps, the fall off the film branch."""
    points = traced.curve.points

    def place(ratios: Array) -> tuple[Array, Array]:
        return (
            smooth(points, plot.read_across, plot.log_across, ratios),
            smooth(points, plot.read, plot.log, ratios),
        )

    for stable, ratios in branches(traced.curve):
        axes.plot(
            *place(ratios), color=colour, ls="-" if stable else DASHES, lw=1.6 if stable else 1.1
        )
    axes.plot(
        [plot.read_across(r) for r in traced.steps], [plot.read(r) for r in traced.steps],
        marker=marker, ms=6.0, ls="", color=colour, mec="white", mew=0.4, label=name, zorder=4,
    )  # fmt: skip
    for fold in traced.curve.folds:
        lost = fold.kind == "film_lost"
        x, y = place(np.array([fold.film_ratio]))
        axes.plot(
            x, y, marker="v" if lost else "^", ms=7, color=BLACK, ls="",
            mfc=colour if lost else "white", mec=BLACK, mew=0.8, zorder=5,
        )  # fmt: skip
        if lost:
            axes.annotate(
                "", (plot.read_across(traced.landing), plot.read(traced.landing)), (x[0], y[0]),
                arrowprops={"arrowstyle": "->", "color": colour, "ls": ":", "lw": 1.1},
            )  # fmt: skip


def short(value: float, _: float) -> str:
    """Return a tick label without powers of ten where that is short."""
    power = round(math.log10(value))
    return f"{value:g}" if 1e-3 <= value < 1e4 else f"$10^{{{power}}}$"


def finish(axes: Axes, plot: Plot, title: str) -> None:
    """Set scales, limits and labels of a panel."""
    if plot.log:
        axes.set_yscale("log")
        if plot.limits and plot.limits[1] / plot.limits[0] < 1e4:
            axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axes.yaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_major_formatter(short)
    if plot.log_across:
        axes.set_xscale("log")
    if plot.limits:
        axes.set_ylim(*plot.limits)
    axes.set_xlim(*plot.limits_across)
    for value, words in plot.lines:
        axes.axhline(value, color=BLACK, lw=0.8, ls=":")
        axes.annotate(
            words, (1.0, value), (-3, 2), xycoords=axes.get_yaxis_transform(),
            textcoords="offset points", ha="right", fontsize=8, color="#444444",
        )  # fmt: skip
    label(axes, title, plot.across, plot.axis)


@styled
def figure_over_speeds(plot: Plot) -> Figure:
    """Return one of Figures 6-14: four speeds."""
    figure, (axes,) = new_figure(7.4, 4.6, foot=2)
    for speed, (colour, marker) in SPEEDS.items():
        draw(axes, trace(speed), plot, colour, marker, f"{speed:g} rad/s")
    finish(axes, plot, f"{plot.title} (Fig. {plot.number}; tilt 0.002 rad)")
    handles = [*axes.get_legend_handles_labels()[0], *KINDS]
    legend_below(figure, handles, [h.get_label() for h in handles], columns=5)
    return figure


@styled
def figure_over_friction() -> Figure:
    """Return Figure 15: the Stribeck curve for several dry friction coefficients."""
    plot = Plot(15, "Dry friction", "friction coefficient [1]", lambda r: r.friction_coefficient,
                log=True, limits=(0.015, 0.6), **STRIBECK)  # fmt: skip
    looks = {0.1: (BLUE, "o"), 0.2: (GREEN, "s"), 0.4: (RED, "D")}
    figure, panels = new_figure(8.6, 4.9, 1, 2, foot=2, sharey=True)
    for axes, speed in zip(panels, (136.0, 545.0), strict=True):
        for friction, (colour, marker) in looks.items():
            draw(axes, trace(speed, friction), plot, colour, marker, f"f = {friction:g}")
        finish(axes, plot, f"Dry friction (Fig. 15), {speed:g} rad/s")
        axes.set_xlabel("ZN/P [1]")
    panels[1].set_ylabel("")
    handles = [*panels[0].get_legend_handles_labels()[0], *KINDS]
    legend_below(figure, handles, [h.get_label() for h in handles], columns=4)
    return figure


def main(folder: str | Path | None = None) -> list[Path]:
    """Draw all figures into a folder; return the files."""
    target = Path(folder) if folder else Path(__file__).parents[1] / "images"
    target.mkdir(parents=True, exist_ok=True)
    files = []
    for plot in PLOTS:
        files.append(target / f"jg2006-fig{plot.number:02d}.png")
        figure_over_speeds(plot).savefig(files[-1], dpi=110, metadata={"Software": None})
    files.append(target / "jg2006-fig15.png")
    figure_over_friction().savefig(files[-1], dpi=110, metadata={"Software": None})
    return files


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default="figures", help="to write to; default figures")
    for file in main(parser.parse_args().folder):
        print(file)
