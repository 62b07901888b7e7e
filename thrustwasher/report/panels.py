"""Single panels over the time of a shift; figures are put together from them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .extremes import distressed
from .shift_record import Record
from .style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, beside, label

Array = np.ndarray[Any, Any]
CELSIUS = 273.15
SHADES = ("#F1F1F1", "#FFF3D9", "#E2F0FA", "#E3F4EC", "#F7E9F1")
LOWEST_RATIO = 0.05  # film ratios at or below this are drawn on this line
LINING_LIMIT = 523.15  # [K] oil and lining fail above
WASHER_RISE = 200.0  # [K] mean rise above the oil at which the paper calls a washer distressed


def draw_speeds(axis: Axes, record: Record) -> None:
    """Draw the speeds with phases shaded and events numbered."""
    _draw_phases(axis, record, legend=True)
    for name, words, colour, dashes in (
        ("transmission.engine_speed", "engine (sun)", BLUE, "-"),
        ("transmission.output_speed", "output (carrier)", GREEN, "-"),
        ("transmission.ring_speed", "drum (ring)", PURPLE, "-"),
        ("transmission.clutch_speed", "clutch slip", RED, "--"),
        ("transmission.washer_speed", "planet on its pin", ORANGE, "-."),
    ):
        if record.part("washer") or "washer" not in name:
            _draw(axis, record, name, words, colour, dashes)
    _draw_events(axis, record)
    label(axis, "Speeds: the engine comes down to the output", "", "speed [rad/s]")
    beside(axis)


def draw_torques(axis: Axes, record: Record) -> None:
    """Draw the large torques."""
    _draw_phases(axis, record)
    for name, words, colour, dashes in (
        ("transmission.drive_torque", "engine", BLUE, "-"),
        ("transmission.clutch_reaction", "clutch", RED, "-"),
        ("clutch.torque_capacity", "clutch could hold", RED, ":"),
        ("transmission.brake_reaction", "brake", PURPLE, "-"),
        ("transmission.sun_torque", "sun's teeth", GREY, "--"),
        ("transmission.resistance_torque", "load at the output", GREEN, "-"),
    ):
        _draw(axis, record, name, words, colour, dashes)
    held, able = (
        record.series("transmission.brake_reaction"),
        record.series("brake.torque_capacity"),
    )
    if held is not None and able is not None:  # on the side where the brake is needed
        side = -1.0 if -np.min(held) > np.max(held) else 1.0
        axis.plot(record.time, side * able, color=PURPLE, ls=":", label="brake could hold")
    label(axis, "Torques: the clutch takes over from the brake", "", "torque [N·m]")
    beside(axis)


def draw_drag(axis: Axes, record: Record) -> None:
    """Draw the small torque of one washer."""
    _draw_phases(axis, record, words=False)
    _draw(axis, record, "washer.friction_torque", "one thrust washer", ORANGE)
    label(axis, "Drag of one thrust washer", "", "torque [N·m]")
    beside(axis)


def draw_temperatures(axis: Axes, record: Record) -> None:
    """Draw the temperatures with the limits that are near."""
    _draw_phases(axis, record)
    hottest = 1.0
    for name, words, colour, dashes in (
        ("clutch.temperature", "clutch interface", RED, "-"),
        ("brake.temperature", "brake interface", PURPLE, "-"),
        ("washer.temperature_max", "washer, hottest spot", ORANGE, ":"),
        ("washer.temperature", "washer, mean film", ORANGE, "-"),
        ("transmission.oil_supply_temperature", "oil", BLACK, "--"),
    ):
        hottest = max(hottest, _draw(axis, record, name, words, colour, dashes, zero=CELSIUS))
    limits = [("oil and lining fail", LINING_LIMIT, RED)]
    if record.series("washer.temperature") is not None:
        limits.append(("washer's mean: distress", record.oil_temperature + WASHER_RISE, ORANGE))
    for words, kelvin, colour in limits:
        far = kelvin - CELSIUS > 1.6 * hottest
        text = f"{words}: {kelvin - CELSIUS:.0f} °C" + (" (off scale)" if far else "")
        axis.axhline(np.nan if far else kelvin - CELSIUS, color=colour, lw=0.9, ls=(0, (1, 3)),
                     label=text)  # fmt: skip
    label(axis, "Temperatures", "", "temperature [°C]")
    beside(axis)


def draw_films(axis: Axes, record: Record) -> bool:
    """Draw the film ratios over regime bands, distress marked; False if there is no film."""
    drawn = []
    for name, words, colour in (
        ("clutch.film_ratio", "clutch", RED),
        ("brake.film_ratio", "brake", PURPLE),
        ("washer.film_ratio", "thrust washer", ORANGE),
        ("mesh.film_ratio", "gear mesh", GREEN),
    ):
        values = record.series(name)
        if values is not None:
            shown = np.maximum(values, LOWEST_RATIO)
            axis.plot(record.time, shown, color=colour, label=words, zorder=3)
            drawn.append(shown)
    if not drawn:
        return False
    low = max(LOWEST_RATIO, 0.6 * min(float(np.min(d)) for d in drawn))
    high = 1.6 * max(3.0, *(float(np.max(d)) for d in drawn))
    _draw_regimes(axis, low, high)
    _draw_phase_lines(axis, record)
    lost = distressed(record)
    if np.any(lost):
        axis.plot(record.time[lost], np.full(np.sum(lost), 0.82 * high), "|", color=BLACK, ms=7,
                  mew=1.2, label="washer's film lost (distress)", zorder=4)  # fmt: skip
    up = r"film ratio $h/\sigma$ [1]"
    label(axis, "Film ratios: does oil or do asperities carry?", "", up)
    beside(axis)
    return True


def draw_washer_load(axis: Axes, record: Record, load: Array, share: Array) -> None:
    """Draw the load on one washer, split into what oil and asperities carry."""
    some = _thin(record)
    axis.stackplot(
        record.time[some], (load * share)[some], (load * (1.0 - share))[some], colors=[SKY, RED],
        labels=["carried by the oil film", "carried by asperities"], lw=0, alpha=0.75,
    )  # fmt: skip
    axis.plot(record.time, load, color=BLACK, lw=1.2, label="load on one washer")
    _draw_phase_lines(axis, record)
    axis.set_ylim(bottom=0.0)
    label(axis, "Load on one thrust washer", "", "load [N]")
    beside(axis)


def draw_energy(axis: Axes, record: Record) -> None:
    """Draw where the energy went as areas that fill up to what came in."""
    zero = np.zeros_like(record.time)

    def kilojoules(name: str) -> Array:
        values = record.series(f"transmission.{name}")
        return zero if values is None else values / 1e3

    parts = [
        (kilojoules(name), words, colour)
        for name, words, colour in (
            ("load_work", "work into the load", GREEN),
            ("clutch_heat", "heat in the clutch", RED),
            ("brake_heat", "heat in the brake", PURPLE),
            ("washer_heat", "heat in all washers", ORANGE),
            ("mesh_heat", "heat in all meshes", SKY),
        )
    ]
    parts = [part for part in parts if np.any(part[0] != 0.0)]
    some = _thin(record)
    if parts:
        axis.stackplot(record.time[some], *(p[0][some] for p in parts), lw=0, alpha=0.8,
                       labels=[p[1] for p in parts], colors=[p[2] for p in parts])  # fmt: skip
    engine, kinetic = kilojoules("engine_work"), kilojoules("kinetic_change")
    axis.plot(record.time, engine, color=BLUE, label="work of the engine")
    words = "engine, less kinetic energy gained" if kinetic[-1] > 0.0 else (
        "engine + kinetic energy given up"
    )  # fmt: skip
    axis.plot(record.time, engine - kinetic, color=BLACK, ls="--", lw=1.2, label=words)
    title = "Energy: the areas fill up to the dashed line if no joule is lost"
    label(axis, title, "", "energy since the start [kJ]")
    beside(axis)


def draw_heat_flow(axis: Axes, record: Record) -> None:
    """Draw the friction power of the packs and of one washer."""
    _draw_phases(axis, record)
    for name, words, colour in (
        ("clutch.friction_power", "clutch", RED),
        ("brake.friction_power", "brake", PURPLE),
        ("washer.friction_power", "one washer", ORANGE),
    ):
        values = record.series(name)
        if values is not None:
            axis.plot(record.time, values / 1e3, color=colour, label=words)
    label(axis, "Heat flow", "", "power [kW]")
    beside(axis)


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


def _thin(record: Record) -> Array:
    """Return the indices of at most about 600 times: areas are not simplified by the plotter."""
    step = max(1, len(record.time) // 600)
    return np.unique(np.append(np.arange(0, len(record.time), step), len(record.time) - 1))


def _draw_phases(axis: Axes, record: Record, words: bool = True, legend: bool = False) -> None:
    """Shade the phases and write the name of those that are wide enough."""
    first, last = float(record.time[0]), float(record.time[-1])
    axis.set_xlim(first, last)
    axis.margins(y=0.1)  # room for the names at the top
    for index, phase in enumerate(record.phases):
        shade = SHADES[index % len(SHADES)]
        axis.axvspan(phase.start, phase.end, color=shade, lw=0, zorder=0,
                     label=phase.name if legend else None)  # fmt: skip
        if words and phase.end - phase.start > 0.11 * (last - first):
            axis.annotate(phase.name, (0.5 * (phase.start + phase.end), 0.985), ha="center",
                          va="top", xycoords=axis.get_xaxis_transform(), fontsize=8.5,
                          color="#666666")  # fmt: skip


def _draw_events(axis: Axes, record: Record) -> None:
    """Draw the events as numbered lines; numbers of close neighbours stand above each other."""
    close = 0.025 * float(record.time[-1] - record.time[0])
    height, before = 0, -np.inf
    for number, event in enumerate(record.events, 1):
        height = height + 1 if event.time - before < close else 0
        before = event.time
        axis.axvline(event.time, color="#444444", lw=0.8, ls=":",
                     label=f"{number}: {event.time:.4g} s {event.text}")  # fmt: skip
        axis.annotate(str(number), (event.time, 0.0), (2, 3 + 9 * height),
                      textcoords="offset points", xycoords=axis.get_xaxis_transform(),
                      fontsize=8, color="#444444")  # fmt: skip


def _draw_phase_lines(axis: Axes, record: Record) -> None:
    """Draw thin lines where a phase begins."""
    axis.set_xlim(float(record.time[0]), float(record.time[-1]))
    for phase in record.phases[1:]:
        axis.axvline(phase.start, color="#999999", lw=0.8, ls=":")


def _draw_regimes(axis: Axes, low: float, high: float) -> None:
    """Draw the regime bands behind a logarithmic axis of film ratios."""
    for bottom, top, shade, words in (
        (3.0, high, "#EAF4FB", "full film"),
        (1.0, 3.0, "#FFF6E3", "mixed"),
        (low, 1.0, "#FBE9E1", "boundary"),
    ):
        if bottom < top:
            axis.axhspan(bottom, top, color=shade, lw=0, zorder=0)
            axis.annotate(
                words, (0.995, bottom), (0, 3), xycoords=axis.get_yaxis_transform(),
                textcoords="offset points", ha="right", va="bottom", fontsize=8.5, color="#666666",
            )  # fmt: skip
    for ratio in (1.0, 3.0):
        axis.axhline(ratio, color="#555555", lw=0.9, ls="--", zorder=1)
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    axis.set_yticks([v for v in (0.1, 0.3, 1, 3, 10, 30, 100, 300) if low <= v <= high])
    axis.yaxis.set_major_formatter("{x:g}")
    axis.minorticks_off()
