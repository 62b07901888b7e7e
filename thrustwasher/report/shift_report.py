"""The report of a shift: what was simulated, what came out, how far to trust it."""

from __future__ import annotations

from ..units import format_quantity as say
from . import summary, tables
from .extremes import highest, worst_film
from .html import Card, Page, Plot, Section
from .shift_plots import (
    energy_figure,
    film_figure,
    speed_figure,
    temperature_figure,
    torque_figure,
    washer_figure,
)
from .shift_record import Record
from .washer_moment import Moment, solve_moment
from .washer_plots import field_figure

SHORT = 0.25  # a shift that takes less of the run than this is drawn enlarged as well


def shift_page(record: Record, made_by: str = "thrustwasher") -> Page:
    """Return the whole report of a finished shift."""
    sections = [
        *_course_sections(record),
        Section(anchor="temperatures", title="Temperatures", plots=[Plot(
            file="temperatures", figure=temperature_figure(record),
            caption="The brake stays cool: it only lets go."
            + (" Washer temperatures are quasi-steady, an upper bound during a shift."
               if record.part("washer") else ""),
        )]),
        *_film_sections(record),
        *_washer_sections(record),
        Section(anchor="energy", title="Energy", tables=[tables.energy_table(record)], plots=[Plot(
            file="energy", figure=energy_figure(record),
            caption="Integrated by the driveline itself inside its steps.",
        )]),
        Section(anchor="key-figures", title="Key figures", tables=[tables.key_table(record)]),
        _cost_section(record),
        Section(
            anchor="parameters", title="What was simulated",
            texts=[record.help, f"Communication step {say(record.step, 's')}, master "
                   f"{record.master}. All values in SI units."],
            tables=tables.parameter_tables(record),
        ),
        Section(anchor="trust", title="How far to trust it", texts=_trust(record)),
    ]  # fmt: skip
    return Page(
        title=record.title,
        subtitle=f"Scene {record.name}, {record.time[-1]:.4g} s simulated in "
        f"{say(record.wall_time, 's', digits=3)}, {len(record.parts)} FMUs, made by {made_by}",
        summary=summary.sentences(record),
        warnings=summary.warnings(record),
        cards=_cards(record),
        sections=sections,
        footer="One file, readable offline. The same numbers: shift.csv beside this page, and "
        "thrustwasher shift --json.",
    )


def _course_sections(record: Record) -> list[Section]:
    """Return speeds and torques; a shift that is short within the run also enlarged."""
    speeds = [Plot(
        file="speeds", figure=speed_figure(record),
        caption="Shaded: the phases of the shift. Dotted and numbered: what happened when.",
    )]  # fmt: skip
    torques = [Plot(
        file="torques", figure=torque_figure(record),
        caption="A pack that is stuck transmits what the balance needs, which is less than it "
        "could hold.",
    )]  # fmt: skip
    lock, first, last = record.figures["lock_time"], record.time[0], record.time[-1]
    if lock is not None and lock - record.ramp_start < SHORT * (last - first):
        taken = lock - record.ramp_start
        part = record.window(record.ramp_start - 0.3 * taken, lock + 0.6 * taken)
        caption = "The shift itself, enlarged."
        speeds.append(Plot(file="speeds_enlarged", figure=speed_figure(part), caption=caption))
        torques.append(Plot(file="torques_enlarged", figure=torque_figure(part), caption=caption))
    return [
        Section(anchor="speeds", title="Speeds", plots=speeds),
        Section(anchor="torques", title="Torques", plots=torques),
    ]


def _cards(record: Record) -> list[Card]:
    """Return the figures at the top."""
    figures = record.figures
    cards = []
    if figures["lock_time"] is not None:
        cards.append(Card(name="clutch locked", value=f"{figures['lock_time']:.4g} s"))
    for name, number, unit in (
        ("engine speed there", figures["lock_speed"], "rad/s"),
        ("heat in the clutch", figures["slip_energy"], "J"),
        ("greatest clutch power", figures["peak_power"], "W"),
        ("clutch interface at most", figures["peak_clutch_temperature"], "K"),
        ("washer's hottest spot", figures.get("peak_washer_temperature_max"), "K"),
        ("washer's least film ratio while turning", figures.get("least_washer_film_ratio"), "1"),
    ):
        if number is not None:
            cards.append(Card(name=name, value=say(number, unit, digits=3)))
    share = f"{record.energy['residual_share']:.1e}"
    return [*cards, Card(name="energy missing, of engine work", value=share)]


def _film_sections(record: Record) -> list[Section]:
    """Return the film ratios, if any film was computed."""
    figure = film_figure(record)
    if figure is None:
        return []
    caption = (
        "Film thickness over the combined roughness. Above 3 the oil carries, below 1 the "
        "asperities do. Values below the axis are drawn on its lower end."
    )
    plot = Plot(file="film_ratios", figure=figure, caption=caption)
    return [Section(anchor="films", title="Film ratios", plots=[plot])]


def _washer_sections(record: Record) -> list[Section]:
    """Return the washer's load and its fields at the worst and at the hottest moment."""
    figure = washer_figure(record)
    if figure is None:
        return []
    plots = [Plot(file="washer_load", figure=figure,
                  caption="The helical planets' tilting couple presses the washers; where the "
                  "red area begins, asperities touch.")]  # fmt: skip
    for stem, words, extreme in (
        ("washer_worst", "Worst moment: least film ratio while turning", worst_film(record)),
        ("washer_hottest", "Hottest moment", highest(record, "washer.temperature_max")),
    ):
        moment = None if extreme is None else solve_moment(record, extreme.time)
        if moment is not None:
            plots.append(_moment_plot(stem, words, moment))
    return [Section(anchor="washer", title="The thrust washer", plots=plots)]


def _moment_plot(stem: str, words: str, moment: Moment) -> Plot:
    """Return the fields at one moment; the caption says they were solved again."""
    heading = f"{words}, t = {moment.time:.4g} s"
    caption = (
        f"{words}. Solved again at the inputs recorded at {moment.time:.4g} s: film ratio "
        f"{moment.result.film_ratio:.4g}, in the run it was {moment.recorded_film_ratio:.4g}."
    )
    figure = field_figure(moment.result, moment.point, heading)
    return Plot(file=stem, figure=figure, caption=caption, square=True, bitmap=True)


def _cost_section(record: Record) -> Section:
    """Return what the run took."""
    span = float(record.time[-1] - record.time[0])
    words = (
        f"{say(record.wall_time, 's', digits=3)} for {say(span, 's')} of shift, "
        f"{span / record.wall_time:.2g} simulated seconds a second, without building and "
        "loading the FMUs. Python FMUs through FMPy; the time of a step includes setting inputs "
        "and reading outputs."
    )
    return Section(
        anchor="cost", title="Time spent", texts=[words], tables=[tables.cost_table(record)]
    )


def _trust(record: Record) -> list[str]:
    """Return what the numbers are worth."""
    book = record.energy
    texts = [
        f"Energy: the book closes to {book['residual_share']:.1e} of the engine's work. This is "
        "the error of the integration inside the driveline.",
        f"Coupling: the clutch FMU counts {book['coupling_difference_share']:.3%} more or less "
        "heat than the driveline. Both are right about their own step; the difference is the "
        f"error of exchanging values only every {say(record.step, 's')} and shrinks with it.",
    ]
    if record.part("washer") is not None:
        texts += _washer_trust(record)
    texts.append(
        "Clutch and brake: the oil film between the plates is always settled in this version. "
        "Squeezing it out takes time and would delay the torque by roughly 0.05 to 0.2 s."
    )
    texts += tables.source_texts(record)
    return [*texts, *(f"The run says: {message}." for message in record.messages)]


def _washer_trust(record: Record) -> list[str]:
    """Return what the washer's numbers are worth."""
    from ..models.washer_params import SPEC

    part = record.part("washer")
    given = part.parameters if part else {}
    rung = str(given.get("fidelity", SPEC.default_fidelity))
    promise = SPEC.fidelities.get(rung, "")
    return [
        f"Washer, fidelity {rung}: {promise}. The washer is quasi-steady, every step is a "
        "steady state. Real steel needs 0.1 s (washer) to 6 s (carrier) to warm up, so that its "
        "temperatures during a shift are an upper bound, and its film is rather thicker in truth.",
        "Washer's size: the published 45 mm washer does not fit a planet of a car-sized set; a "
        "scene that wants it to fit uses half the size. What is used stands in the parameters.",
    ]
