"""The report's section on rungs: what was chosen, how it was checked, what was run again."""

from dataclasses import replace

import shift_stand_in

from thrustwasher.report.rung_section import rung_sections
from thrustwasher.report.rungs import Check, Rungs
from thrustwasher.report.shift_report import shift_page

CHECKS = [
    Check("washer", "map", "field", 30, 0.0123, 0.006, 2.5e-3, False, "", ()),
    Check("washer", "field", "fine", 29, 0.001, 0.006, 0.4, True, "", ("at t = 0.1 s: no",)),
]
RUNGS = Rungs(
    reasons=["washer: map, friction_torque within 0.01 % (asked 0.6 %), 2 us per call"],
    trial_seconds=0.012,
    checks=CHECKS,
    again=["run again with washer field"],
    earlier_seconds=0.02,
    closing="washer: map, compared with field at 30 points",
)


def test_the_page_has_the_section_with_reasons_checks_and_what_ran_again():
    page = shift_page(replace(shift_stand_in.record(), rungs=RUNGS))
    (section,) = [s for s in page.sections if s.anchor == "rungs"]
    assert RUNGS.reasons[0] in section.texts and any("12 ms" in t for t in section.texts)
    assert "Run again with washer field." in section.texts
    assert "washer: fine gave no solution at t = 0.1 s: no" in section.texts
    (table,) = section.tables
    assert table.rows[0][:8] == ("washer", "map", "field", "30", "0", "1.23", "0.6", "no")
    assert table.rows[1][-2:] == ("yes", "400.00")


def test_a_run_without_choice_has_no_such_section():
    assert "rungs" not in [s.anchor for s in shift_page(shift_stand_in.record()).sections]
    assert rung_sections(None) == []


def test_a_choice_that_was_not_checked_says_so():
    (section,) = rung_sections(RUNGS._replace(checks=[], again=[]))
    assert any("not checked" in text for text in section.texts) and not section.tables


def test_inputs_that_left_their_box_are_told():
    left = CHECKS[0]._replace(outside="load of 0 .. 9 left 0 .. 5, for which it was chosen")
    (section,) = rung_sections(RUNGS._replace(checks=[left]))
    assert f"washer, map: {left.outside}." in section.texts
