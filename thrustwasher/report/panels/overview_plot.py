"""A shift in one picture: speeds, torques and film ratios below each other."""

from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, COLOURS, GREEN, GREY, ORANGE, PURPLE, RED, SIGMA, SKY
from ..shift.shift_record import PACKS, Array, Record
from ..shift.worst_moments import distressed
from ..style import label, note_at_right, styled, time_figure

MOST_EVENTS, FIRST_EVENTS = 8, 5  # numbered in a panel: all, or the first of too many
LETTER = 0.008  # of the panel's width: a phase that its name fits in has it there
SHADES = ("#F1F1F1", "#FFF3D9", "#E2F0FA", "#E3F4EC", "#F7E9F1")
LOWEST_RATIO = 0.01  # film ratios at or below this are drawn on this line


@styled
def overview_figure(record: Record) -> Figure:
    """Return the figure; without any film its lowest panel stays empty."""
    figure, (speeds, torques, ratios) = time_figure(8.6, 3, (1.15, 1.15, 1.0))
    draw_speeds(speeds, record)
    draw_torques(torques, record)
    draw_films(ratios, record)
    return figure


def elastic(record: Record) -> bool:
    """Return whether the output shaft twists; a rigid one only repeats carrier and load."""
    twist = record.series("transmission.shaft_twist")
    return twist is not None and bool(np.any(twist))


def draw_speeds(axis: Axes, record: Record) -> None:
    """Draw the speeds with phases shaded and events numbered; of a lone brake only the drum's."""
    draw_phases(axis, record, legend=True)
    lone_brake = record.alone and record.engaging == "brake"
    for name, words, colour, dashes in (
        ("transmission.engine_speed", "engine", BLUE, "-"),
        ("transmission.output_speed", "output (carrier)", GREEN, "-"),
        ("transmission.vehicle_speed", "vehicle", BLACK, ":"),
        ("transmission.drum_speed", "drum", PURPLE, "-"),
        ("transmission.clutch_speed", "clutch slip", RED, "--"),
        ("transmission.washer_speed", "planet on its pin", ORANGE, "-."),
    ):
        at_planets = "washer" in name
        if at_planets and not (record.part("washer") or record.part("mesh")):
            continue
        if "vehicle" in name and not elastic(record):
            continue
        if not lone_brake or "drum" in name:
            draw(axis, record, name, words, colour, dashes)
    draw_events(axis, record)
    finish(axis, _speed_title(record), "speed [rad/s]")


def _speed_title(record: Record) -> str:
    if record.alone:
        return f"Speed: the {record.engaging} brings it to rest"
    if not record.presses(record.releasing):
        return "Speeds"
    if record.engaging == "clutch":
        return "Speeds: the engine comes down to the output"
    return "Speeds: the engine goes up to its ratio"


def draw_torques(axis: Axes, record: Record) -> None:
    """Draw the large torques; one that is zero throughout is left out."""
    draw_phases(axis, record)
    for name, words, colour, dashes in (
        ("transmission.drive_torque", "engine", BLUE, "-"),
        ("transmission.clutch_reaction", "clutch", RED, "-"),
        ("clutch.torque_capacity", "clutch could hold", RED, ":"),
        ("transmission.brake_reaction", "brake", PURPLE, "-"),
        ("transmission.input_tooth_torque", "driven gear's teeth", GREY, "--"),
        ("transmission.resistance_torque", "load at the output", GREEN, "-"),
        ("transmission.shaft_torque", "output shaft", BLACK, "-"),
    ):
        values = record.series(name)
        hidden = (record.alone and "tooth" in name) or ("shaft" in name and not elastic(record))
        if values is not None and np.any(values != 0.0) and not hidden:
            draw(axis, record, name, words, colour, dashes)
    _draw_brake_capacity(axis, record)
    _draw_split(axis, record)
    pack, other = record.engaging, record.releasing
    words = f": the {pack} takes over from the {other}" if record.presses(other) else ""
    finish(axis, f"Torque of the {pack}" if record.alone else f"Torques{words}", "torque [N·m]")


def _draw_brake_capacity(axis: Axes, record: Record) -> None:
    """Draw what the brake could hold, on the side where it is needed."""
    held = record.series("transmission.brake_reaction")
    able = record.series("brake.torque_capacity")
    if held is None or able is None or not np.any(held):
        return
    side = -1.0 if -np.min(held) > np.max(held) else 1.0
    axis.plot(record.time, side * able, color=PURPLE, ls=":", label="brake could hold")


def _draw_split(axis: Axes, record: Record) -> None:
    """Draw what lining and oil each add to the torque of the engaging pack, where it is known."""
    pack = record.engaging
    for name, words, colour in (
        ("contact_torque", "in contact", ORANGE), ("viscous_torque", "in the oil", SKY),
    ):  # fmt: skip
        draw(axis, record, f"{pack}.{name}", f"{pack}'s friction {words}", colour, "-.", width=1.2)


def films(record: Record) -> list[tuple[str, str, Array]]:
    """Return words, colour and film ratio, as it is drawn, of every film."""
    lines = [(pack, pack, COLOURS[pack]) for pack in PACKS if record.presses(pack)]
    lines += [("washer", "thrust washer", ORANGE), ("mesh", "gear mesh", GREEN)]
    return [
        (words, colour, np.maximum(values, LOWEST_RATIO)) for part, words, colour in lines
        if (values := record.series(f"{part}.film_ratio")) is not None
    ]  # fmt: skip


def draw_films(axis: Axes, record: Record) -> None:
    """Draw the film ratios, if there are any, over regime bands, distress marked."""
    drawn = films(record)
    if not drawn:
        return
    for words, colour, shown in drawn:
        axis.plot(record.time, shown, color=colour, label=words, zorder=3)
    low = max(LOWEST_RATIO, 0.6 * min(float(np.min(shown)) for *_, shown in drawn))
    high = 1.6 * max(3.0, *(float(np.max(shown)) for *_, shown in drawn))
    _draw_regimes(axis, low, high)
    draw_phase_lines(axis, record)
    lost = distressed(record)
    if np.any(lost):
        axis.plot(record.time[lost], np.full(np.sum(lost), 0.82 * high), "|", color=BLACK, ms=7,
                  mew=1.2, label="washer's film lost (distress)", zorder=4)  # fmt: skip
    finish(axis, "Film ratios: does oil or do asperities carry?", f"film ratio h/{SIGMA} [1]")


def _draw_regimes(axis: Axes, low: float, high: float) -> None:
    """Draw the regime bands behind a logarithmic axis of film ratios."""
    for bottom, top, shade, words in (
        (3.0, high, "#EAF4FB", "full film"),
        (1.0, 3.0, "#FFF6E3", "mixed"),
        (low, 1.0, "#FBE9E1", "boundary"),
    ):
        if bottom < top:
            axis.axhspan(bottom, top, color=shade, lw=0, zorder=0)
            look: Any = {"va": "bottom", "fontsize": 8.5, "color": "#666666"}
            note_at_right(axis, words, bottom, place=0.995, shift=(0, 3), **look)
    for ratio in (1.0, 3.0):
        axis.axhline(ratio, color="#555555", lw=0.9, ls="--", zorder=1)
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    axis.set_yticks([v for v in (0.01, 0.1, 0.3, 1, 3, 10, 30, 100, 300) if low <= v <= high])
    axis.yaxis.set_major_formatter("{x:g}")
    axis.minorticks_off()


def draw(
    axis: Axes, record: Record, name: str, words: str, colour: str, dashes: str = "-",
    zero: float = 0.0, width: float | None = None,
) -> float:  # fmt: skip
    """Draw a signal if the run has it; return its largest value."""
    values = record.series(name)
    if values is None:
        return 0.0
    axis.plot(record.time, values - zero, color=colour, ls=dashes, lw=width, label=words)
    return float(np.nanmax(values - zero))


def draw_phases(axis: Axes, record: Record, words: bool = True, legend: bool = False) -> None:
    """Shade the phases and write their names; with ``legend`` narrow ones are named there."""
    first, last = float(record.time[0]), float(record.time[-1])
    axis.set_xlim(first, last)
    axis.margins(y=0.1)  # room for the names at the top
    for index, phase in enumerate(record.phases):
        shade = SHADES[index % len(SHADES)]
        wide = phase.end - phase.start > LETTER * len(phase.name) * (last - first)
        axis.axvspan(phase.start, phase.end, color=shade, lw=0, zorder=0,
                     label=phase.name if legend and not wide else None)  # fmt: skip
        if words and wide:
            axis.annotate(phase.name, (0.5 * (phase.start + phase.end), 0.985), ha="center",
                          va="top", xycoords=axis.get_xaxis_transform(), fontsize=8.5,
                          color="#666666")  # fmt: skip


def draw_events(axis: Axes, record: Record) -> None:
    """Draw the events as numbered lines; numbers of close neighbours stand above each other."""
    close = 0.025 * float(record.time[-1] - record.time[0])
    height, before = 0, -np.inf
    shown = record.events if len(record.events) <= MOST_EVENTS else record.events[:FIRST_EVENTS]
    for number, event in enumerate(shown, 1):
        height = height + 1 if event.time - before < close else 0
        before = event.time
        words = fill(f"{number}: {event.time:.4g} s {event.text}", 36, subsequent_indent="    ")
        axis.axvline(event.time, color="#444444", lw=0.8, ls=":", label=words)
        axis.annotate(str(number), (event.time, 0.0), (2, 3 + 9 * height),
                      textcoords="offset points", xycoords=axis.get_xaxis_transform(),
                      fontsize=8, color="#444444")  # fmt: skip
    if len(shown) < len(record.events):
        more = len(record.events) - len(shown)
        axis.plot([], [], lw=0.0, label=f"and {more} more events")


def draw_phase_lines(axis: Axes, record: Record) -> None:
    """Draw thin lines where a phase begins."""
    axis.set_xlim(float(record.time[0]), float(record.time[-1]))
    for phase in record.phases[1:]:
        axis.axvline(phase.start, color="#999999", lw=0.8, ls=":")


def finish(axis: Axes, title: str, up: str) -> None:
    """Set title and label of the axis, and the legend to the right, where it hides no line."""
    label(axis, title, "", up)
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
