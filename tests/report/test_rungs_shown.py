"""The report's section on rungs: what was chosen, what the guard saw, what it did."""

from dataclasses import replace

import shift_stand_in

from thrustwasher.report.rung_section import rung_figure, rung_sections
from thrustwasher.report.rungs import Change, Rungs, Stretch, Watched
from thrustwasher.report.shift_report import shift_page
from thrustwasher.report.tables import cost_table

RUNGS = Rungs(
    reasons=["washer: map, friction_torque within 0.01 % (asked 0.6 %), 2 us per call"],
    scout_seconds=0.012,
    watched=[Watched("washer", "map", "field", 0.006, 9, 0.0123, 2.5e-3)],
    stretches=[Stretch("washer", "map", 0.0, 0.4), Stretch("washer", "field", 0.4, 2.5)],
    changes=[Change(0.399, "washer", "map", "field", "difference", "friction_torque", 0.03, 0.031)],
    closing="washer: map 16 %, field 84 % of the time; 9 checks against field",
)


def record(rungs=RUNGS):
    return replace(shift_stand_in.record(), rungs=rungs, looks=2.5e-3)


def test_the_page_has_the_section_with_reasons_and_closing_line():
    page = shift_page(record())
    (section,) = [s for s in page.sections if s.anchor == "rungs"]
    assert RUNGS.reasons[0] in section.texts and f"{RUNGS.closing}." in section.texts
    assert any("12 ms" in text for text in section.texts)
    looks, changes = section.tables
    assert looks.rows[0][:4] == ("washer", "map", "field", "9")
    assert looks.rows[0][4:6] == ("1.23", "0.6")
    assert changes.rows[0][:5] == ("0.399", "washer", "map", "field", "too far from the rung above")


def test_a_run_without_choice_has_no_such_section():
    assert "rungs" not in [s.anchor for s in shift_page(shift_stand_in.record()).sections]
    assert rung_sections(None, 1.0) == []


def test_a_choice_that_nobody_watched_says_so():
    (section,) = rung_sections(RUNGS._replace(watched=[], stretches=[], changes=[]), 1.0)
    assert any("not watched" in text for text in section.texts) and not section.plots


def test_bars_cover_the_time_in_the_colours_of_their_rungs():
    (axis,) = rung_figure(RUNGS).axes
    bars = [(b.get_x(), b.get_width()) for b in axis.patches]
    assert bars == [(0.0, 0.4), (0.4, 2.1)]
    assert len({b.get_facecolor() for b in axis.patches}) == 2


def test_looks_stand_in_the_cost_table_and_not_in_the_rest():
    rows = {row[0]: row for row in cost_table(record()).rows}
    assert rows["guard, its looks"][5] == "2.5"
    before = {row[0]: row for row in cost_table(shift_stand_in.record()).rows}
    rest = float(before["master, the rest"][5]) - 2.5
    assert abs(float(rows["master, the rest"][5]) - rest) < 0.11
