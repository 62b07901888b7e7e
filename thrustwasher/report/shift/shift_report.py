"""The report of a shift: what was simulated, what came out, how far to trust it."""

from collections.abc import Sequence
from typing import Any

from markupsafe import Markup

from ...units import format_quantity as say
from ..html import Card, Page, Plot, Section
from ..scatter.study_page import chance_cards
from ..scatter.words import BAND, LOST, band_words, loose_words, varies
from . import shift_tables
from .how_sure import how_sure_sections, steady_is_doubted
from .live_washer import live_washer
from .overview_plot import overview_figure
from .section_texts import USUAL_TEXT, cost_texts, rung_texts, simulated_texts, temperature_texts
from .shift_data import page_data, run_data, slip_of
from .shift_record import Record
from .swing_texts import judder_text
from .trust import trust_texts
from .usual import beside, usual_table
from .worst_moments import Moment, highest, solve_moment, worst_film

SCRIPTS = (
    "vendor/uPlot.min.css",
    "vendor/uPlot.iife.min.js",
    "draw.css",
    "draw.js",
    "shift/shift.css",
    *(f"shift/{name}.js" for name in ("decode", "page_parts", "controls", "plots", "flow")),
    *(f"shift/{name}.js" for name in ("live", "discs", "slip", "start")),
)
OVERVIEW_CAPTION = (
    "Shaded: the phases of the shift; dotted and numbered: what happened when. Above a film ratio "
    "of 3 the oil carries, below 1 the asperities do."
)
ENERGY_TEXT = "Integrated by the driveline itself inside its steps."
FRICTION_TEXT = (
    "The mean is torque over time by load, mean radius and faces over time: under constant load "
    "the harmonic mean over speed, which a braking time measures."
)
HEAT_TEXT = (
    "Where the heat went: what is made is stored or given to the oil. What was stored is below "
    "zero where a part ends cooler than it began. The rest is what a part without account stores, "
    "and the error of adding up over steps."
)


def shift_page(record: Record) -> Page:
    """Return the whole report of a finished shift."""
    still = Plot("overview", overview_figure(record), OVERVIEW_CAPTION, bitmap=True, still=True)
    phases, cost = shift_tables.phase_table(record), shift_tables.cost_table(record)
    heat = [shift_tables.energy_table(record), shift_tables.heat_table(record)]
    parameters = [shift_tables.parameter_table(part) for part in record.parts]
    texts, simulated = temperature_texts(record), simulated_texts(record)
    usual, washer = usual_table(record), shift_tables.washer_table(record)
    ranges = Section("usual", "Beside what is usual", texts=[USUAL_TEXT], tables=[usual])
    sections = [
        *([ranges] if usual.rows else []),
        Section("course", "The shift over time", ["plots"], texts, [still], [phases]),
        *_friction_sections(record),
        *_judder_sections(record),
        *([Section("washer", "The thrust washer", ["discs"], tables=[washer])] if washer else []),
        Section("energy", "Energy", ["flow"], [ENERGY_TEXT, HEAT_TEXT], tables=heat),
        *how_sure_sections(record),
        Section("key-figures", "Key figures", tables=[shift_tables.key_table(record)]),
        *rung_sections(record),
        Section("cost", "Time spent", texts=cost_texts(record), tables=[cost]),
        Section("parameters", "What was simulated", texts=simulated, tables=parameters),
        Section("trust", "How far to trust it", texts=trust_texts(record)),
    ]
    run = run_data(record, _moments(record))
    return page_of(record, run, sections, live_washer(record), _cards(record))


def page_of(
    record: Record,
    run: dict[str, Any],
    sections: Sequence[Section],
    washer: Any,
    cards: Sequence[Card] = (),
) -> Page:
    """Return the page of a run; ``washer``: what solves it at the cursor's time, or None."""
    return Page(
        title=record.title,
        subtitle=f"Scene {record.name}, {record.time[-1] - record.time[0]:.4g} s simulated in "
        f"{say(record.wall_time, 's', digits=3)}, {len(record.parts)} FMUs, made by thrustwasher",
        summary=run["summary"],
        warnings=run["warnings"],
        cards=cards,
        sections=sections,
        footer="One file, readable offline. The same numbers: shift.csv beside this page, and "
        "thrustwasher shift --json.",
        scripts=SCRIPTS,
        data={**page_data([run]), "washer": washer},
    )


TITLES = {
    "physical": "Judder",
    "decaying": "A swing of the shaft that decays",
    "numerical": "A swing of the shaft made by the communication step",
    "unexplained": "A swing of the shaft",
}


CARDS = (
    *("lock_after_ramp_start", "lock_after_half_ramp", "lock_speed", "stopped_inertia"),
    *("slip_energy", "slip_energy_per_area", "{pack}_heat_flux", "peak_jerk", "friction_mean"),
    *("friction_lock", "{pack}_temperature", "peak_washer_temperature_max"),
    *("least_washer_film_ratio", "peak_flash_temperature"),
)
OF_A_LONE_PACK = ("lock_after_half_ramp", "stopped_inertia", "friction_mean", "friction_lock")


def _cards(record: Record) -> list[Card]:
    """Return the figures at the top; braking time and friction where a pack acts alone."""
    hidden = ("lock_after_ramp_start",) if record.alone else OF_A_LONE_PACK
    names = [n.format(pack=f"peak_{record.engaging}") for n in CARDS if n not in hidden]
    usual = beside(record)

    def band(name: str) -> list[str]:
        found = record.band(name)
        if not found or not varies(found):
            return []
        words = usual[name][0].study_words(found) if name in usual else band_words(found)
        doubt = "washer_temperature" in name and steady_is_doubted(record)
        return [
            f"{BAND}: {words}".replace(" ", "\N{NO-BREAK SPACE}"),
            *loose_words(found),
            *(["steady, which the check in time doubts"] if doubt else []),
        ]

    cards = [
        Card(
            f.text,
            usual[name][0].value_words(f.value) if name in usual else f.words(f.value, 4),
            Markup("<br>").join(
                [*([usual[name][0].note(f.value)] if name in usual else []), *band(name)]
            ),
        )
        for name in names
        if (f := record.figure(name)) is not None and f.value is not None
    ]
    cards += chance_cards(record.scatter, [LOST]) if record.scatter else []
    share = f"{record.energy['residual_share']:.1e}"
    cards.append(Card(f"energy missing, of {record.whole_name}", share))
    if record.step_error is not None:
        errs = f"{100.0 * record.step_error.relative:.2g} %"
        cards.append(Card("error of the step, in lock-up time or heat", errs))
    return cards


def _friction_sections(record: Record) -> list[Section]:
    """Return friction over slip where it changes, and what the scene's source says beside it."""
    title, widgets = f"Friction of the {record.engaging}", ["slip"] if slip_of(record) else []
    if not record.published:
        return [Section("friction", title, widgets, [FRICTION_TEXT])] if widgets else []
    texts = [f"Published: {record.source}.", FRICTION_TEXT]
    table = shift_tables.published_table(record)
    title += ", published and computed"
    return [Section("friction", title, widgets, texts, tables=[table])]


def _judder_sections(record: Record) -> list[Section]:
    """Return how the output shaft swings while a pack slips, and why."""
    if record.judder is None:
        return []
    texts, tables = [judder_text(record)], [shift_tables.judder_table(record)]
    return [Section("judder", TITLES[record.judder.kind], texts=texts, tables=tables)]


def rung_sections(record: Record) -> list[Section]:
    """Return which rungs ran and why, how far off they were and what was run again."""
    if record.selection is None:
        return []
    texts = [*record.selection.words(), *rung_texts(record)]
    if record.guard is None:
        return [Section("rungs", "Rungs", texts=texts)]
    tables = [shift_tables.check_table(record)]
    return [Section("rungs", "Rungs and their check", texts=texts, tables=tables)]


def _moments(record: Record) -> dict[str, Moment | None]:
    """Return the washer solved again at its worst and at its hottest moment."""
    found = {
        "worst moment, least film ratio while turning": worst_film(record),
        "hottest moment": highest(record, "washer.temperature_max"),
    }
    return {words: solve_moment(record, one.time) for words, one in found.items() if one}
