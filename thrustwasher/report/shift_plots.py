"""What happened over time in a shift: one figure per question."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .shift_record import Record
from .style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    beside,
    label,
    styled,
    time_figure,
)

Array = np.ndarray[Any, Any]
CELSIUS = 273.15
SHADES = ("#F1F1F1", "#FFF3D9", "#E2F0FA", "#E3F4EC", "#F7E9F1")
LOWEST_RATIO = 0.05  # film ratios at or below this are drawn on this line
LINING_LIMIT = 523.15  # [K] oil and lining fail above
WASHER_RISE = 200.0  # [K] mean rise above the oil at which the paper calls a washer distressed


@styled
def speed_figure(record: Record) -> Figure:
    """Return the speeds with phases shaded and events numbered."""
    figure, (axis,) = time_figure(4.4)
    _draw_phases(axis, record, legend=True)
    for name, words, colour, dashes in (
        ("transmission.engine_speed", "engine (sun)", BLUE, "-"),
        ("transmission.output_speed", "output (carrier)", GREEN, "-"),
        ("transmission.ring_speed", "drum (ring)", PURPLE, "-"),
        ("transmission.clutch_speed", "clutch slip", RED, "--"),
        ("transmission.washer_speed", "planet on its pin", ORANGE, "-."),
    ):
        _draw(axis, record, name, words, colour, dashes)
    _draw_events(axis, record)
    label(axis, "Speeds: the engine comes down to the output", "time [s]", "speed [rad/s]")
    beside(axis)
    return figure


@styled
def torque_figure(record: Record) -> Figure:
    """Return the torques; the small drag of the washers in its own panel."""
    has_washer = record.series("washer.friction_torque") is not None
    figure, axes = time_figure(5.8, 2, (2.4, 1.0)) if has_washer else time_figure(4.2)
    main = axes[0]
    _draw_phases(main, record)
    for name, words, colour, dashes in (
        ("transmission.drive_torque", "engine", BLUE, "-"),
        ("transmission.clutch_reaction", "clutch", RED, "-"),
        ("clutch.torque_capacity", "clutch could hold", RED, ":"),
        ("transmission.brake_reaction", "brake", PURPLE, "-"),
        ("brake.torque_capacity", "brake could hold", PURPLE, ":"),
        ("transmission.sun_torque", "sun's teeth", GREY, "--"),
        ("transmission.resistance_torque", "load at the output", GREEN, "-"),
    ):
        _draw(main, record, name, words, colour, dashes)
    label(main, "Torques: the clutch takes over from the brake", "", "torque [N·m]")
    beside(main)
    if has_washer:
        _draw_phases(axes[1], record, words=False)
        _draw(axes[1], record, "washer.friction_torque", "one thrust washer", ORANGE)
        label(axes[1], "Drag of one thrust washer", "", "torque [N·m]")
        beside(axes[1])
    axes[-1].set_xlabel("time [s]")
    return figure


@styled
def temperature_figure(record: Record) -> Figure:
    """Return the temperatures with the limits that are near."""
    figure, (axis,) = time_figure(4.2)
    _draw_phases(axis, record)
    hottest = 0.0
    for name, words, colour, dashes in (
        ("clutch.temperature", "clutch interface", RED, "-"),
        ("brake.temperature", "brake interface", PURPLE, "-"),
        ("washer.temperature_max", "washer, hottest spot", ORANGE, ":"),
        ("washer.temperature", "washer, mean film", ORANGE, "-"),
        ("transmission.oil_supply_temperature", "oil", BLACK, "--"),
    ):
        drawn = _draw(axis, record, name, words, colour, dashes, zero=CELSIUS)
        hottest = max(hottest, drawn)
    oil = record.oil_temperature
    limits = [("oil and lining fail", LINING_LIMIT, RED)]
    if record.series("washer.temperature") is not None:
        limits.append(("washer's mean: distress", oil + WASHER_RISE, ORANGE))
    for words, kelvin, colour in limits:
        far = kelvin - CELSIUS > 1.6 * max(hottest, 1.0)
        text = f"{words}: {kelvin - CELSIUS:.0f} °C" + (" (above the plot)" if far else "")
        axis.axhline(np.nan if far else kelvin - CELSIUS, color=colour, lw=0.9, ls=(0, (1, 3)),
                     label=text)  # fmt: skip
    label(axis, "Temperatures", "time [s]", "temperature [°C]")
    beside(axis)
    return figure


@styled
def film_figure(record: Record) -> Figure | None:
    """Return the film ratios over regime bands, distress marked; None without any film."""
    figure, (axis,) = time_figure(4.2)
    drawn = []
    for name, words, colour, dashes in (
        ("clutch.film_ratio", "clutch", RED, "-"),
        ("brake.film_ratio", "brake", PURPLE, "-"),
        ("washer.film_ratio", "thrust washer", ORANGE, "-"),
        ("mesh.film_ratio", "gear mesh", GREEN, "-"),
    ):
        values = record.series(name)
        if values is not None:
            shown = np.maximum(values, LOWEST_RATIO)
            axis.plot(record.time, shown, color=colour, ls=dashes, label=words, zorder=3)
            drawn.append(shown)
    if not drawn:
        return None
    low = max(LOWEST_RATIO, 0.6 * min(float(np.min(d)) for d in drawn))
    high = 1.6 * max(3.0, *(float(np.max(d)) for d in drawn))
    for bottom, top, shade, words in (
        (3.0, high, "#EAF4FB", "full film"),
        (1.0, 3.0, "#FFF6E3", "mixed"),
        (low, 1.0, "#FBE9E1", "boundary"),
    ):
        if bottom < top:
            axis.axhspan(bottom, top, color=shade, lw=0, zorder=0)
            axis.annotate(
                words, (0.995, np.sqrt(bottom * top)), xycoords=axis.get_yaxis_transform(),
                ha="right", va="center", fontsize=8.5, color="#666666",
            )  # fmt: skip
    for ratio in (1.0, 3.0):
        axis.axhline(ratio, color="#555555", lw=0.9, ls="--", zorder=1)
    for phase in record.phases[1:]:
        axis.axvline(phase.start, color="#999999", lw=0.8, ls=":")
    distress = record.series("washer.distress")
    if distress is not None and np.any(distress > 0.5):
        times = record.time[distress > 0.5]
        axis.plot(times, np.full(times.shape, 1.25 * low), "|", color=BLACK, ms=7, mew=1.2,
                  label="washer's film lost (distress)", zorder=4)  # fmt: skip
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    axis.set_xlim(record.time[0], record.time[-1])
    axis.set_yticks([v for v in (0.1, 0.3, 1, 3, 10, 30, 100, 300) if low <= v <= high])
    axis.yaxis.set_major_formatter("{x:g}")
    axis.minorticks_off()
    label(axis, "Film ratios: does oil or do asperities carry?", "time [s]",
          r"film ratio $h/\sigma$ [1]")  # fmt: skip
    beside(axis)
    return figure


@styled
def washer_figure(record: Record) -> Figure | None:
    """Return who carries the washer's load; None if the scene has no washer."""
    load = record.series("transmission.washer_load")
    share = record.series("washer.fluid_load_share")
    if load is None or share is None:
        return None
    figure, (axis,) = time_figure(3.4)
    axis.stackplot(
        record.time, load * share, load * (1.0 - share), colors=[SKY, RED],
        labels=["carried by the oil film", "carried by asperities"], lw=0, alpha=0.75,
    )  # fmt: skip
    axis.plot(record.time, load, color=BLACK, lw=1.2, label="load on one washer")
    for phase in record.phases[1:]:
        axis.axvline(phase.start, color="#999999", lw=0.8, ls=":")
    axis.set_xlim(record.time[0], record.time[-1])
    axis.set_ylim(bottom=0.0)
    label(axis, "Load on one thrust washer", "time [s]", "load [N]")
    beside(axis)
    return figure


@styled
def energy_figure(record: Record) -> Figure:
    """Return where the energy went, stacked, and the heat flows."""
    figure, axes = time_figure(6.4, 2, (1.7, 1.0))
    zero = np.zeros_like(record.time)

    def work(name: str) -> Array:
        values = record.series(f"transmission.{name}")
        return zero if values is None else values / 1e3

    parts = [
        ("work into the load", work("load_work"), GREEN),
        ("heat in the clutch", work("clutch_heat"), RED),
        ("heat in the brake", work("brake_heat"), PURPLE),
        ("heat in all washers", work("washer_heat"), ORANGE),
        ("heat in all meshes", work("mesh_heat"), SKY),
    ]
    parts = [p for p in parts if np.any(p[1] != 0.0)]
    if parts:
        axes[0].stackplot(record.time, *(p[1] for p in parts), labels=[p[0] for p in parts],
                          colors=[p[2] for p in parts], lw=0, alpha=0.8)  # fmt: skip
    axes[0].plot(record.time, work("engine_work"), color=BLUE, label="work of the engine")
    axes[0].plot(record.time, work("engine_work") - work("kinetic_change"), color=BLACK, ls="--",
                 lw=1.2, label="engine + kinetic energy given up")  # fmt: skip
    label(axes[0], "Energy: the areas fill up to the dashed line if no joule is lost", "",
          "energy since the start [kJ]")  # fmt: skip
    beside(axes[0])
    for name, words, colour in (
        ("clutch.friction_power", "clutch", RED),
        ("brake.friction_power", "brake", PURPLE),
        ("washer.friction_power", "one washer", ORANGE),
    ):
        values = record.series(name)
        if values is not None:
            axes[1].plot(record.time, values / 1e3, color=colour, label=words)
    _draw_phases(axes[1], record)
    label(axes[1], "Heat flow", "time [s]", "power [kW]")
    beside(axes[1])
    return figure


def _draw(
    axis: Axes,
    record: Record,
    name: str,
    words: str,
    colour: str,
    dashes: str = "-",
    zero: float = 0.0,
) -> float:
    """Draw a signal if the run has it; return its largest value."""
    values = record.series(name)
    if values is None:
        return 0.0
    axis.plot(record.time, values - zero, color=colour, ls=dashes, label=words)
    return float(np.nanmax(values - zero))


def _draw_phases(axis: Axes, record: Record, words: bool = True, legend: bool = False) -> None:
    """Shade the phases and write the name of those that are wide enough."""
    first, last = float(record.time[0]), float(record.time[-1])
    axis.set_xlim(first, last)
    for index, phase in enumerate(record.phases):
        shade = SHADES[index % len(SHADES)]
        axis.axvspan(phase.start, phase.end, color=shade, lw=0, zorder=0,
                     label=phase.name if legend else None)  # fmt: skip
        if words and phase.end - phase.start > 0.06 * (last - first):
            axis.annotate(phase.name, (0.5 * (phase.start + phase.end), 0.985), ha="center",
                          va="top", xycoords=axis.get_xaxis_transform(), fontsize=8.5,
                          color="#666666")  # fmt: skip


def _draw_events(axis: Axes, record: Record) -> None:
    """Draw the events as numbered lines and list them in the legend."""
    for number, event in enumerate(record.events, 1):
        axis.axvline(event.time, color="#444444", lw=0.8, ls=":",
                     label=f"{number}: {event.time:.4g} s {event.text}")  # fmt: skip
        axis.annotate(str(number), (event.time, 0.0), (2, 3), textcoords="offset points",
                      xycoords=axis.get_xaxis_transform(), fontsize=8, color="#444444")  # fmt: skip
