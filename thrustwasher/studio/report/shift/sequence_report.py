"""The report of several shifts in one run: a row per shift, all signals over the whole time."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from matplotlib.figure import Figure

from ....shift.account import summary
from ....shift.account.shift_record import Event, KeyFigure, Phase, Record, record_of
from ....units import format_quantity as say
from ..html import Page, Plot, Section, Table
from .live_washer import live_washer
from .overview_plot import overview_figure
from .shift_data import run_data
from .shift_report import ENERGY_TEXT, page_of

ROOM = 1_300_000  # characters of packed signals: this page has less next to them
CAPTION = "Temperatures, speeds and torques over all shifts."
STILL = ("Temperatures", "Speeds", "Torques")


def sequence_page(result: Any) -> Page:
    """Return the page of a ``SequenceResult``."""
    records = [record_of(shift) for shift in result.shifts]
    whole, oil = _whole(result, records), result.oil_temperature
    sentence = (
        f"{len(records)} shifts, oil from {say(oil[0], 'K', digits=3)} to "
        f"{say(oil[-1], 'K', digits=3)}."
    )
    warnings = list(result.warnings)
    run = run_data(whole, {}, room=ROOM, texts=([sentence], warnings))
    run |= {"slip": None, "shifts": len(records)}
    still = Plot("sequence", sequence_figure(result), CAPTION, bitmap=True, still=True)
    washer = live_washer(whole)
    texts = [f"{words}." for words in summary.step_words(result)]
    texts += [f"The run says: {message}." for message in result.messages]
    sections = [
        Section("profile", "The shifts over time", ["plots"], [], [still], [_table(records)]),
        *([Section("washer", "The thrust washer", ["discs"])] if washer else []),
        Section("energy", "Energy", ["flow"], [ENERGY_TEXT]),
        *([Section("trust", "How far to trust it", texts=texts)] if texts else []),
    ]
    return page_of(whole, run, sections, washer)


def sequence_figure(result: Any, *, panels: str | Sequence[str] = STILL) -> Figure:
    """Return the picture of a ``SequenceResult``: its signals over the whole time.

    ``panels``: their titles.
    """
    records = [record_of(shift) for shift in result.shifts]
    return overview_figure(_whole(result, records), panels)


def _whole(result: Any, records: Sequence[Record]) -> Record:
    """Return the run as a record; its phases are the shifts, its events their locks."""
    shifts = result.scene.sequence.shifts
    named = [
        (f"{i} {way}", record)
        for i, ((_, way), record) in enumerate(zip(shifts, records, strict=True), 1)
    ]
    locks = [(name, record.figures.get("lock_time")) for name, record in named]
    return replace(
        record_of(result.shifts[0]),
        time=result.time,
        signals=result.signals,
        judder=None,
        phases=[Phase(name, float(r.time[0]), float(r.time[-1])) for name, r in named],
        events=[Event(time, f"{name} locks") for name, time in locks if time is not None],
        key_figures=[],
        published=[],
        messages=result.messages,
        wall_time=result.wall_time,
    )


def _head(records: Sequence[Record], row: Sequence[KeyFigure | None]) -> str:
    """Return the words of a figure; where they name the pack that engages, they name none."""
    known = [(r.engaging, f.text) for r, f in zip(records, row, strict=True) if f]
    first = known[0][1]
    same = all(text == first for _, text in known)
    return first if same else first.replace(known[0][0], "engaging pack")


def _table(records: Sequence[Record]) -> Table:
    """Return key figures, a row for each shift."""
    names = (
        *("lock_after_ramp_start", "slip_energy", "peak_clutch_temperature"),
        *("peak_brake_temperature", "peak_jerk", "minimum_washer_film_ratio"),
    )
    columns: dict[str, Callable[[Any], str]] = {
        "shift": lambda k: f"{k + 1} {'up' if records[k].engaging == 'clutch' else 'down'}",
        "begins": lambda k: f"{records[k].ramp_start:.5g} s",
    }
    for name in names:
        row = [record.figure(name) for record in records]
        if any(row):
            columns[_head(records, row)] = partial(_cell, row)
    return Table.of(range(len(records)), columns)


def _cell(row: Sequence[KeyFigure | None], k: int) -> str:
    if (f := row[k]) is None or f.value is None:
        return ""
    return say(f.value, f.unit, digits=4, difference=f.difference)
