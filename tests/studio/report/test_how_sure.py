"""A shift's report with a study of its scene: bands next to figures, what the verdict rests on."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
import shift_stand_in
from scatter_stand_in import study

from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.scatter import scatter_page
from thrustwasher.studio.report.shift import shift_report
from thrustwasher.studio.report.shift.how_sure import STUDY, how_sure_sections
from thrustwasher.studio.report.shift.overview_plot import overview_figure
from thrustwasher.studio.report.shift.shift_data import run_data
from thrustwasher.studio.report.shift.shift_tables import key_table
from thrustwasher.studio.report.shift.usual import usual_table

ALONE = shift_stand_in.record()
STUDIED = replace(ALONE, scatter=study())


@pytest.fixture
def no_moments(monkeypatch):
    monkeypatch.setattr(shift_report, "solve_moment", lambda record, time: None)


def row_of(table, words):
    return next(row for row in table.rows if row[0] == words)


def test_without_a_study_nothing_is_said_of_one(no_moments):
    page = shift_report.shift_page(ALONE)
    assert not {"how-sure", "decides", "scatter"} & {s.anchor for s in page.sections}
    assert not any("5\N{NO-BREAK SPACE}.." in card.note for card in page.cards)
    assert "bands" not in run_data(ALONE, {}) and how_sure_sections(ALONE) == []
    assert len(usual_table(ALONE).heads) == 5 and len(key_table(ALONE).heads) == 3


def test_key_figures_stand_beside_their_bands(no_moments):
    row = row_of(key_table(STUDIED), "lock after ramp start")
    assert row[1:] == ("1.65", "0.834 .. 0.846 s", "")
    assert row_of(key_table(STUDIED), "lock speed")[2] == ""
    cards = {card.name: card for card in shift_report.shift_page(STUDIED).cards}
    bands = {name: card.note.replace("\N{NO-BREAK SPACE}", " ") for name, card in cards.items()}
    heat, lock = "slip energy, median", "lock after ramp start, median"
    assert cards[heat].value == "11 kJ" and not cards[heat].figure
    assert bands[heat].startswith("5 .. 95 %: 10.9 .. 11.1 kJ<br>nominal values: ")
    assert bands[lock].endswith("above<br>5 .. 95 %: 0.834 .. 0.846 s<br>nominal values: 1.65 s")
    assert bands["probability: film lost"] == "95 % confidence: 16 .. 36 %"


def test_bands_of_steady_washers_share_the_doubt_of_the_run(no_moments):
    figures = study().figures
    hot = replace(figures["slip_energy"], unit="K", help="hottest spot of the washer")
    scatter = study(figures={**figures, "peak_washer_temperature_max": hot})
    steady = replace(ALONE, scatter=scatter)
    text = " ".join(map(str, how_sure_sections(steady)[0].texts))
    assert "are not followed in time" in text and "as doubtful" not in text
    found = SimpleNamespace(differences=["one"], stopped="", time=[0.0])
    doubted = replace(steady, in_time={"washer": found})
    assert "as doubtful" in " ".join(map(str, how_sure_sections(doubted)[0].texts))


def test_what_is_usual_has_the_probability_of_lying_outside():
    row = row_of(usual_table(STUDIED), "shift, from the first pressure to lock-up")
    words = tuple(text.replace("\N{NO-BREAK SPACE}", " ") for text in row[2:5])
    assert words == ("0.84 s", "0.834 .. 0.846 s", "0 % below, 100 % above (20 .. 44 %)")
    assert row_of(usual_table(STUDIED), "mean coefficient of friction")[2:5] == ("", "", "")


def test_the_verdict_on_the_washers_names_the_input_in_the_words_of_its_model():
    text = how_sure_sections(STUDIED)[0].texts[0]
    assert text.startswith(
        "The verdict on the washers rests most on “share of tilting couple washers take” "
        "(transmission.thrust_share)"
    )


def test_the_whole_study_is_linked_and_its_warnings_stand_there():
    warned = replace(STUDIED, scatter=study(warnings=("the shortcut errs by 3 %",)))
    texts = how_sure_sections(warned)[0].texts
    assert any(f'<a href="{STUDY}">' in text for text in texts)
    assert texts[-1] == "The shortcut errs by 3 %."


def test_a_note_on_errors_is_no_warning():
    noted = study(notes=("the shortcut errs by 2 %",))
    sections = {s.anchor: s.texts for s in how_sure_sections(replace(STUDIED, scatter=noted))}
    assert "The shortcut errs by 2 %." in sections["scatter"]
    page = scatter_page(noted)
    assert not page.warnings
    assert (
        "The shortcut errs by 2 %." in next(s for s in page.sections if s.anchor == "errors").texts
    )


def test_bands_over_time_are_in_the_page_and_in_its_picture(no_moments):
    bands = run_data(STUDIED, {})["bands"]
    time, low, high = bands["clutch.torque_capacity"]
    assert (time[-1], low[-1], high[-1]) == (2.5, 160.0, 240.0)
    torques = overview_figure(STUDIED).axes[1], overview_figure(ALONE).axes[1]
    shaded, bare = (len(axis.collections) for axis in torques)
    assert shaded == bare + 1
    text = render(shift_report.shift_page(STUDIED))
    data = text.split('id="data">')[1].split("</script>")[0]
    assert json.loads(data, parse_constant=pytest.fail)["runs"][0]["bands"] == bands
