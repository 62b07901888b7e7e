"""Temperatures of a gear mesh, its loss and safety or endurance, against tooth number."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....errors import ParameterError
from ....gearmesh.solve import GearMeshParams, solve_gearmesh
from ....units import format_quantity
from ..palette import BLACK, BLUE, CELSIUS, GREEN, GREY, ORANGE, PURPLE, RED
from ..style import heading, label, new_figure, styled

# Surface -> words, colour of its asperities, dashes, marker.
SURFACES: dict[str, tuple[str, str, Any, str]] = {
    "rough": ("rough ground", RED, "-", "o"),
    "fine": ("fine ground", GREEN, (0, (4, 2)), "s"),
    "given": ("these flanks", PURPLE, "-.", "^"),
}
# A line: name of the result, words, colour (None: that of the surface), look.
Line = tuple[str, str, str | None, dict[str, Any]]
PLAIN = {"marker": "", "ls": "-"}
TEMPERATURES: tuple[Line, ...] = (
    ("film_temperature", "film", GREY, {**PLAIN, "ls": ":"}),
    ("asperity_temperature", "asperities", None, {"lw": 2.4}),
    ("surface_temperature", "surface $T_s$", BLUE, {**PLAIN, "lw": 1.1, "zorder": 4}),
)
SAFETIES: tuple[Line, ...] = (
    ("pitting_safety", "pitting", BLUE, {}),
    ("scuffing_safety", "scuffing", RED, {}),
    ("micropitting_safety", "micropitting", GREEN, {}),
)
LOSS: tuple[Line, ...] = (("friction_power", "", None, {}),)
SMOOTH = ("film_temperature", "surface_temperature", "pitting_safety")  # know no roughness
# Steel -> words, colour, width: a thin line stays visible on a wide one.
STEELS = {"aisi1020": ("AISI 1020", BLUE, 3.0), "aisi4340": ("AISI 4340", RED, 1.4)}
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
    dot: dict[str, Any] = {"marker": "o", "color": BLACK, "ls": "", "ms": 5.5, "zorder": 6}
    for axis in axes:
        axis.set_xlabel("teeth of the pinion [1]")
        axis.set_xlim(min(teeth) - 1, max(teeth) + 1)
    draw_temperatures(axes[0], teeth, sweeps)
    label(axes[0], "Temperatures", "", "temperature [°C]")
    axes[0].plot([here], [result.asperity_temperature - CELSIUS], **dot)
    if result.allowable_ratio is None:
        _draw(axes[1], teeth, sweeps, SAFETIES, level=BLACK, loc="best")
        label(axes[1], "Safety of the teeth", "", "safety factor [1]")
        safeties = (getattr(result, name) for name, *_ in SAFETIES)
        axes[1].plot(*zip(*((here, s) for s in safeties if s is not None), strict=True), **dot)
        _draw(axes[2], teeth, sweeps, LOSS)
        axes[2].set_ylim(bottom=0.0)
        label(axes[2], "Loss", "", "friction power [W]")
        axes[2].plot([here], [result.friction_power], **dot)
    else:
        draw_ratios(axes[1], teeth, sweeps)
        label(axes[1], "Contact stress still allowed", "", r"allowable ratio $1/\sqrt{1+K}$ [1]")
        rest = f"not drawn: K below {LEAST_FACTOR:g}"
        factors = _of_steels("modification_factor")
        _draw(axes[2], teeth, sweeps, factors, level=ORANGE, least=LEAST_FACTOR, title=rest)
        axes[2].set_ylim(bottom=LEAST_FACTOR)
        label(axes[2], "Stress modification factor", "", "K [1]")
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
    """Draw temperatures of film, asperities and surface [degC]."""
    _draw(axes, teeth, sweeps, TEMPERATURES, zero=CELSIUS)


def draw_ratios(axes: Axes, teeth: Sequence[int], sweeps: Sweeps) -> None:
    """Draw the allowable ratio of each steel [1]."""
    _draw(axes, teeth, sweeps, _of_steels("allowable_ratio"), loc="lower right")
    axes.set_ylim(0.0, 1.04)


def _of_steels(name: str) -> list[Line]:
    return [(f"{name}_{s}", words, own, {"lw": wide}) for s, (words, own, wide) in STEELS.items()]


def _draw(
    axes: Axes,
    teeth: Sequence[int],
    sweeps: Sweeps,
    lines: Sequence[Line],
    *,
    zero: float = 0.0,
    least: float = 0.0,
    level: str = "",
    loc: str = "upper right",
    title: str = "",
) -> None:
    """Draw results over the teeth, a line for each surface, with gaps where there is none.

    Parameters
    ----------
    zero : taken off every value; ``least``: values up to it are left out
    level : colour of a line at 1; the scale is logarithmic then
    """
    every, first = max(1, len(teeth) // 12), next(iter(sweeps))
    for name, own, colour, look in lines:
        for surface, results in sweeps.items():
            words, shade, dashes, marker = SURFACES[surface]
            if name in SMOOTH:
                words = ""
                if surface != first:
                    continue
            values = np.array([getattr(r, name, np.nan) for r in results], float)
            shown = np.where(values > least, values - zero, np.nan)
            text = ", ".join(filter(None, [own, words]))
            more: Any = {"color": colour or shade, "ls": dashes, "marker": marker, **look}
            axes.plot(teeth, shown, label=text, ms=3.2, markevery=every, **more)
    drawn = [line for line in axes.lines if np.any(np.isfinite(np.asarray(line.get_ydata())))]
    place: Any = {"loc": loc, "title": title or None}
    axes.legend(handles=drawn, **place)
    if level:
        axes.axhline(1.0, color=level, lw=0.9, ls=":")
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter("{x:g}")
