"""The report's section on levels: what was chosen, how it was checked, what was run again."""

from dataclasses import replace

import shift_stand_in

from thrustwasher.shift.tolerance.selection_record import (
    Check,
    CheckRecord,
    Difference,
    Selected,
    Selection,
)
from thrustwasher.studio.report.shift.shift_report import level_sections, shift_page

WORDS = ("washer: map, friction_torque within 0.01 % (asked 0.6 %), 2 µs per call",)
CHOSEN = Selection([Selected("washer", ("map", "field"), 0.006, True, WORDS, {}, ())])
CHECKS = [
    Check(1, "washer", "map", "field", 0.006, 30, (), Difference(0.0123), "", 2.5e-3),
    Check(
        2, "washer", "field", "fine", 0.006, 29, ("at t = 0.1 s: no",), Difference(1e-3), "", 0.4
    ),
]
GUARD = CheckRecord(CHECKS, ["run again with washer field"], 0.02)


def record(**changes):
    return replace(shift_stand_in.record(), selection=CHOSEN, guard=GUARD, **changes)


def test_the_page_has_the_section_with_reasons_checks_and_what_ran_again():
    (section,) = [s for s in shift_page(record()).sections if s.anchor == "levels"]
    assert WORDS[0] in section.texts and any("first run" in t for t in section.texts)
    assert "Run again with washer field." in section.texts
    assert "washer: fine gave no solution at t = 0.1 s: no" in section.texts
    (table,) = section.tables
    assert table.rows[0][:8] == ("washer", "map", "field", "30", "0", "1.23", "0.6", "no")
    assert table.rows[1][-2:] == ("yes", "400.00")


def test_a_choice_that_was_not_checked_says_so():
    (section,) = level_sections(replace(record(), guard=None))
    assert any("not checked" in text for text in section.texts) and not section.tables


def test_a_level_that_left_what_it_is_verified_for_is_told():
    left = CHECKS[0]._replace(outside="it says itself from t = 0.2 s that it is not verified")
    (section,) = level_sections(replace(record(), guard=CheckRecord([left], [], 0.0)))
    assert f"washer, map: {left.outside}." in section.texts
    assert "Nothing had to run again." in section.texts
