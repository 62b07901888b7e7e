"""Draw Figures 3 and 4 of Atan (2005) from this package's gear mesh, and compare flash formulas.

    python docs/papers/atan_figures.py [FOLDER]

Writes atan2005-fig03-*.png and -fig04-*.png (bounded: the model's defaults; literal: the paper
taken at its word), atan2005-flash.png and atan2005-viscous.png, by default to the folder
figures, in about ten seconds. Prints the table of flash temperatures of the paper's page.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
from closed_forms.flash_temperature import (
    ELLIPTIC,
    Body,
    blok_flash,
    film_rise,
    iso_flash,
    pinion_flash,
    sheared_heat,
    surface_rise,
)
from closed_forms.involute_mesh import (
    Mesh,
    flanks_at,
    line_load,
    start_of_contact,
)
from closed_forms.line_contact import compliance, full_width

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.studio.report.model_plots.gearmesh_plot import draw_ratios, draw_temperatures
from thrustwasher.studio.report.palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from thrustwasher.studio.report.style import heading, label, legend_below, new_figure, styled

POWER, SPEED, CENTRES, PHI, FACE = 7500.0, 180.0, 0.254, math.radians(20.0), 0.05
INLET = 299.85  # K
TEETH = range(12, 61)
PANELS = (("a", "inlet", 2.0), ("b", "inlet", 5.0), ("c", "surface", 2.0), ("d", "surface", 5.0))
READINGS = {"bounded": "bounded model, face 50 mm", "literal": "literal reading, face 1 m"}
STEEL = Body(compliance(205e9, 0.3), 50.2, 7850.0, 475.0)
COLOURS = (BLACK, BLUE, SKY, GREEN, ORANGE, RED, PURPLE, GREY)
Draw = Callable[[Axes, Sequence[int], Any], None]


@cache
def sweep(preset: str, viscosity_at: str, ratio: float, surface: str) -> list[Any]:
    """Return the results over TEETH, None where the model refuses (interference, friction law)."""

    def solved(teeth: int) -> Any:
        try:
            params = GearMeshParams.preset(
                preset, viscosity_at=viscosity_at, gear_ratio=ratio, pinion_teeth=teeth,
                surface=surface,
            )  # fmt: skip
        except ParameterError:
            return None
        return solve_gearmesh(params, power=POWER, speed=SPEED)

    return [solved(n) for n in TEETH]


@styled
def four_panels(preset: str, number: int, draw: Draw, highest: float | None = None) -> Figure:
    """Return one of the paper's figures with its panels a to d."""
    figure, panels = new_figure(10.0, 7.4, 2, 2, head=1, foot=1, sharex=True, sharey=True)
    for axes, (letter, viscosity_at, ratio) in zip(panels, PANELS, strict=True):
        draw(axes, TEETH, {s: sweep(preset, viscosity_at, ratio, s) for s in ("rough", "fine")})
        axes.set_title(f"{letter}: ratio {ratio:g}, viscosity at the {viscosity_at} temperature")
        axes.get_legend().remove()
        axes.label_outer()
        if highest:
            axes.set_ylim(0.0, highest)
    legend_below(figure, *panels[0].get_legend_handles_labels(), columns=4)
    heading(figure, f"Atan (2005), Fig. {number}, redrawn: {READINGS[preset]}")
    return figure


def mesh_of(ratio: float, teeth: int) -> Mesh:
    """Return the paper's mesh with another ratio and number of teeth."""
    return Mesh(ratio, teeth, CENTRES, PHI)


def flash_forms(ratio: float, teeth: int, friction: float = 0.08) -> tuple[float, float, float]:
    """Return the flash rise [K] after Eq 3 (half the heat), Blok (elliptic) and the standard."""
    mesh, torque = mesh_of(ratio, teeth), POWER / SPEED
    flanks = flanks_at(start_of_contact(mesh), mesh, SPEED)
    load = line_load(torque, mesh, FACE)
    width = full_width(load, flanks.radius, 2.0 * STEEL.compliance)
    speeds = flanks.speed_pinion, flanks.speed_gear
    return (
        pinion_flash(mesh, torque, SPEED, FACE, 0.5 * friction, STEEL),
        blok_flash(load, friction, *speeds, width, STEEL.effusivity, ELLIPTIC),
        iso_flash(mesh, torque, SPEED, FACE, friction, STEEL),
    )


@styled
def flash_figure() -> Figure:
    """Return the three flash temperatures, and Eq 3 over Blok for all ratios and teeth."""
    figure, (left, right) = new_figure(10.4, 4.4, 1, 2)
    teeth = range(17, 61)
    for ratio, colour in ((2.0, BLUE), (5.0, RED)):
        rises = [flash_forms(ratio, n) for n in teeth]
        looks = {"Eq 3, half the heat": "-", "Blok, elliptic heat": "--", "standard's form": "none"}
        for i, (words, look) in enumerate(looks.items()):
            marker = {"marker": "o", "markevery": 4, "ms": 4.0, "mfc": "white"} if i == 2 else {}
            left.plot(teeth, [r[i] for r in rises], color=colour, ls=look, **marker,
                      label=f"{words}, ratio {ratio:g}")  # fmt: skip
    left.set_yscale("log")
    left.yaxis.set_major_formatter("{x:g}")
    left.legend()
    label(left, "Flash rise, friction 0.08, area ratio 1", "teeth of the pinion [1]", "rise [K]")
    for ratio, colour in zip(range(1, 9), COLOURS, strict=True):
        rises = [flash_forms(float(ratio), n) for n in teeth]
        right.plot(teeth, [r[0] / r[1] for r in rises], color=colour, label=f"ratio {ratio}")
    right.axhline(1.0, color=GREY, lw=0.9, ls=":")
    right.set_ylim(0.9, 4.0)
    right.legend(ncols=2)
    label(right, "Eq 3 with half the heat over Blok", "teeth of the pinion [1]", "ratio [1]")
    return figure


def printed_oil(ratio: float, teeth: int) -> tuple[float, float, float]:
    """Return film thickness [m], rise of the flank and of the film above it [K], 1000 x viscosity.

    With the reference viscosity as printed, 0.97 g/(cm s); bounded model, face 50 mm.
    """
    r = solve_gearmesh(
        GearMeshParams.preset(
            "paper", gear_ratio=ratio, pinion_teeth=teeth, viscosity_at="inlet"
        ),
        power=POWER, speed=SPEED,
    )  # fmt: skip
    speed = flanks_at(r.start_of_contact, mesh_of(ratio, teeth), SPEED).speed_pinion
    film, steel = r.film_thickness * 1e3**0.7, STEEL.density * STEEL.heat_capacity
    heat = 0.5 * sheared_heat(1e3 * r.viscosity, r.sliding_speed, r.hertz_width, film)
    flank = surface_rise(
        heat, speed, r.hertz_width, STEEL.conductivity, STEEL.density, STEEL.heat_capacity
    )
    inside = film_rise(
        heat, speed, r.hertz_width, film, STEEL.conductivity, steel, 0.13, 880.0 * 2010.0
    )
    return film, flank, inside


@styled
def viscous_figure() -> Figure:
    """Return the rises that shear of the film makes: flank, and film with both viscosities."""
    figure, (left, right) = new_figure(10.4, 4.2, 1, 2)
    teeth = range(17, 61)
    for ratio, colour in ((2.0, BLUE), (5.0, RED)):
        for viscosity_at, look in (("inlet", "-"), ("surface", "--")):
            row = sweep("bounded", viscosity_at, ratio, "rough")[-len(teeth) :]
            left.plot(teeth, [r.surface_temperature - INLET for r in row], color=colour, ls=look,
                      label=f"ratio {ratio:g}, viscosity at {viscosity_at}")  # fmt: skip
        row = sweep("bounded", "inlet", ratio, "rough")[-len(teeth) :]
        right.plot(teeth, [r.film_temperature - r.surface_temperature for r in row],
                   color=colour, label=f"ratio {ratio:g}")  # fmt: skip
        right.plot(teeth, [printed_oil(ratio, n)[2] for n in teeth], color=colour, ls=":",
                   label=f"ratio {ratio:g}, viscosity as printed")  # fmt: skip
    for axes in (left, right):
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter("{x:g}")
        axes.legend()
    right.set_ylim(1e-1, 1e4)
    label(left, "Flank above the oil, by shear of the film", "teeth of the pinion [1]", "rise [K]")
    label(right, "Hottest film above the flank", "teeth of the pinion [1]", "rise [K]")
    return figure


def flash_table() -> str:
    """Return Eq 3 over Blok for ratios and numbers of teeth as a Markdown table."""
    teeth = (17, 20, 30, 60)
    lines = ["| ratio | " + " | ".join(f"{n} teeth" for n in teeth) + " |"]
    lines.append("|---" * (len(teeth) + 1) + "|")
    for ratio in (2, 5, 8):
        forms = [flash_forms(float(ratio), n) for n in teeth]
        lines.append(f"| {ratio} | " + " | ".join(f"{a / b:.2f}" for a, b, _ in forms) + " |")
    return "\n".join(lines)


def main(folder: str | Path | None = None) -> list[Path]:
    """Draw all figures into a folder; return the files."""
    target = Path(folder) if folder else Path(__file__).parents[1] / "images"
    target.mkdir(parents=True, exist_ok=True)
    figures = {"atan2005-flash": flash_figure(), "atan2005-viscous": viscous_figure()}
    for preset, highest in (("bounded", 700.0), ("literal", 220.0)):
        figures[f"atan2005-fig03-{preset}"] = four_panels(preset, 3, draw_temperatures, highest)
        figures[f"atan2005-fig04-{preset}"] = four_panels(preset, 4, draw_ratios)
    files = []
    for stem, figure in figures.items():
        files.append(target / f"{stem}.png")
        figure.savefig(files[-1], dpi=110, metadata={"Software": None})
    return files


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default="figures", help="to write to; default figures")
    for file in main(parser.parse_args().folder):
        print(file)
    print(flash_table())
