"""The report of a shift: what was simulated, what came out, how far to trust it."""

from typing import Any

from matplotlib.figure import Figure

from ...units import format_quantity as say
from ..html import Card, Page, Plot, Section
from ..model_plots.washer_plots import field_figure
from ..panels import shift_plots
from . import shift_tables, summary
from .shift_record import Record
from .summary import paragraphs
from .usual import beside, usual_table
from .worst_moments import Moment, highest, solve_moment, worst_film

SHORT = 0.25  # a shift that takes less of the run than this is drawn enlarged as well


def shift_page(record: Record) -> Page:
    """Return the whole report of a finished shift."""
    sections = [
        *_usual_sections(record),
        *_course_sections(record),
        *_drawn("comfort", "What passengers feel", shift_plots.comfort_figure(record),
                COMFORT_CAPTION),
        *_drawn("actuation", "What presses the packs", shift_plots.actuation_figure(record),
                ACTUATION_CAPTION),
        *_drawn("temperatures", "Temperatures", shift_plots.temperature_figure(record),
                *paragraphs("temperatures", record)),
        *_drawn("films", "Film ratios", shift_plots.film_figure(record), FILM_CAPTION,
                "film_ratios"),
        *_friction_sections(record),
        *_judder_sections(record),
        *_washer_sections(record),
        *_drawn("stress", "The gear teeth", shift_plots.stress_figure(record),
                SAFETY_CAPTION if record.rated_teeth else STRESS_CAPTION, "tooth_stress"),
        *_drawn("energy", "Energy", shift_plots.energy_figure(record), ENERGY_CAPTION,
                tables=[shift_tables.energy_table(record)]),
        *_drawn("heat", "Where the heat went", shift_plots.heat_figure(record), HEAT_CAPTION,
                tables=[shift_tables.heat_table(record)]),
        Section("key-figures", "Key figures", tables=[shift_tables.key_table(record)]),
        *rung_sections(record),
        Section("cost", "Time spent", texts=paragraphs("cost", record),
                tables=[shift_tables.cost_table(record)]),
        Section(
            "parameters", "What was simulated",
            texts=paragraphs("simulated", record),
            tables=shift_tables.parameter_tables(record),
        ),
        Section("trust", "How far to trust it", texts=summary.trust_texts(record)),
    ]  # fmt: skip
    return Page(
        title=record.title,
        subtitle=f"Scene {record.name}, {record.time[-1] - record.time[0]:.4g} s simulated in "
        f"{say(record.wall_time, 's', digits=3)}, {len(record.parts)} FMUs, made by thrustwasher",
        summary=summary.sentences(record),
        warnings=summary.warnings(record),
        cards=_cards(record),
        sections=sections,
        footer="One file, readable offline. The same numbers: shift.csv beside this page, and "
        "thrustwasher shift --json.",
    )


SPEED_CAPTION = "Shaded: the phases of the shift. Dotted and numbered: what happened when."
TORQUE_CAPTION = (
    "A pack that is stuck transmits what the balance needs, which is less than it could hold."
)
ENERGY_CAPTION = "Integrated by the driveline itself inside its steps."
FRICTION_CAPTION = (
    "The mean is torque over time by load, mean radius and faces over time: under constant load "
    "the harmonic mean over speed, which a braking time measures."
)
LOAD_CAPTION = (
    "The helical planets' tilting couple presses the washers; where the red area begins, "
    "asperities touch."
)
FILM_CAPTION = (
    "Film thickness over the combined roughness. Above 3 the oil carries, below 1 the "
    "asperities do. Values below the axis are drawn on its lower end."
)
STRESS_CAPTION = (
    "Contact stress and thermal stress together, each over what the steel endures; at 1 its "
    "endurance limit is reached."
)
SAFETY_CAPTION = (
    "While the teeth turn. At 1 the limit of the calculation is reached. How much film keeps off "
    "micropitting is the user's to give: permissible_film_ratio."
)
COMFORT_CAPTION = "Positive: the vehicle speeds up. Every step of acceleration is felt as jerk."
ACTUATION_CAPTION = "A piston presses above its spring. Slip is the difference of a pack's lines."
HEAT_CAPTION = (
    "Both areas together reach the dashed line if no joule is lost. What was stored is below zero "
    "where a part ends cooler than it began. The rest is what a part without account stores, and "
    "the error of adding up over steps."
)
TITLES = {
    "physical": "Judder",
    "decaying": "A swing of the shaft that decays",
    "numerical": "A swing of the shaft made by the communication step",
    "unexplained": "A swing of the shaft",
}


def _drawn(
    anchor: str, title: str, figure: Figure | None, caption: str, file: str = "", **more: Any
) -> list[Section]:
    """Return a section of one figure, if there is something to draw."""
    if figure is None:
        return []
    return [Section(anchor, title, plots=[Plot(file or anchor, figure, caption)], **more)]


def _course_sections(record: Record) -> list[Section]:
    """Return speeds and torques; a shift that is short within the run also enlarged."""
    speeds = [Plot("speeds", shift_plots.speed_figure(record), SPEED_CAPTION)]
    torques = [Plot("torques", shift_plots.torque_figure(record), TORQUE_CAPTION)]
    lock, first, last = record.figures["lock_time"], record.time[0], record.time[-1]
    if lock is not None and lock - record.ramp_start < SHORT * (last - first):
        taken = lock - record.ramp_start
        part = record.window(record.ramp_start - 0.3 * taken, lock + 0.6 * taken)
        caption = "The shift itself, enlarged."
        speeds.append(Plot("speeds_enlarged", shift_plots.speed_figure(part), caption))
        torques.append(Plot("torques_enlarged", shift_plots.torque_figure(part), caption))
    phases = shift_tables.phase_table(record)
    return [
        Section("speeds", "Speeds", plots=speeds, tables=[phases]),
        Section("torques", "Torques", plots=torques),
    ]


def _usual_sections(record: Record) -> list[Section]:
    """Return the figures with a range beside them."""
    table = usual_table(record)
    if not table.rows:
        return []
    title = "Beside what is usual"
    return [Section("usual", title, texts=paragraphs("usual", record), tables=[table])]


CARDS = (
    "lock_after_ramp_start", "lock_after_half_ramp", "lock_speed", "stopped_inertia", "slip_energy",
    "slip_energy_per_area", "{pack}_heat_flux", "peak_jerk", "friction_mean", "friction_lock",
    "{pack}_temperature", "peak_washer_temperature_max", "least_washer_film_ratio",
    "peak_flash_temperature",
)  # fmt: skip
OF_A_LONE_PACK = ("lock_after_half_ramp", "stopped_inertia", "friction_mean", "friction_lock")


def _cards(record: Record) -> list[Card]:
    """Return the figures at the top; braking time and friction where a pack acts alone."""
    hidden = ("lock_after_ramp_start",) if record.alone else OF_A_LONE_PACK
    names = [n.format(pack=f"peak_{record.engaging}") for n in CARDS if n not in hidden]
    known = {figure.name: figure for figure in record.key_figures}
    usual = beside(record)
    cards = [
        Card(f.text, usual[name][0].value_words(f.value), usual[name][0].note(f.value))
        if name in usual else
        Card(f.text, f"{f.value:.4g} s" if f.unit == "s"
             else say(f.value, f.unit, digits=4, difference=f.difference))
        for name in names if (f := known.get(name)) is not None and f.value is not None
    ]  # fmt: skip
    share = f"{record.energy['residual_share']:.1e}"
    return [*cards, Card(f"energy missing, of {record.whole_name}", share)]


def _friction_sections(record: Record) -> list[Section]:
    """Return friction against slip, and what the scene's source says beside this run."""
    figure, title = shift_plots.friction_figure(record), f"Friction of the {record.engaging}"
    if not record.published:
        return _drawn("friction", title, figure, FRICTION_CAPTION)
    return [Section(
        "friction", f"{title}, published and computed", texts=[f"Published: {record.source}."],
        plots=[] if figure is None else [Plot("friction", figure, FRICTION_CAPTION)],
        tables=[shift_tables.published_table(record)],
    )]  # fmt: skip


def _judder_sections(record: Record) -> list[Section]:
    """Return how the output shaft swings while a pack slips, and why."""
    if record.judder is None:
        return []
    caption = "Between the dashed lines the swing was small enough to judge its growth."
    return _drawn(
        "judder", TITLES[record.judder.kind], shift_plots.judder_figure(record), caption,
        texts=paragraphs("judder", record), tables=[shift_tables.judder_table(record)],
    )  # fmt: skip


def rung_sections(record: Record) -> list[Section]:
    """Return which rungs ran and why, how far off they were and what was run again."""
    if record.selection is None:
        return []
    texts = [*record.selection.words(), *paragraphs("rungs", record)]
    if record.guard is None:
        return [Section("rungs", "Rungs", texts=texts)]
    tables = [shift_tables.check_table(record)]
    return [Section("rungs", "Rungs and their check", texts=texts, tables=tables)]


def _washer_sections(record: Record) -> list[Section]:
    """Return the washer's load and its fields at the worst and at the hottest moment."""
    figure = shift_plots.washer_figure(record)
    if figure is None:
        return []
    plots = [Plot("washer_load", figure, LOAD_CAPTION)]
    for stem, words, extreme in (
        ("washer_worst", "Worst moment: least film ratio while turning", worst_film(record)),
        ("washer_hottest", "Hottest moment", highest(record, "washer.temperature_max")),
    ):
        moment = None if extreme is None else solve_moment(record, extreme.time)
        if moment is not None:
            plots.append(_moment_plot(stem, words, moment))
    table = shift_tables.washer_table(record)
    return [Section("washer", "The thrust washer", plots=plots, tables=[table] if table else [])]


def _moment_plot(stem: str, words: str, moment: Moment) -> Plot:
    """Return the fields at one moment; the caption says they were solved again."""
    heading = f"{words.partition(':')[0]}, t = {moment.time:.4g} s"
    caption = (
        f"{words}. Solved again at the inputs recorded at {moment.time:.4g} s: film ratio "
        f"{moment.result.film_ratio:.4g}, in the run it was {moment.recorded_film_ratio:.4g}."
    )
    figure = field_figure(moment.result, moment.point, words=heading)
    return Plot(stem, figure, caption, square=True, bitmap=True)
