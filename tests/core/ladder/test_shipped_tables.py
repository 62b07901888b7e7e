"""The tables in the package: all there, fresh, plausible, and true at points solved again."""

import pytest

from lab.verify import cases
from thrustwasher import choose
from thrustwasher.ladder.choose import levels_of
from thrustwasher.ladder.error_table import QUANTITIES, fresh_levels, load_tables, refused_files
from thrustwasher.storage.digests import DATA
from thrustwasher.studio.verification.measured_chart import deviation
from thrustwasher.studio.verification.reference_cache import SOURCES, answer
from thrustwasher.studio.verification.reference_values import OK

MODELS = ("washer", "clutch", "gearmesh")
CASES = [case for model in MODELS for case in cases(model)]
AGAIN = (3, 211)  # points solved again, of every chart
MAKE = "made by: python -m lab.verify"


def label(case):
    return f"{case.spec.key}-{case.name}"


@pytest.mark.parametrize("case", CASES, ids=label)
def test_every_level_that_can_be_chosen_is_known_and_fresh(case):
    (table,) = load_tables(case.spec.key, case.params)
    assert [r.fidelity for r in table.levels] == levels_of(case.spec, case.params), MAKE
    assert [table.stale(r) for r in table.levels] == [None] * len(table.levels)
    assert table.name == case.name and table.reference
    assert sorted(r.call for r in table.levels) == [r.call for r in table.levels], "by cost"


def test_no_file_is_refused_and_each_is_that_of_a_model():
    assert refused_files() == {}
    assert {p.stem for p in (DATA / "error_tables").iterdir()} == set(MODELS)


@pytest.mark.parametrize("case", CASES, ids=label)
def test_every_region_holds_thirty_points_and_all_hold_three_hundred(case):
    for level in fresh_levels(case.spec.key, case.params).values():
        assert sum(chart.points for chart in level.charts) >= 300
        for chart in level.charts:
            for division in chart.divisions:
                counts = [row[2 * len(division.axes)] for row in division.rows]
                assert min(counts) >= 30 and sum(counts) == chart.points


@pytest.mark.parametrize("case", CASES, ids=label)
@pytest.mark.slow
def test_points_solved_again_err_as_their_table_says(case):
    known = [t for k in AGAIN for t in SOURCES[case.spec.key].solve(case.params, case.point(k))]
    known = [t for t in known if not t.beside_fold]
    assert known
    for name, level in fresh_levels(case.spec.key, case.params).items():
        floors = {chart.name: chart.floor for chart in level.charts}
        for t in known:
            found = answer(case.spec.key, case.params, name, t)
            box = {n: (x, x) for n, x in t.point.items()}
            for q in QUANTITIES if found.verdict == OK else ():
                error = deviation(q, t, found.values[q], floors[t.chart])
                worst = level.worst(q, box, t.chart)
                assert error <= 1.02 * worst + 1e-12, (name, q, t.point)


@pytest.mark.parametrize("case", CASES, ids=label)
def test_a_coarse_tolerance_can_be_had_over_the_whole_box(case):
    box = {name: (axis.min, axis.max) for name, axis in case.box.items()}
    choice = choose(case.spec.key, box, tol=0.1, params=case.params)
    assert choice.is_verified and choice.error <= 0.1
