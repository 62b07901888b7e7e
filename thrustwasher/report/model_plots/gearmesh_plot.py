"""Temperatures of a gear mesh, its loss and safety or endurance, against tooth number."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...errors import ParameterError
from ...gearmesh.solve import GearMeshParams, solve_gearmesh
from ...units import format_quantity
from ..palette import BLACK, BLUE, CELSIUS, GREEN, GREY, ORANGE, PURPLE, RED
from ..style import heading, label, new_figure, styled

# Surface -> words, colour of its asperities, dashes, marker.
SURFACES: dict[str, tuple[str, str, Any, str]] = {
    "rough": ("rough ground", RED, "-", "o"),
    "fine": ("fine ground", GREEN, (0, (4, 2)), "s"),
    "given": ("these flanks", PURPLE, "-.", "^"),
}
# Steel -> words, colour, width: a thin line stays visible on a wide one.
STEELS = {"aisi1020": ("AISI 1020", BLUE, 3.0), "aisi4340": ("AISI 4340", RED, 1.4)}
# Safety -> words, colour.
SAFETIES = {
    "pitting_safety": ("pitting", BLUE),
    "scuffing_safety": ("scuffing", RED),
    "micropitting_safety": ("micropitting", GREEN),
}
FEWEST_TEETH, MOST_TEETH = 5, 60
LEAST_FACTOR = 1e-3  # K below leaves more than 99.95 % of the endurance: nothing to see
Sweeps = Mapping[str, Sequence[Any]]  # surface -> results, None where the model refuses


def over_teeth(
    params: GearMeshParams, point: Mapping[str, Any], fidelity: str
) -> tuple[list[int], dict[str, list[Any]]]:
    """Return tooth numbers and the results of each surface there, None where refused.

    "rough" and "fine" have the roughness of these surfaces; where the parameters name their own,
    "given" has that.
    """

    def solved(teeth: int, changes: dict[str, Any]) -> Any:
        try:
            changed = replace(params, pinion_teeth=teeth, **changes)
            return solve_gearmesh(changed, **point, fidelity=fidelity)
        except ParameterError:
            return None

    own = ("sigma_rms", "effective_roughness", "mean_roughness")
    plain = dict.fromkeys(own, 0.0)
    surfaces = {name: {**plain, "surface": name} for name in ("rough", "fine")}
    if any(getattr(params, name) for name in own):
        surfaces["given"] = {}
    every = range(FEWEST_TEETH, max(MOST_TEETH, params.pinion_teeth) + 1)
    sweeps = {name: [solved(n, surface) for n in every] for name, surface in surfaces.items()}
    kept = [i for i in range(len(every)) if any(row[i] is not None for row in sweeps.values())]
    return [every[i] for i in kept], {n: [row[i] for i in kept] for n, row in sweeps.items()}


@styled
def gearmesh_figure(result: Any, point: Mapping[str, float], params: GearMeshParams) -> Figure:
    """Return temperatures over the pinion's teeth, and what they leave of the teeth.

    That is safety and loss; with the paper's heat and steels allowable ratio and modification
    factor.

    Parameters
    ----------
    result : the gear mesh result at ``point``, marked by dots
    point : power [W], speed [rad/s], oil_temperature [K]
    params : the mesh, which is solved here for other numbers of teeth
    """
    teeth, sweeps = over_teeth(params, point, result.fidelity)
    here = params.pinion_teeth
    figure, axes = new_figure(13.2, 4.3, 1, 3, head=1)
    draw_temperatures(axes[0], teeth, sweeps)
    dot: dict[str, Any] = {"marker": "o", "color": BLACK, "ls": "", "ms": 5.5, "zorder": 6}
    axes[0].plot([here], [result.asperity_temperature - CELSIUS], **dot)
    if result.allowable_ratio is None:
        draw_safeties(axes[1], teeth, sweeps)
        draw_loss(axes[2], teeth, sweeps)
        safeties = (getattr(result, name) for name in SAFETIES)
        axes[1].plot(*zip(*((here, s) for s in safeties if s is not None), strict=True), **dot)
        axes[2].plot([here], [result.friction_power], **dot)
    else:
        draw_ratios(axes[1], teeth, sweeps)
        draw_factors(axes[2], teeth, sweeps)
        for steel in STEELS:
            axes[1].plot([here], [getattr(result, f"allowable_ratio_{steel}")], **dot)
            factor = getattr(result, f"modification_factor_{steel}")
            if factor > LEAST_FACTOR:
                axes[2].plot([here], [factor], **dot)
    heading(
        figure,
        f"Gear mesh where it is hottest: {format_quantity(point['power'], 'W')}, "
        f"{format_quantity(point['speed'], 'rad/s')}, oil "
        f"{format_quantity(point['oil_temperature'], 'K')}; dots: {here} teeth, "
        f"asperities at {format_quantity(result.asperity_temperature, 'K')}",
    )
    return figure


def draw_temperatures(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw surface, film and asperity temperatures; surface and film do not know the roughness."""
    first = next(iter(sweeps.values()))
    _line(axes, teeth, first, "film_temperature", GREY, "film", zero=CELSIUS, ls=":")
    for surface, results in sweeps.items():
        words, colour, dashes, marker = SURFACES[surface]
        _line(
            axes,
            teeth,
            results,
            "asperity_temperature",
            colour,
            f"asperities, {words}",
            zero=CELSIUS,
            ls=dashes,
            marker=marker,
            lw=2.4,
        )
    _line(
        axes,
        teeth,
        first,
        "surface_temperature",
        BLUE,
        "surface $T_s$",
        zero=CELSIUS,
        lw=1.1,
        zorder=4,
    )
    label(axes, "Temperatures", "teeth of the pinion [1]", "temperature [°C]")
    axes.legend(loc="upper right")


def draw_safeties(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw the safeties on a logarithmic scale; pitting does not know the roughness."""
    for surface, results in sweeps.items():
        words, _, dashes, marker = SURFACES[surface]
        for name, (said, colour) in SAFETIES.items():
            text = f"{said}, {words}"
            if name == "pitting_safety":
                if results is not next(iter(sweeps.values())):
                    continue
                text = said
            _line(axes, teeth, results, name, colour, text, ls=dashes, marker=marker)
    axes.axhline(1.0, color=BLACK, lw=0.9, ls=":")
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter("{x:g}")
    label(axes, "Safety of the teeth", "teeth of the pinion [1]", "safety factor [1]")
    shown = [line for line in axes.lines if np.any(np.isfinite(np.asarray(line.get_ydata())))]
    axes.legend(
        handles=[line for line in shown if not str(line.get_label()).startswith("_")], loc="best"
    )


def draw_loss(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw the heat that the mesh makes."""
    for surface, results in sweeps.items():
        words, colour, dashes, marker = SURFACES[surface]
        _line(axes, teeth, results, "friction_power", colour, words, ls=dashes, marker=marker)
    axes.set_ylim(bottom=0.0)
    label(axes, "Loss", "teeth of the pinion [1]", "friction power [W]")
    axes.legend(loc="upper right")


def draw_ratios(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw 1/sqrt(1 + K): the share of the endurance limit left for the contact stress."""
    _draw_steels(axes, teeth, sweeps, "allowable_ratio")
    axes.set_ylim(0.0, 1.04)
    label(
        axes,
        "Contact stress still allowed",
        "teeth of the pinion [1]",
        r"allowable ratio $1/\sqrt{1+K}$ [1]",
    )
    axes.legend(loc="lower right")


def draw_factors(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw the modification factor K on a logarithmic scale, where it matters."""
    _draw_steels(axes, teeth, sweeps, "modification_factor", LEAST_FACTOR)
    axes.axhline(1.0, color=ORANGE, lw=0.9, ls=":")
    axes.set_yscale("log")
    axes.set_ylim(bottom=LEAST_FACTOR)
    axes.yaxis.set_major_formatter("{x:g}")
    label(axes, "Stress modification factor", "teeth of the pinion [1]", "K [1]")
    shown = [line for line in axes.lines if np.any(np.isfinite(np.asarray(line.get_ydata())))]
    axes.legend(
        handles=[line for line in shown if not str(line.get_label()).startswith("_")],
        loc="upper right",
        title=f"not drawn: K below {LEAST_FACTOR:g}",
    )


def _draw_steels(
    axes: Axes, teeth: Sequence[int], sweeps: Sweeps, name: str, least: float = 0.0
) -> None:
    """Draw one line for each steel and surface; values up to ``least`` are left out."""
    for surface, results in sweeps.items():
        words, _, dashes, marker = SURFACES[surface]
        for steel, (name_of_steel, colour, width) in STEELS.items():
            _line(
                axes,
                teeth,
                results,
                f"{name}_{steel}",
                colour,
                f"{name_of_steel}, {words}",
                least=least,
                ls=dashes,
                marker=marker,
                lw=width,
            )


def _line(
    axes: Axes,
    teeth: Sequence[int],
    results: Sequence[Any],
    name: str,
    colour: str,
    words: str,
    zero: float = 0.0,
    least: float = 0.0,
    **look: Any,
) -> None:
    """Draw a result over the teeth, with gaps where there is none above ``least``."""
    values = np.array([getattr(r, name, np.nan) for r in results], float)
    shown = np.where(values > least, values - zero, np.nan)
    axes.plot(
        teeth, shown, color=colour, label=words, ms=3.2, markevery=max(1, len(teeth) // 12), **look
    )
    axes.set_xlim(min(teeth) - 1, max(teeth) + 1)
