"""An engagement of a wet pack over time: torque and its shares, film, temperature, heat flux."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure

from .style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    RED,
    SIGMA,
    SKY,
    decade_ticks,
    label,
    new_figure,
    styled,
)

CELSIUS = 273.15


@styled
def engagement_figure(result: Any) -> Figure:
    """Return four panels over time.

    Parameters
    ----------
    result : an engagement of the clutch, arrays over ``time`` [s]
    """
    figure, axes = new_figure(10.4, 7.2, 2, 2)
    torque, film, heat, course = axes
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
        film.annotate(
            words, (1.0, ratio), (-2, 2), xycoords=film.get_yaxis_transform(),
            textcoords="offset points", ha="right", va="bottom", fontsize=8, color=GREY,
        )  # fmt: skip
    decade_ticks(film)
    label(film, "Film between the faces", "time [ms]", f"film ratio h/{SIGMA} [1]")

    heat.plot(t, result.temperature - CELSIUS, color=RED)
    label(heat, "Interface temperature", "time [ms]", "temperature [°C]")

    course.plot(t, result.load / 1e3, color=GREY, label="load [kN]")
    course.plot(t, result.heat_flux / 1e6, color=RED, label="heat flux [MW/m²]")
    course.plot(t, 1e-2 * result.speed, color=SKY, label="slip [100 rad/s]")
    label(course, "What drives it", "time [ms]", "load, heat flux, slip")
    course.legend()
    return figure
