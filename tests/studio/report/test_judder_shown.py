"""What the report says of a shaft that swings: each kind of swing in its own words."""

from dataclasses import replace

import numpy as np
import pytest
from shift_stand_in import record

from thrustwasher.shift.account import summary
from thrustwasher.shift.account.swing_texts import judder_text
from thrustwasher.shift.oscillation.judder import Judder
from thrustwasher.studio.report.shift.shift_report import shift_page

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
