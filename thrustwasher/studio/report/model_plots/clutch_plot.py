"""A wet pack: friction against slip with its shares, and an engagement over time."""

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....clutch.parameters import SPEED, ClutchParams
from ....clutch.solve import boundary_friction, solve_clutch
from ....units import format_quantity
from ..palette import BLACK, BLUE, CELSIUS, GREY, ORANGE, PURPLE, RED, RPM, SIGMA, SKY
from ..style import (
    SECOND,
    TOP,
    decade_ticks,
    heading,
    label,
    legend_below,
    new_figure,
    note_at_right,
    second_scale,
    styled,
)

SAMPLES = 121


def slip_figure(result: Any, point: Mapping[str, Any], params: ClutchParams) -> Figure:
    """Return friction over slip, solved here, at load and interface temperature of ``result``."""
    p = params
    has_shares = p.friction_law == "wang" and result.fidelity != "closed"
    fall = (p.stick_speed + 2.0 * p.decay_speed) / p.friction_radius if has_shares else 1.0
    fastest = min(max(2.0 * abs(point["speed"]), fall), SPEED.high or fall)
    speeds = [fastest * (i / (SAMPLES - 1)) ** 2 for i in range(SAMPLES)]
    held = {**point, "interface_temperature": result.temperature}
    sweep = [
        solve_clutch(params, **{**held, "speed": speed}, fidelity=result.fidelity)
        for speed in speeds
    ]
    share = (p.indentation, 0.0, p.plough_weight, p.hardness_ratio)
    ploughing = boundary_friction(*share) if has_shares else None
    return clutch_figure(speeds, sweep, result, point, ploughing)


@styled
def clutch_figure(
    speeds: Sequence[float],
    sweep: Sequence[Any],
    result: Any,
    point: Mapping[str, float],
    ploughing: float | None = None,
) -> Figure:
    """Return shear ratio, coefficient and torque over slip, with the operating point marked.

    Parameters
    ----------
    speeds : slip [rad/s], not negative, ascending; at 0 the torque is the static one
    sweep : clutch results at these slips
    result : the clutch result at ``point``
    point : load [N], speed [rad/s], oil_temperature [K]
    ploughing : share of the coefficient that does not depend on slip; None where the law has no
        shares, which leaves out the shear ratio too
    """
    names = ["shear", "friction", "torque"] if ploughing is not None else ["friction", "torque"]
    wide, foot = (9.6, 0) if ploughing is None else (10.4, 1)
    figure, axes = new_figure(wide, 4.4, 1, len(names), head=1, foot=foot, top=TOP + SECOND)
    panels = dict(zip(names, axes, strict=True))
    here, friction = abs(point["speed"]), [r.friction_coefficient for r in sweep]
    capacity = [r.torque_capacity for r in sweep]
    base = [min(ploughing or 0.0, mu) for mu in friction]
    contact = [abs(r.contact_torque) for r in sweep]
    ploughed = [t * b / mu if mu else 0.0 for t, b, mu in zip(contact, base, friction, strict=True)]
    if ploughing is not None:
        panels["shear"].plot(speeds, [r.shear_ratio for r in sweep], color=PURPLE)
        panels["shear"].plot([here], [result.shear_ratio], "o", color=BLACK, zorder=5)
        label(panels["shear"], "Shear ratio", "", "shear ratio $s/s_m$ [1]", above=SECOND)
        _draw_shares(panels["friction"], speeds, base, friction)
        _draw_shares(panels["torque"], speeds, ploughed, contact)
        panels["torque"].fill_between(
            speeds, contact, capacity, color=ORANGE, alpha=0.45, lw=0.0, label="shear of the oil"
        )
    rest = f"at rest {friction[0]:.4g}", f"static {format_quantity(capacity[0], 'N.m')}"
    for name, values, value, colour, words in (
        ("friction", friction, result.friction_coefficient, BLUE, rest[0]),
        ("torque", capacity, result.torque_capacity, RED, rest[1]),
    ):
        panels[name].plot(speeds, values, color=colour)
        panels[name].axhline(values[0], color=BLACK, lw=0.9, ls=":")
        panels[name].plot([here], [value], "o", color=BLACK, zorder=5)
        note_at_right(panels[name], words, values[0], shift=(-3, 3), fontsize=8.5, color="#444444")
    torque = "friction torque, magnitude [N·m]"
    label(panels["friction"], "Friction coefficient", "", "friction coefficient [1]", above=SECOND)
    label(panels["torque"], "Torque of the pack", "", torque, above=SECOND)
    for axis in panels.values():
        _scale(axis, speeds[-1])
    if ploughing is not None:
        legend_below(figure, *panels["torque"].get_legend_handles_labels(), columns=3)
    heading(
        figure,
        f"Wet friction pack pressed with {format_quantity(point['load'], 'N')}, "
        f"faces at {format_quantity(result.temperature, 'K')}; dot: {here:.4g} "
        f"rad/s, {format_quantity(abs(result.friction_torque), 'N.m')}",
    )
    return figure


def _draw_shares(
    axis: Axes, speeds: Sequence[float], base: Sequence[float], whole: Sequence[float]
) -> None:
    """Fill the ploughing share from zero and the adhesive share on top of it."""
    axis.fill_between(speeds, 0.0, base, color=GREY, alpha=0.45, lw=0.0, label="ploughing")
    axis.fill_between(speeds, base, whole, color=SKY, alpha=0.35, lw=0.0, label="adhesion")


def _scale(axis: Axes, fastest: float) -> None:
    """Begin both axes at zero, rad/s below and rpm above."""
    axis.set_xlim(0.0, fastest)
    axis.set_ylim(0.0, 1.12 * axis.get_ylim()[1])
    axis.set_xlabel("slip [rad/s]")
    above = second_scale(axis, RPM, "slip [rpm]")
    above.xaxis.label.set_fontsize(8.5)
    above.tick_params(labelsize=8)


@styled
def engagement_figure(result: Any) -> Figure:
    """Return four panels over time.

    Parameters
    ----------
    result : an engagement of the clutch, arrays over ``time`` [s]
    """
    figure, axes = new_figure(10.4, 7.2, 2, 2)
    torque, film, heat, inputs = axes
    t = 1e3 * result.time
    torque.plot(t, result.friction_torque, color=BLACK, label="friction torque")
    torque.plot(t, result.contact_torque, color=RED, ls="--", label="asperities")
    torque.plot(t, result.viscous_torque, color=BLUE, ls="-.", label="shear of the oil")
    label(torque, "Torque of the pack", "time [ms]", "torque [N·m]")
    torque.legend()

    film.plot(t, result.film_ratio, color=BLUE)
    film.set_yscale("log")
    for ratio, words in ((3.0, "3: mixed"), (1.0, "1: boundary")):
        film.axhline(ratio, color=ORANGE, lw=0.9, ls=":")
        note_at_right(film, words, ratio, va="bottom", color=GREY)
    decade_ticks(film)
    label(film, "Film between the faces", "time [ms]", f"film ratio h/{SIGMA} [1]")

    heat.plot(t, result.temperature - CELSIUS, color=RED)
    label(heat, "Interface temperature", "time [ms]", "temperature [°C]")

    inputs.plot(t, result.load / 1e3, color=GREY, label="load [kN]")
    inputs.plot(t, result.heat_flux / 1e6, color=RED, label="heat flux [MW/m²]")
    inputs.plot(t, 1e-2 * result.speed, color=SKY, label="slip [100 rad/s]")
    label(inputs, "What drives it", "time [ms]", "load, heat flux, slip")
    inputs.legend()
    return figure
