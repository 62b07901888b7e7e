"""Tables are made from random points and a reference: sampling, errors, regions, keeping."""

import dataclasses
import itertools

import pytest

from lab.verify import cases
from thrustwasher import WasherParams, solve_washer
from thrustwasher.ladder.error_table import QUANTITIES
from thrustwasher.shift import load_scene
from thrustwasher.storage.digests import params_digest
from thrustwasher.studio.verification import reference_cache
from thrustwasher.studio.verification.costs import stepper
from thrustwasher.studio.verification.measured_chart import NO_ANSWER, chart_of, deviation
from thrustwasher.studio.verification.reference_cache import reference_points
from thrustwasher.studio.verification.reference_values import (
    FAILED,
    OK,
    OTHER_SIDE,
    OUTSIDE,
    Answer,
    ReferencePoint,
    Source,
)
from thrustwasher.studio.verification.reference_washer import solve_on

MODELS = ("washer", "clutch", "gearmesh")
DEFAULT = {m: cases(m)[0] for m in MODELS}
TORQUE = list(QUANTITIES).index("friction_torque") - len(QUANTITIES)  # of a region's row


def known(value, point=None, beside=False, uncertainty=0.0):
    values = dict.fromkeys(QUANTITIES, value)
    return ReferencePoint(
        point or {}, None, None, values, dict.fromkeys(QUANTITIES, uncertainty), beside
    )


def said(value, verdict=OK):
    return Answer(dict.fromkeys(QUANTITIES, value), verdict)


# random points


@pytest.mark.parametrize("model", MODELS)
def test_points_lie_in_the_box_and_do_not_depend_on_their_number(model):
    case = DEFAULT[model]
    for k in range(50):
        point = case.point(k)
        assert list(point) == [s.name for s in case.spec.inputs if not s.optional]
        assert all(a.min <= point[n] <= a.max for n, a in case.box.items())
    assert case.point(7) == DEFAULT[model].point(7) != case.point(8)


def test_points_are_uniform_in_the_scaled_box():
    case = DEFAULT["washer"]
    low = sum(case.point(k)["load"] < (20.0 * 1850.0) ** 0.5 for k in range(400))
    assert 160 < low < 240


@pytest.mark.parametrize(
    ("model", "part"),
    [
        ("washer", "washer"),
        ("clutch", "clutch"),
        ("clutch", "brake"),
        ("gearmesh", "mesh"),
        ("gearmesh", "ring_mesh"),
    ],
)
def test_the_parts_of_the_default_scene_have_tables_of_their_own(model, part):
    """One speaks for clutch and brake: how a pack starts is no matter of the pack."""
    own = params_digest(load_scene("planetary").parts[part].params)
    assert own in [params_digest(case.params) for case in cases(model)[1:]]


# errors and regions


def test_a_relative_error_has_a_floor():
    assert deviation("friction_torque", known(2.0), 2.2, 0.01) == pytest.approx(0.1)
    assert deviation("friction_torque", known(0.0), 0.001, 0.01) == pytest.approx(0.1)
    assert deviation("temperature", known(300.0), 301.5, 0.01) == pytest.approx(1.5)


def test_a_profile_is_judged_by_its_largest_error_over_its_largest_value():
    expected = known([0.0, 10.0, 5.0])
    assert deviation("friction_torque", expected, [1.0, 10.0, 4.5], 0.0) == pytest.approx(0.1)


def chart(n, answer_of, beside=lambda k: False):
    """Return the chart of ``n`` points of the default washer; film ratios rise with them."""
    case, pairs = DEFAULT["washer"], []
    for k in range(n):
        values = {**known(1.0).values, "film_ratio": 0.1 * k}
        point = dataclasses.replace(known(1.0, case.point(k), beside(k)), values=values)
        found = answer_of(k)
        found.values["film_ratio"] = values["film_ratio"]
        pairs.append((point, found))
    return chart_of("film", pairs, case.box)


def rows_of(chart, *axes):
    return next(d.rows for d in chart.divisions if d.axes == axes)


@pytest.mark.parametrize("n", [10, 40, 100, 250, 600])
def test_each_region_holds_enough_points_to_speak_for_itself(n):
    rows = rows_of(chart(n, lambda k: said(1.0)), "load", "speed")
    counts = [row[4] for row in rows]
    assert sum(counts) == n
    assert min(counts) >= 30 or len(counts) == 1
    assert len(counts) >= min(n // 75, 12)
    box = DEFAULT["washer"].box
    ends = {k: (min(row[k] for row in rows), max(row[k + 1] for row in rows)) for k in (0, 2)}
    assert ends == {k: (box[n].min, box[n].max) for k, n in ((0, "load"), (2, "speed"))}


def test_the_worst_is_the_worst_and_never_rounded_down():
    rows = rows_of(chart(90, lambda k: said(1.0 + 1.0001e-3 * k)), "load", "speed")
    assert 0.0892 > max(row[TORQUE] for row in rows) >= 0.0891 > 89 * 1.0001e-3


@pytest.mark.parametrize("verdict", [FAILED, OUTSIDE])
def test_a_point_without_an_answer_is_an_error_that_no_tolerance_holds(verdict):
    made = chart(40, lambda k: said(1.0, verdict if k == 7 else OK))
    (row,) = rows_of(made, "load", "speed")
    assert row[TORQUE] == NO_ANSWER > 1e6


def test_points_beside_a_fold_are_told_apart():
    answers = {0: said(1.5), 1: said(9.0, OTHER_SIDE), 2: said(1.2)}
    made = chart(60, lambda k: answers.get(k, said(1.01)), beside=lambda k: k < 3)
    assert made.points == 57 and made.beside_fold == pytest.approx(0.5)
    rows = rows_of(made, "load", "speed")
    assert max(row[TORQUE] for row in rows) == pytest.approx(0.01, rel=1e-2)
    assert chart(60, lambda k: said(1.0)).beside_fold == 0.0


def test_classes_of_film_ratio_hold_thirty_points_and_their_worst_error():
    made = chart(90, lambda k: said(1.1 if 30 <= k < 60 else 1.001))
    rows = rows_of(made, "film_ratio")
    assert [row[2] for row in rows] == [30, 30, 30]
    assert [row[TORQUE] for row in rows] == pytest.approx([1e-3, 0.1, 1e-3], rel=1e-2)
    assert rows[0][0] < -1e8 and rows[1][:2] == pytest.approx((3.0, 6.0), abs=0.1)
    profile = (known([1.0, 2.0], DEFAULT["washer"].point(0)), said([1.0, 2.0]))
    assert [d.axes for d in chart_of(None, [profile], DEFAULT["washer"].box).divisions] == [
        ("load", "speed")
    ]


def test_the_uncertainty_of_the_reference_counts_as_error():
    assert deviation("friction_torque", known(2.0, uncertainty=0.1), 2.2, 0.0) == pytest.approx(
        0.15
    )


# reference values are kept


@pytest.fixture
def kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    asked = []

    def solve(params, point):
        asked.append(point)
        return [known(1.0, point)]

    return asked, Source(
        solve, None, None, ("thrustwasher.tribology.flow_factors",), None, ("one route",)
    )


def test_a_point_is_solved_once_and_a_stopped_run_goes_on(kept):
    asked, source = kept
    first = reference_points(DEFAULT["washer"], source, 3)
    more = reference_points(DEFAULT["washer"], source, 5)
    assert len(asked) == 5 and more[:3] == first


def test_values_of_other_kernels_or_parameters_are_not_taken(kept, monkeypatch):
    asked, source = kept
    reference_points(DEFAULT["washer"], source, 1)
    reference_points(cases("washer")[1], source, 1)
    monkeypatch.setattr(reference_cache, "kernel_digest", lambda files: "other")
    reference_points(DEFAULT["washer"], source, 1)
    assert len(asked) == 3


# the washer's finer meshes


@pytest.mark.parametrize(("load", "branch"), [(300.0, "film"), (800.0, "contact")])
def test_a_solution_carried_to_another_mesh_is_the_one_found_there(load, branch):
    point = {"load": load, "speed": 545.0, "tilt": 2e-3}
    coarse = solve_washer(WasherParams(), **point, branch=branch)
    carried = solve_on(coarse, (19, 64))
    cold = solve_washer(WasherParams(), **point, branch=branch, fidelity="fine")
    assert carried.branch == branch and carried.grid == (19, 64)
    assert carried.friction_torque == pytest.approx(cold.friction_torque, rel=2e-5)
    assert carried.temperature == pytest.approx(cold.temperature, abs=1e-3)
    assert carried.iterations < cold.iterations


# time


def test_a_timed_step_goes_to_and_fro_and_stays_away_from_the_fold():
    spec = DEFAULT["gearmesh"].spec
    point = {"load": 40.0, "speed": 180.0, "oil_temperature": 300.0}
    loads = []

    def step(par, inp, *rest):
        loads.append(float(inp[0]))
        return 0

    call = stepper(spec, spec.params(), "field", known(1.0, point), step)
    for _ in range(80):
        call()
    steps = {round(abs(b / a - 1.0), 3) for a, b in itertools.pairwise(loads)}
    assert min(loads) == loads[0] == loads[40] == loads[80] == 40.0
    assert steps == {0.003}
