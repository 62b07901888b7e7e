"""Panels of what happens in the contacts of a shift: oil films, friction, tooth stress."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..palette import BLACK, BLUE, COLOURS, GREEN, GREY, ORANGE, RED, RPM, SIGMA, SKY
from ..shift.shift_record import PACKS, Array, Record
from ..shift.worst_moments import FILM_SPEED, distressed
from ..style import decade_ticks, note_at_right
from .panel_base import draw, draw_phase_lines, draw_phases, finish, thin

LOWEST_RATIO = 0.01  # film ratios at or below this are drawn on this line
LOADED = 0.1  # of the greatest load: below it the load is only beginning
LEAST_LOAD = 1.0  # N
SAFETIES = (
    ("pitting_safety", "against pitting", BLUE), ("scuffing_safety", "against scuffing", RED),
)  # fmt: skip
NO_LIMIT = 1.0  # permissible film ratio of flanks without one: safety and ratio are the same
STEELS = (("aisi1020", "AISI 1020", BLUE), ("aisi4340", "AISI 4340", ORANGE))


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


def draw_washer_load(axis: Axes, record: Record) -> None:
    """Draw the load on one washer, split into what oil and asperities carry."""
    some, load = thin(record), record.signals["transmission.washer_load"]
    share = record.signals["washer.fluid_load_share"]
    axis.stackplot(
        record.time[some], (load * share)[some], (load * (1.0 - share))[some], colors=[SKY, RED],
        labels=["carried by the oil film", "carried by asperities"], lw=0, alpha=0.75,
    )  # fmt: skip
    axis.plot(record.time, load, color=BLACK, lw=1.2, label="load on one washer")
    draw_phase_lines(axis, record)
    axis.set_ylim(bottom=0.0)
    finish(axis, "Load on one thrust washer", "load [N]")


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


def slipping(record: Record) -> Array:
    """Return the indices of the points between ramp start and lock-up where the pack slips."""
    slip = record.series(f"{record.engaging}.speed")
    end = record.figures.get("lock_time") or float(record.time[-1])
    if slip is None:
        return np.array([], dtype=int)
    inside = (record.time >= record.ramp_start) & (record.time < end) & (slip != 0.0)
    return np.flatnonzero(inside)


def friction_changes(record: Record) -> bool:
    """Tell whether the pack that engages slips with a coefficient that is not constant."""
    friction, where = record.series(f"{record.engaging}.friction_coefficient"), slipping(record)
    return friction is not None and len(where) > 1 and bool(np.ptp(friction[where]) >= 1e-9)


def draw_friction(axis: Axes, record: Record) -> None:
    """Draw the coefficient over falling slip."""
    pack, where = record.engaging, slipping(record)
    friction = record.signals[f"{pack}.friction_coefficient"]
    rpm = np.abs(record.signals[f"{pack}.speed"][where]) * RPM
    axis.plot(rpm, friction[where], color=BLUE, label="faces in contact")
    whole = _with_oil(record, where)
    if whole is not None:
        load = record.signals[f"{pack}.load"][where]
        shown = np.where(load > LOADED * np.max(load), whole, np.nan)
        axis.plot(rpm, shown, color=ORANGE, ls="--", label="torque over load, oil's shear included")
    _draw_published(axis, record)
    axis.set_xlim(float(np.max(rpm)) * 1.02, 0.0)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("slip [rpm], falling")
    finish(axis, f"Friction of the {pack} as its slip falls", "friction coefficient [1]")


def _with_oil(record: Record, where: Array) -> Array | None:
    """Return torque over load, mean radius and faces; None if the oil adds nothing of its own."""
    pack = record.engaging
    part, torque = record.part(pack), record.series(f"{pack}.friction_torque")
    oil, load = record.series(f"{pack}.viscous_torque"), record.series(f"{pack}.load")
    if part is None or torque is None or oil is None or load is None or not np.any(oil[where]):
        return None
    params = part.params()
    able = np.maximum(load[where], LEAST_LOAD) * params.friction_radius * params.faces
    return np.asarray(np.abs(torque[where]) / able)


def _draw_published(axis: Axes, record: Record) -> None:
    """Draw the mean of this run and what the scene's source says."""
    mean = record.figures.get("friction_mean")
    if mean is not None:
        axis.axhline(mean, color=GREY, lw=1.0, label=f"mean of this run {mean:.4g}")
    for item in record.published:
        if item.name == "friction_mean":
            axis.axhline(item.published, color=BLACK, lw=1.0, ls=":",
                         label=f"published mean {item.published:.4g}")  # fmt: skip
        elif item.name == "friction_lock":
            axis.plot([0.0], [item.published], "o", color=BLACK, ms=6, clip_on=False,
                      label=f"published at lock-up {item.published:.4g}")  # fmt: skip
        elif item.name == "full_friction_speed":
            axis.axvline(item.published * RPM, color=BLACK, lw=1.0, ls="--",
                         label=f"published: full below {item.published * RPM:.0f} rpm")  # fmt: skip


def draw_stress(axis: Axes, record: Record) -> None:
    """Draw the utilisation of both steels; 1 is the endurance limit."""
    draw_phases(axis, record)
    for key, words, colour in STEELS:
        draw(axis, record, f"mesh.stress_utilization_{key}", words, colour)
    axis.axhline(1.0, color=BLACK, lw=0.9, ls=(0, (1, 3)), label="endurance limit")
    axis.set_ylim(bottom=0.0)
    title = "Tooth stress, mechanical and thermal together, over its endurance limit"
    finish(axis, title, "utilisation [1]")


def draw_safeties(axis: Axes, record: Record) -> None:
    """Draw the safeties of the teeth while they turn; 1 is the limit."""
    draw_phases(axis, record)
    for part, mesh, dashes in (("mesh", "", "-"), ("ring_mesh", ", ring mesh", "--")):
        speed = record.series(f"{part}.speed")
        own = record.part(part)
        given = own is not None and own.params().permissible_film_ratio != NO_LIMIT
        film = ("micropitting_safety", "against micropitting", GREEN) if given else (
            "film_ratio_gf", "film over Ra, no limit", GREY
        )  # fmt: skip
        for name, words, colour in (*SAFETIES, film):
            values = record.series(f"{part}.{name}")
            if values is not None and speed is not None:
                shown = np.where(np.abs(speed) >= FILM_SPEED, values, np.nan)
                axis.plot(record.time, shown, color=colour, ls=dashes, label=words + mesh)
    axis.axhline(1.0, color=BLACK, lw=0.9, ls=(0, (1, 3)), label="limit")
    axis.set_yscale("log")
    decade_ticks(axis)
    finish(axis, "Safeties of the gear teeth", "safety [1]")
