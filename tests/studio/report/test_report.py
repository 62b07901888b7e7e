"""The report says what its record says, in one page that needs nothing else."""

import base64
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
import shift_stand_in
from curves import traced

from thrustwasher import WasherParams, solve_washer
from thrustwasher.shift.account import summary
from thrustwasher.shift.account.shift_record import KeyFigure
from thrustwasher.shift.account.worst_moments import Moment
from thrustwasher.studio.report.html import render, save_plots
from thrustwasher.studio.report.model_plots.clutch_plot import clutch_figure
from thrustwasher.studio.report.model_plots.washer_plots import curve_figure, field_figure
from thrustwasher.studio.report.shift import overview_plot, shift_report, shift_tables
from thrustwasher.studio.report.shift.trust import trust_texts
from thrustwasher.studio.report.style import decade_ticks, new_figure

POINT = {"load": 300.0, "speed": 953.0, "tilt": 2e-3, "oil_temperature": 297.15}


@pytest.fixture
def record(monkeypatch):
    def solve(record, time):
        ratio = record.at("washer.film_ratio", time)
        return Moment(time, POINT, solve_washer(WasherParams(), **POINT), ratio)

    monkeypatch.setattr(shift_report, "solve_moment", solve)
    return shift_stand_in.record()


class _Reader(HTMLParser):
    """Collects what a browser would fetch, the identifiers, and whether tags are balanced."""

    VOID = frozenset({"meta", "img", "br", "link", "hr", "input"})

    def __init__(self):
        super().__init__()
        self.fetched, self.ids, self.open, self.text = [], [], [], []

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.fetched += [found[k] for k in ("src", "href", "xlink:href") if found.get(k)]
        self.ids += [found["id"]] if "id" in found else []
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def words_of(page):
    """Return what happened, in words."""
    return next(s for s in page.sections if s.anchor == "said").texts


def test_page_is_well_formed_and_fetches_nothing(record):
    reader = _Reader()
    reader.feed(render(shift_report.shift_page(record)))
    assert reader.open == []
    assert [a for a in reader.fetched if not a.startswith(("#", "data:"))] == []
    assert len(reader.ids) == len(set(reader.ids))
    assert {a[1:] for a in reader.fetched if a.startswith("#")} <= set(reader.ids)


def test_page_carries_its_chapters_and_the_numbers(record):
    page = shift_report.shift_page(record)
    text, titles = render(page), [section.title for section in page.sections]
    assert len(titles) == 10 and {"The thrust washer", "Energy", "How far to trust it"} <= set(
        titles
    )
    for words in (
        "1.75 s",
        "99 rad/s",
        "Thermo-viscous distress",
        "a remark of the run",
        "Jackson",
    ):
        assert words in text
    bare = shift_report.shift_page(shift_stand_in.record(washer=False))
    assert "The thrust washer" not in [section.title for section in bare.sections]
    assert "washer" not in " ".join(words_of(bare))


def test_one_sentence_and_six_figures_stand_at_the_top(record):
    page = shift_report.shift_page(record)
    (sentence,) = page.summary
    assert re.fullmatch(
        r"The clutch locked at .* s, the shift took .* s; slipping made .*\.", sentence
    )
    assert len(page.cards) == 6 and page.first.widgets == ["hero"]
    folded = [s.anchor for s in page.sections if s.folded]
    assert folded == ["said", "usual", "key-figures", "cost", "parameters", "trust"]


def test_a_washer_that_gap_2_cannot_hold_is_a_warning(record):
    held = shift_report.shift_page(record)
    assert "Gap 2" not in " ".join(held.warnings)
    table = next(s for s in held.sections if s.anchor == "washer").tables[0]
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["oil that leaves the film at its rims"][2] == "0.036 l/min"
    loose = {**record.signals, "washer.stick_margin": record.signals["washer.film_ratio"] / 9.0}
    said = shift_report.shift_page(replace(record, signals=loose)).warnings
    assert any(w.startswith("The gears cannot hold the washers: at ") for w in said)


def test_text_from_a_scene_cannot_become_markup(record):
    text = render(shift_report.shift_page(replace(record, title="<script>alert(1)</script>")))
    assert "alert(1)" in text and "<script>alert" not in text


def test_a_scene_with_a_mesh_shows_teeth_and_their_stress(record):
    page = shift_report.shift_page(shift_stand_in.record(washer=False, mesh=True))
    shown = {signal["name"] for signal in page.data["runs"][0]["moving"]}
    assert "mesh.stress_utilization_aisi1020" in shown
    assert "contact of the gear teeth reached 114 °C, the gears' bodies 24 °C" in words_of(page)[2]
    assert any("1.10 times what AISI 1020 endures." in words for words in page.warnings)
    assert render(page)


def test_what_a_source_says_stands_beside_the_run(record):
    names = ("name", "text", "unit", "difference", "published", "run")
    said = [
        dict(zip(names, row, strict=True))
        for row in (
            ("friction_mean", "mean friction", "1", False, 0.053, 0.06),
            ("lock_speed", "speed", "rad/s", False, 100.0, None),
        )
    ]
    told = replace(record, published=said, source="somebody's table 2")
    section = next(s for s in shift_report.shift_page(told).sections if s.anchor == "friction")
    assert section.texts[0] == "Published: somebody's table 2."
    assert section.tables[0].rows[0] == ("mean friction", "0.053", "0.06", "+13.21%")
    assert section.tables[0].rows[1][2:] == ("", "")


def test_a_shift_that_has_not_begun_is_said(record):
    words = summary.sentences(replace(record, ramp_start=9.0))[0]
    assert words.startswith("In first gear") and "ends before the shift begins" in words


def test_a_brake_alone_is_told_as_a_braking_test(record):
    energy = {**record.energy, "engine_work": 0.0}
    figures = [*record.key_figures, KeyFigure("stopped_inertia", "inertia", "kg.m2", 30.0)]
    figures += [KeyFigure("maximum_slip", "slip", "rad/s", 314.159)]
    lone = replace(record, engaging="brake", alone=True, energy=energy, key_figures=figures)
    words = summary.sentences(lone)[0]
    assert "brought 30 kg·m² from 314.2 rad/s (3000 rpm) to rest in 1.5 s, counted from" in words
    assert "the engine's work" not in render(shift_report.shift_page(lone))


def test_a_tie_up_is_said_with_its_heat_and_its_cause(record):
    assert not [words for words in summary.warnings(record) if "Tie-up" in words]
    found = [
        KeyFigure("tie_up_duration", "", "s", 0.12, 0.28),
        KeyFigure("tie_up_torque", "", "N.m", 262.0, 0.3),
        KeyFigure("tie_up_heat", "", "J", 735.0),
    ]
    tied = replace(record, key_figures=[*record.key_figures, *found])
    (words,) = [words for words in summary.warnings(tied) if "Tie-up" in words]
    assert "from 0.28 s on" in words and "for 120 ms" in words
    assert "330 N·m to 262 N·m" in words and "735 J" in words
    assert "shear" not in words
    oil = 0.9 * record.signals["clutch.torque_capacity"]
    record.signals["clutch.viscous_torque"] = oil
    record.signals["clutch.friction_torque"] = oil / 0.9
    (words,) = [words for words in summary.warnings(tied) if "Tie-up" in words]
    assert "90% of its torque at 0.28 s was shear of the oil, supplied at 24 °C" in words


def test_the_share_of_oil_shear_is_told_with_what_it_rests_on(record):
    assert "Shear of the oil" not in " ".join(trust_texts(record))
    figures = [*record.key_figures, KeyFigure("clutch_viscous_share", "", "1", 0.65)]
    parts = [p._replace(parameters={**p.parameters, "fidelity": "field"}) for p in record.parts]
    told = " ".join(trust_texts(replace(record, parts=parts, key_figures=figures)))
    assert "65% of the heat in the clutch" in told and "no measurement" in told


def test_what_decides_the_washers_load_is_told(record):
    """The share does, a guess next to a model of needles that leaves the washers nothing."""
    figures = [*record.key_figures, KeyFigure("peak_washer_load", "", "N", 49.6)]
    told = " ".join(trust_texts(replace(record, key_figures=figures)))
    assert "(thrust_share = 0.1), which decides here" in told and "leaves them none" in told


def test_every_plot_becomes_a_file(record, tmp_path):
    page = shift_report.shift_page(record)
    text = render(page)
    save_plots(page, tmp_path)
    paths = list(tmp_path.iterdir())
    assert len(paths) == sum(len(s.plots) for s in (page.first, *page.sections)) == 1
    for path in paths:
        if path.suffix == ".png":
            assert base64.b64encode(path.read_bytes()).decode("ascii") in text
        else:
            assert path.suffix == ".svg" and path.read_text("utf-8") in text
            ET.parse(path)


def test_three_sentences_tell_the_shift(record):
    profile, clutch, washer = summary.sentences(record)
    assert "0.25 s" in profile and "1.75 s" in profile and "945 rpm" in profile
    assert "47 kJ" in clutch and "49 kW" in clutch and "174 °C" in clutch
    assert "lost their oil film" in washer


def test_a_shift_that_does_not_lock_is_said(record):
    never = {"lock_time", "lock_speed"}
    figures = [f._replace(value=None) if f.name in never else f for f in record.key_figures]
    slipping = replace(record, key_figures=figures)
    assert "still slipping" in summary.sentences(slipping)[0]
    assert "did not lock" in summary.warnings(slipping)[0]
    assert render(shift_report.shift_page(slipping))


def test_warnings_of_several_shifts_are_said_once_and_none_is_lost(record):
    def told(load, speed):
        return (
            f"washer: load of {load} leaves the 20 N of its part file",
            f"washer: speed of {speed} leaves the 50 rad/s of its part file",
        )

    shifts = [replace(record, found=told(*x)) for x in (("30 N", "1 rad/s"), ("4 kN", "2 rad/s"))]
    texts = [summary.warnings(shift) for shift in shifts]
    said = [text for text in summary.warnings_of_all(texts) if "part file" in text]
    likewise = ". Likewise shifts 2."
    assert said == [f"Shift 1: {text}{likewise}" for text in told("30 N", "1 rad/s")]


def test_energy_table_adds_up(record):
    rows = shift_tables.energy_table(record).rows
    joule = {row[0]: float(row[1].replace("\u2009", "")) for row in rows}
    spent = [v for words, v in joule.items() if words.startswith(("work into", "heat", "residual"))]
    given = joule["work of the engine"] + joule["kinetic energy given up"]
    assert given == pytest.approx(sum(spent), abs=0.05)


def test_parameters_tell_scene_from_default(record):
    washer = shift_tables.parameter_table(record.part("washer"))
    origin = {row[0]: row[4] for row in washer.rows}
    assert (origin["inner_radius"], origin["roughness"]) == ("scene", "default")


def axes_of(figure):
    """Return the axes that hold data: colour bars left out."""
    return [a for a in figure.axes if a.get_label() != "<colorbar>"]


def test_every_axis_carries_its_unit(record):
    figures = [
        overview_plot.overview_figure(record),
        curve_figure(traced(), POINT),
        field_figure(solve_washer(WasherParams(), **POINT), POINT),
    ]
    for figure in figures:
        for axis in axes_of(figure):
            assert re.search(r"\[.+\]", axis.get_ylabel()), axis.get_title()
            assert axis.get_title(loc="left"), "a title says what is seen"
        assert re.search(r"\[.+\]", axes_of(figure)[-1].get_xlabel())


def test_film_ratios_below_zero_are_drawn_not_dropped(record):
    record.signals["washer.film_ratio"][1:] = -0.5
    axis = axes_of(overview_plot.overview_figure(record))[2]
    drawn = [line for line in axis.lines if line.get_label() == "washer film ratio"]
    assert np.all(drawn[0].get_ydata()[1:] == 0.01) and axis.get_ylim()[0] <= 0.01


@pytest.mark.parametrize(("low", "high"), [(0.6, 12.0), (0.018, 0.4), (0.09, 110.0), (1.5, 4.5)])
def test_ticks_of_a_logarithmic_axis_are_few_and_apart(low, high):
    _, (axis,) = new_figure(5.0, 3.0)
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    decade_ticks(axis)
    ticks = axis.get_yticks()
    assert 3 <= len(ticks) <= 6
    assert np.min(ticks[1:] / ticks[:-1]) > (high / low) ** 0.08


def test_plots_leave_matplotlib_as_it_was(record):
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    overview_plot.overview_figure(record).canvas.draw()
    names = ("friction_coefficient", "friction_torque", "torque_capacity", "contact_torque")
    names += ("temperature",)
    pack = SimpleNamespace(**dict.fromkeys(names, 1.0))
    clutch_figure([1.0, 2.0], [pack, pack], pack, POINT)
    assert dict(mpl.rcParams) == before
