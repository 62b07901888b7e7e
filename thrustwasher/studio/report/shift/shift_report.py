"""The report of a shift: what was simulated, what came out, how far to trust it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from markupsafe import Markup

from ....shift.account.shift_record import KeyFigure, Record
from ....shift.account.swing_texts import judder_text
from ....shift.account.what_happened import headline, sentences
from ....shift.account.worst_moments import Moment, highest, solve_moment, worst_film
from ....units import format_quantity as say
from ..html import Card, Page, Plot, Section, Table
from ..scatter.study_page import chance_cards
from ..scatter.words import BAND, LOST, band_words, loose_words, varies
from . import shift_tables
from .how_sure import how_sure_sections, steady_is_doubted
from .live_washer import live_washer
from .overview_plot import overview_figure
from .section_texts import USUAL_TEXT, cost_texts, level_texts, simulated_texts, temperature_texts
from .shift_data import page_data, run_data, slip_of
from .trust import trust_texts
from .usual import beside, usual_table

SCRIPTS = ("shift.css", "shift.js")
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


def shift_page(record: Record, live: str = "") -> Page:
    """Return the whole report of a finished shift; ``live``: the file in which it runs again."""
    still = Plot("overview", overview_figure(record), OVERVIEW_CAPTION, bitmap=True, still=True)
    phases = _below(shift_tables.phase_table(record), "The phases in numbers")
    cost = shift_tables.cost_table(record)
    heat = [
        _below(shift_tables.energy_table(record), "Energy balance"),
        _below(shift_tables.heat_table(record), "Where the heat went"),
    ]
    parameters = [shift_tables.parameter_table(part) for part in record.parts]
    texts, simulated = temperature_texts(record), simulated_texts(record)
    usual, washer = usual_table(record), shift_tables.washer_table(record)
    ranges = Section(
        "usual", "Compared with what is usual", texts=[USUAL_TEXT], tables=[usual], folded=True
    )
    sections = [
        Section("profile", "More over time", ["plots"], texts, tables=[phases]),
        *_friction_sections(record),
        *_judder_sections(record),
        *(
            [
                Section(
                    "washer", "The thrust washer", ["discs"], tables=[_below(washer, WASHER_TITLE)]
                )
            ]
            if washer
            else []
        ),
        Section("energy", "Energy", ["flow"], [ENERGY_TEXT, HEAT_TEXT], tables=heat),
        Section("said", "What happened, in words", texts=sentences(record), folded=True),
        *([ranges] if usual.rows else []),
        Section(
            "key-figures",
            "Key figures",
            ["copy-figures"],
            tables=[shift_tables.key_table(record)],
            folded=True,
            printed=True,
        ),
        *(replace(section, folded=True) for section in how_sure_sections(record)),
        *(replace(section, folded=True) for section in level_sections(record)),
        Section("cost", "Time spent", texts=cost_texts(record), tables=[cost], folded=True),
        Section(
            "parameters", "What was simulated", texts=simulated, tables=parameters, folded=True
        ),
        Section("trust", "How far to trust it", texts=trust_texts(record), folded=True),
    ]
    first = Section("first", "Speeds and torques over time", ["hero"], plots=[still])
    run = run_data(record, _moments(record))
    return page_of(record, run, sections, live_washer(record), _cards(record), first, live)


def page_of(
    record: Record,
    run: dict[str, Any],
    sections: Sequence[Section],
    washer: object,
    cards: Sequence[Card] = (),
    first: Section | None = None,
    live: str = "",
) -> Page:
    """Return the page of a run; ``washer``: what solves it at the cursor's time, or None."""
    return Page(
        title=record.title,
        subtitle=f"Scene {record.name}, {record.time[-1] - record.time[0]:.4g} s simulated in "
        f"{say(record.wall_time, 's', digits=3)}, {len(record.parts)} FMUs, made by thrustwasher",
        summary=[headline(record)] if first else run["summary"],
        warnings=run["warnings"],
        cards=cards,
        first=first,
        live=live,
        sections=sections,
        footer="One file, readable offline. The same numbers: shift.csv next to this page, and "
        "thrustwasher shift --json.",
        scripts=SCRIPTS,
        data={**page_data([run]), "washer": washer},
    )


def _below(table: Table, title: str) -> Table:
    """Return a table folded below the plots that show the same."""
    return replace(table, title=title, folded=True, stays=True)


TITLES = {
    "physical": "Judder",
    "decaying": "A swing of the shaft that decays",
    "numerical": "A swing of the shaft made by the communication step",
    "unexplained": "A swing of the shaft",
}


CARDS = (
    *("lock_after_ramp_start", "lock_after_half_ramp", "slip_energy", "stopped_inertia"),
    *("peak_jerk", "{pack}_temperature", "friction_mean", "minimum_washer_film_ratio"),
    *("slip_energy_per_area", "friction_lock", "{pack}_heat_flux", "peak_flash_temperature"),
    *("peak_washer_temperature_max", "lock_speed"),
)
WASHER_TITLE = "One washer in numbers"
MOST_CARDS = 6
OF_A_LONE_PACK = ("lock_after_half_ramp", "stopped_inertia", "friction_mean", "friction_lock")


def _cards(record: Record) -> list[Card]:
    """Return six figures for the top; braking time and friction where a pack acts alone.

    Where a figure's band is known its median is shown, the nominal value next to it.
    """
    hidden = ("lock_after_ramp_start",) if record.alone else OF_A_LONE_PACK
    names = [n.format(pack=f"peak_{record.engaging}") for n in CARDS if n not in hidden]
    usual = beside(record)

    def words_of(f: KeyFigure, value: float, digits: int = 4) -> str:
        return usual[f.name][0].value_words(value) if f.name in usual else f.words(value, digits)

    def band(name: str) -> list[str]:
        found = record.band(name)
        if not found or not varies(found):
            return []
        words = usual[name][0].study_words(found) if name in usual else band_words(found)
        doubt = "washer_temperature" in name and steady_is_doubted(record)
        return [
            unbroken(f"{BAND}: {words}"),
            *loose_words(found),
            *(["steady, which the check in time doubts"] if doubt else []),
        ]

    def card(f: KeyFigure, nominal: float) -> Card:
        spread = record.spread(f.name)
        shown, notes = (spread[1] if spread else nominal), band(f.name)
        if f.name in usual:
            notes = [usual[f.name][0].note(shown), *notes]
        if spread:
            ends = [unbroken(words_of(f, x, 3)) for x in (spread[0], spread[2], nominal)]
            known = [] if record.band(f.name) else [f"{unbroken(BAND)}: {ends[0]} .. {ends[1]}"]
            notes += [*known, f"nominal values: {ends[2]}"]
        name = f"{f.text}, median" if spread else f.text
        own = "" if spread or f.name in usual else f.name  # whose nominal value a script writes
        return Card(name, words_of(f, shown, 3 if spread else 4), Markup("<br>").join(notes), own)

    found = [f for name in names if (f := record.figure(name)) is not None]
    cards = [card(f, f.value) for f in found if f.value is not None]
    chances = chance_cards(record.scatter, [LOST]) if record.scatter else []
    return [*cards[: MOST_CARDS - len(chances)], *chances]


def unbroken(words: str) -> str:
    """Return words that stay on one line, as a value and its unit."""
    return words.replace(" ", "\N{NO-BREAK SPACE}")


def _friction_sections(record: Record) -> list[Section]:
    """Return friction over slip where it changes, and the source's values for comparison."""
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


def level_sections(record: Record) -> list[Section]:
    """Return which levels ran and why, how far off they were and what was run again."""
    if record.selection is None:
        return []
    texts = [*record.selection.words(), *level_texts(record)]
    if record.guard is None:
        return [Section("levels", "Fidelity levels", texts=texts)]
    tables = [shift_tables.check_table(record)]
    return [Section("levels", "Fidelity levels and their check", texts=texts, tables=tables)]


def _moments(record: Record) -> dict[str, Moment | None]:
    """Return the washer solved again at its worst and at its hottest moment."""
    found = {
        "worst moment, minimum film ratio while turning": worst_film(record),
        "hottest moment": highest(record, "washer.temperature_max"),
    }
    return {words: solve_moment(record, one.time) for words, one in found.items() if one}
