"""The committed scripts and styles of pages are those of their sources, and stand alone."""

import hashlib
import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shift_stand_in
from kernel_files import ROOT
from scatter_stand_in import study
from shift_stand_in import record

from lab import structure
from thrustwasher.shift.account import summary
from thrustwasher.shift.account.swing_texts import judder_text
from thrustwasher.shift.oscillation.judder import Judder
from thrustwasher.shift.tolerance.selection_record import (
    Check,
    CheckRecord,
    Difference,
    Selected,
    Selection,
)
from thrustwasher.studio.report.bundles import FOLDER, bundle
from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.scatter import scatter_page
from thrustwasher.studio.report.shift import shift_report
from thrustwasher.studio.report.shift.how_sure import STUDY, how_sure_sections
from thrustwasher.studio.report.shift.overview_plot import overview_figure
from thrustwasher.studio.report.shift.shift_data import run_data
from thrustwasher.studio.report.shift.shift_report import level_sections, shift_page
from thrustwasher.studio.report.shift.shift_tables import key_table
from thrustwasher.studio.report.shift.usual import usual_table

TOOL = ROOT / "lab" / "pages"
RECORD = json.loads((FOLDER / "made_of.json").read_text("utf-8"))
AGAIN = "run: npm run --prefix lab/pages bundle"


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def digest_of_sources():
    """As ``digestOfSources`` in bundle.mjs."""
    found = {p.relative_to(FOLDER.parent).as_posix(): p for p in FOLDER.parent.rglob("*.[jc]s*")}
    found = {name: p for name, p in found.items() if p.suffix in (".js", ".css")}
    found = {name: p for name, p in found.items() if FOLDER not in p.parents}
    found |= {name: TOOL / name for name in ("bundle.mjs", "package-lock.json")}
    return digest("\0".join(f"{n}\n{found[n].read_text('utf-8')}" for n in sorted(found)))


def test_bundles_are_those_of_their_sources():
    assert digest_of_sources() == RECORD["sources"], AGAIN


def test_no_bundle_is_edited_left_over_or_missing():
    there = {p.name: digest(bundle(p.name)) for p in FOLDER.iterdir() if p.suffix != ".json"}
    assert there == RECORD["files"], AGAIN


@pytest.mark.parametrize("name", RECORD["files"])
def test_a_bundle_asks_for_nothing_and_can_stand_in_a_page(name):
    text = bundle(name)
    asks = r"""\bimport\s*[("'{*]|\brequire\(|@import|</script|</style|\beval\("""
    assert not re.search(asks, text)
    assert not re.search(r"url\((?!#|data:)", text)


def test_no_modules_of_the_pages_import_each_other_in_a_circle():
    web, graph = FOLDER.parent, {}
    for path in [p for p in web.rglob("*.js") if p.parent != FOLDER]:
        found = re.findall(
            r'(?m)^(?:import|export)\b[^;]*? from "(\.[^"]+)";', path.read_text("utf-8")
        )
        graph[path] = {(path.parent / name).resolve() for name in found}
    assert structure.circles(graph) == []
    assert sum(map(len, graph.values())) > 50


# What the report says of a shaft that swings: each kind of swing in its own words.

GROWS = Judder(
    pack="clutch", start=0.11, end=1.3, frequency=9.9, growth=3.42, amplitude=440.0, locks=8,
    slope=-1.34, damping=0.5, limit_damping=2.61, mode_frequency=9.901, mode_growth=3.41,
    step_growth=0.007, step=1e-3,
)  # fmt: skip
DECAYS = replace(GROWS, growth=-2.25, mode_growth=-2.25, damping=4.0, locks=0)
BY_STEP = replace(GROWS, growth=1.5, mode_growth=-0.15, step_growth=1.8, step=1e-2, damping=2.7)
HIDDEN = replace(GROWS, growth=-0.5, mode_growth=1.0, step_growth=-1.6)
WORSE = replace(GROWS, growth=4.7, step_growth=1.7, step=1e-2)
STRANGE = replace(GROWS, growth=9.0)


def shown(judder):
    made = record(washer=False)
    swing = 120.0 + 20.0 * np.sin(60.0 * made.time)
    shaft = {"transmission.shaft_torque": swing, "transmission.shaft_twist": swing / 1200.0}
    return replace(made, judder=judder, signals=made.signals | shaft)


@pytest.mark.parametrize(
    ("judder", "kind", "words"),
    [
        (
            GROWS,
            "physical",
            ["from 0.11 s", "9.9 Hz", "3.42 per second", "8 lock-ups", "physical", "below 2.61"],
        ),
        (DECAYS, "decaying", ["decays by 2.25", "has 4 "]),
        (BY_STEP, "numerical", ["Numerical, no judder", "decay by 0.15", "+1.8", "step of 1.3 ms"]),
        (HIDDEN, "numerical", ["Judder hidden by the step", "grow by 1", "-1.6"]),
        (WORSE, "numerical", ["Judder that the communication step falsifies", "+1.7"]),
        (STRANGE, "unexplained", ["does not explain", "half the step"]),
        (replace(DECAYS, slope=0.5), "decaying", ["rises by 0.5", "damps"]),
    ],
)
def test_every_kind_of_swing_has_its_words(judder, kind, words):
    text = judder_text(shown(judder))
    assert judder.kind == kind
    assert [w for w in words if w not in text] == []
    assert judder.as_dict()["kind"] == kind


def test_a_swing_that_decays_is_no_warning_and_all_others_are():
    assert summary.warnings(shown(DECAYS)) == summary.warnings(record(washer=False)) == []
    for judder in (GROWS, BY_STEP, HIDDEN, WORSE, STRANGE):
        assert judder_text(shown(judder)) in summary.warnings(shown(judder))


def test_the_page_has_a_chapter_of_the_swing_and_marks_where_it_was_judged():
    page = shift_page(shown(GROWS))
    chapter = next(s for s in page.sections if s.anchor == "judder")
    assert chapter.title == "Judder"
    rows = {row[0]: row[1:] for row in chapter.tables[0].rows}
    assert rows["frequency"] == ("9.9 Hz", "9.901 Hz")
    (run,) = page.data["runs"]
    assert (GROWS.end, "to here") in run["events"]
    assert "transmission.shaft_torque" not in run["aside"]


def test_a_pack_that_sticks_and_slips_has_not_locked():
    made = shown(GROWS)
    *before, last = made.phases
    swings = replace(made, phases=[*before, last._replace(name="stick-slip")])
    text = " ".join(summary.sentences(swings))
    assert "stuck and slipped in turn" in text and "locked at" not in text


# The report's section on levels: what was chosen, how it was checked, what was run again.

WORDS = ("washer: map, friction_torque within 0.01 % (asked 0.6 %), 2 µs per call",)
CHOSEN = Selection([Selected("washer", ("map", "field"), 0.006, True, WORDS, {}, ())])
CHECKS = [
    Check(1, "washer", "map", "field", 0.006, 30, (), Difference(0.0123), "", 2.5e-3),
    Check(
        2, "washer", "field", "fine", 0.006, 29, ("at t = 0.1 s: no",), Difference(1e-3), "", 0.4
    ),
]
GUARD = CheckRecord(CHECKS, ["run again with washer field"], 0.02)


def levels_record(**changes):
    return replace(shift_stand_in.record(), selection=CHOSEN, guard=GUARD, **changes)


def test_the_page_has_the_section_with_reasons_checks_and_what_ran_again():
    (section,) = [s for s in shift_page(levels_record()).sections if s.anchor == "levels"]
    assert WORDS[0] in section.texts and any("first run" in t for t in section.texts)
    assert "Run again with washer field." in section.texts
    assert "washer: fine gave no solution at t = 0.1 s: no" in section.texts
    (table,) = section.tables
    assert table.rows[0][:8] == ("washer", "map", "field", "30", "0", "1.23", "0.6", "no")
    assert table.rows[1][-2:] == ("yes", "400.00")


def test_a_choice_that_was_not_checked_says_so():
    (section,) = level_sections(replace(levels_record(), guard=None))
    assert any("not checked" in text for text in section.texts) and not section.tables


def test_a_level_that_left_what_it_is_verified_for_is_told():
    left = CHECKS[0]._replace(outside="it says itself from t = 0.2 s that it is not verified")
    (section,) = level_sections(replace(levels_record(), guard=CheckRecord([left], [], 0.0)))
    assert f"washer, map: {left.outside}." in section.texts
    assert "Nothing had to run again." in section.texts


# A shift's report with a study of its scene: bands next to figures, what the verdict rests on.

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
