"""Draw Figures 4, 7, 9, 11 and 15 of Wang, Wei & Wu (2012) from this package's clutch model.

    python docs/papers/wang_figures.py [FOLDER]

Writes wang2012-fig04.png ... wang2012-fig15.png, by default to the folder figures,
in a few seconds. The paper's own figures were not at hand: ranges and parameters it does not print
are chosen here.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from thrustwasher import ClutchParams, boundary_friction, solve_clutch
from thrustwasher.studio.report.palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED
from thrustwasher.studio.report.style import label, legend_below, new_figure, styled

SAMPLE = {"inner_radius": 0.0325, "outer_radius": 0.0425}  # m, Fig. 12
PACK = ClutchParams(**SAMPLE)
AREA = math.pi * (0.0425**2 - 0.0325**2)
RPM = np.linspace(0.0, 3000.0, 601)
INDENTATION = 0.1  # Fig. 15
# (shear_floor, decay_speed [m/s]) that give the same average of 0.053
ALTERNATIVES = ((0.20, 4.3891), (0.25, 3.6538), (0.35, 2.0057), (0.40, 0.9653))
RATIOS = ((0.0, GREY), (0.25, BLUE), (0.5, GREEN), (0.75, ORANGE), (1.0, RED))
RADII = ((10e-6, RED), (50e-6, GREEN), (200e-6, BLUE))  # m, chosen here
PRESSURES = ((0.5e6, BLUE, "-"), (1.0e6, ORANGE, "--"), (1.5e6, GREEN, ":"))  # Pa


def over_speed(pack: ClutchParams, pressure: float = 1e6) -> tuple[np.ndarray, np.ndarray]:
    """Return shear ratio and coefficient at the speeds of the figures."""
    results = [
        solve_clutch(
            pack, load=pressure * AREA, speed=n * math.pi / 30.0, interface_temperature=373.15
        )
        for n in RPM
    ]
    return (
        np.array([r.shear_ratio for r in results]),
        np.array([r.friction_coefficient for r in results]),
    )


@styled
def figure_4() -> Figure:
    """Return speed and coefficient over the time of a braking of 1.2 s."""
    figure, (axes,) = new_figure(7.4, 4.2, foot=1, right=0.8)
    mu = over_speed(PACK)[1]
    passed = np.concatenate([[0.0], np.cumsum(0.5 * (1.0 / mu[1:] + 1.0 / mu[:-1]))])
    time = 1.2 * (1.0 - passed / passed[-1])
    axes.plot(time, mu, color=BLUE, label="friction coefficient")
    axes.axhline(0.053, color=BLUE, lw=0.9, ls=":")
    axes.annotate("mean over time 0.053", (0.02, 0.0545), fontsize=8.5, color=BLUE)
    label(axes, "A braking from 3000 rpm (Fig. 4)", "time [s]", "friction coefficient [1]")
    axes.set_ylim(0.0, 0.125)
    axes.set_xlim(0.0, 1.2)
    right = axes.twinx()
    right.grid(False)
    right.plot(time, RPM, color=RED, ls="--", label="slip")
    right.plot([0.0, 1.2], [3000.0, 0.0], color=GREY, lw=0.9, ls=":", label="linear fall")
    right.set_ylabel("slip [rpm]")
    right.set_ylim(0.0, 3300.0)
    handles, names = axes.get_legend_handles_labels()
    more = right.get_legend_handles_labels()
    legend_below(figure, handles + more[0], names + more[1], columns=3)
    return figure


@styled
def figure_7() -> Figure:
    """Return the coefficient over W/2R for several shear ratios: Eq 11, and Eq 12 for k = 0.1."""
    figure, panels = new_figure(9.2, 4.4, 1, 2, foot=1, sharey=True)
    across = np.linspace(1e-3, 1.0, 400)
    for axes, weight, name in zip(panels, (1.0, 0.1), ("Eq 11 (k = 1)", "Eq 12, k = 0.1")):  # noqa: B905
        for ratio, colour in RATIOS:
            axes.plot(across, boundary_friction(across, ratio, weight), color=colour,
                      label=f"$s/s_m$ = {ratio:g}")  # fmt: skip
        axes.axvline(INDENTATION, color=BLACK, lw=0.8, ls=":")
        axes.annotate("Fig. 15", (INDENTATION, 1.15), (4, 0), textcoords="offset points",
                      fontsize=8, color="#444444")  # fmt: skip
        label(axes, f"{name}, N = 6 (Fig. 7)", "W/2R [1]", "")
        axes.set_xlim(0.0, 1.0)
        axes.set_ylim(0.0, 1.25)
    panels[0].set_ylabel("friction coefficient [1]")
    legend_below(figure, *panels[0].get_legend_handles_labels(), columns=5)
    return figure


@styled
def figure_9() -> Figure:
    """Return the coefficient over penetration for several asperity radii, S = 0.5."""
    figure, panels = new_figure(9.2, 4.4, 1, 2, foot=1)
    depth = np.linspace(1e-9, 2e-6, 300)
    for axes, weight in zip(panels, (1.0, PACK.plough_weight), strict=True):
        for radius, colour in RADII:
            x = np.sqrt(depth / radius * (2.0 - depth / radius))
            axes.plot(1e6 * depth, boundary_friction(x, 0.5, weight), color=colour,
                      label=f"R = {1e6 * radius:g} µm")  # fmt: skip
        label(axes, f"k = {weight:.4g}, $s/s_m$ = 0.5 (Fig. 9)", "penetration [µm]", "")
        axes.set_xlim(0.0, 2.0)
        axes.set_ylim(bottom=0.0)
    panels[0].set_ylabel("friction coefficient [1]")
    legend_below(figure, *panels[0].get_legend_handles_labels(), columns=3)
    return figure


def reverse(axes: Axes) -> None:
    """Let speed fall to the right, as in the paper, and mark where adhesion begins."""
    axes.set_xlim(3000.0, 0.0)
    axes.axvline(300.0, color=BLACK, lw=0.8, ls=":")
    axes.annotate("300 rpm", (300.0, 0.02), (4, 0), xycoords=axes.get_xaxis_transform(),
                  textcoords="offset points", fontsize=8, color="#444444", ha="left")  # fmt: skip


def draw_alternatives(axes: Axes, which: int) -> None:
    """Draw the other curves with the same average."""
    for floor, decay in ALTERNATIVES:
        other = ClutchParams(**SAMPLE, shear_floor=floor, decay_speed=decay)
        name = "same average, other constants" if floor == 0.20 else None
        axes.plot(RPM, over_speed(other)[which], color=GREY, lw=1.0, label=name)


@styled
def figure_11() -> Figure:
    """Return the shear ratio over speed."""
    figure, (axes,) = new_figure(7.4, 4.2)
    draw_alternatives(axes, 0)
    axes.plot(RPM, over_speed(PACK)[0], color=PURPLE, lw=2.2, label="default")
    reverse(axes)
    axes.set_ylim(0.0, 1.08)
    label(axes, "Shear ratio over speed (Fig. 11)", "slip [rpm]", "shear ratio $s/s_m$ [1]")
    axes.legend(loc="upper left")
    return figure


@styled
def figure_15() -> Figure:
    """Return the coefficient over speed for three pressures."""
    figure, (axes,) = new_figure(7.4, 4.2)
    draw_alternatives(axes, 1)
    for pressure, colour, dashes in PRESSURES:
        axes.plot(RPM, over_speed(PACK, pressure)[1], color=colour, ls=dashes, lw=2.4,
                  label=f"{1e-6 * pressure:g} MPa")  # fmt: skip
    reverse(axes)
    for height, words in ((0.11, "0.11 at lock-up"), (0.053, "0.053 on average")):
        axes.axhline(height, color=BLACK, lw=0.8, ls=":")
        axes.annotate(words, (2950.0, height), (0, 3), textcoords="offset points", fontsize=8,
                      color="#444444")  # fmt: skip
    axes.set_ylim(0.0, 0.125)
    label(axes, "Friction over speed, W/2R = 0.1 (Fig. 15)", "slip [rpm]", "coefficient [1]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.02, 0.84))
    return figure


FIGURES = {4: figure_4, 7: figure_7, 9: figure_9, 11: figure_11, 15: figure_15}


def main(folder: str | Path | None = None) -> list[Path]:
    """Draw all figures into a folder; return the files."""
    target = Path(folder) if folder else Path(__file__).parents[1] / "images"
    target.mkdir(parents=True, exist_ok=True)
    files = []
    for number, draw in FIGURES.items():
        files.append(target / f"wang2012-fig{number:02d}.png")
        draw().savefig(files[-1], dpi=110, metadata={"Software": None})
    return files


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default="figures", help="to write to; default figures")
    for file in main(parser.parse_args().folder):
        print(file)
