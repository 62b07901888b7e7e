"""What the corrections of the physics moved: the figures, and how the page shows them."""

import pytest
from scene_runs import slow_without_jit

from lab.benchmarks.corrections import corrections
from lab.charts.chart_page import corrections_section


@pytest.fixture(scope="module")
def rows():
    return corrections()


@slow_without_jit
def test_a_settled_pack_has_the_friction_that_the_rig_measured(rows):
    means = [r for r in rows if r["figure"].startswith("mean friction")]
    assert [r["after"] for r in means] == pytest.approx([0.053, 0.053], abs=1e-4)
    assert all(r["recorded"] and r["before"] > 1.2 * r["after"] for r in means)


@slow_without_jit
def test_a_watt_of_loss_warms_the_flank_more_than_ten_times_as_much(rows):
    (flank,) = (r for r in rows if r["unit"] == "K/kW")
    assert flank["after"] > 10.0 * flank["before"] > 0.0


@slow_without_jit
def test_the_chapter_has_a_line_for_each_figure_and_marks_recorded_ones(rows):
    (table,) = corrections_section(rows).tables
    assert len(table.rows) == len(rows)
    assert [row[3].endswith("*") for row in table.rows] == [r["recorded"] for r in rows]
