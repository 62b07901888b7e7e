"""Cards are made from random points and a reference: sampling, errors, tables, keeping, writing."""

import dataclasses
import itertools

import numpy as np
import pytest
from synthetic import card, errors

from thrustwasher import WasherParams, solve_washer
from thrustwasher.command.kernels import step as command_step
from thrustwasher.ladder.card import read_card
from thrustwasher.ladder.card_parts import QUANTITIES
from thrustwasher.shift import load_scene
from thrustwasher.storage.digests import params_digest
from thrustwasher.study import reference_cache
from thrustwasher.study.card_cases import cases
from thrustwasher.study.card_writer import write_card
from thrustwasher.study.costs import Timing, stepper
from thrustwasher.study.error_tables import (
    by_film_ratio,
    deviation,
    error_tables,
    fold_part,
    uncertainties,
)
from thrustwasher.study.reference_cache import reference_points
from thrustwasher.study.reference_values import (
    FAILED,
    OK,
    OTHER_SIDE,
    OUTSIDE,
    Answer,
    ReferencePoint,
    Source,
)
from thrustwasher.study.reference_washer import solve_on
from thrustwasher.study.surroundings import this_machine

MODELS = ("washer", "clutch", "gearmesh")
DEFAULT = {m: cases(m)[0] for m in MODELS}


def known(value, point=None, beside=False, uncertainty=0.0):
    values = dict.fromkeys(QUANTITIES, value)
    return ReferencePoint(
        point or {}, None, None, values, dict.fromkeys(QUANTITIES, uncertainty), beside
    )


def said(value, verdict=OK):
    return Answer(dict.fromkeys(QUANTITIES, value), verdict)


# held-out points


@pytest.mark.parametrize("model", MODELS)
def test_points_lie_in_the_box_and_do_not_depend_on_their_number(model):
    case = DEFAULT[model]
    for k in range(50):
        point = case.point(k)
        assert list(point) == [s.name for s in case.spec.inputs if not s.optional]
        assert all(a.min <= point[n] <= a.max for n, a in case.envelope.items())
    assert case.point(7) == DEFAULT[model].point(7) != case.point(8)


def test_points_are_uniform_in_the_scaled_box():
    case = DEFAULT["washer"]
    low = sum(case.point(k)["load"] < (20.0 * 1850.0) ** 0.5 for k in range(400))
    assert 160 < low < 240


@pytest.mark.parametrize(
    ("model", "part"),
    [("washer", "washer"), ("clutch", "clutch"), ("clutch", "brake"), ("gearmesh", "mesh"),
     ("gearmesh", "ring_mesh")],
)  # fmt: skip
def test_the_parts_of_the_default_scene_have_cards_of_their_own(model, part):
    """One speaks for clutch and brake: how a pack starts is no matter of the pack."""
    own = params_digest(load_scene("planetary").parts[part].params)
    assert own in [params_digest(case.params) for case in cases(model)[1:]]


def test_a_part_of_the_box_has_the_points_that_lie_in_it():
    case = DEFAULT["washer"]
    part = case.within({**{n: (a.min, a.max) for n, a in case.envelope.items()},
                        "tilt": (1.5e-3, 9e-3)})  # fmt: skip
    ks = part.numbers(40)
    assert len(ks) == 40 and ks == sorted(ks) and ks[-1] > 40
    assert all(part.point(k)["tilt"] >= 1.5e-3 and part.point(k) == case.point(k) for k in ks)
    assert (part.verified["tilt"].min, part.verified["tilt"].max) == (1.5e-3, 3e-3)
    whole = {n: (a.min * (1.0 + 1e-12), a.max) for n, a in case.envelope.items()}
    assert case.within(whole) is case and case.numbers(3) == [0, 1, 2]


# errors and tables


def test_a_relative_error_has_a_floor():
    assert deviation("friction_torque", known(2.0), 2.2, 0.01) == pytest.approx(0.1)
    assert deviation("friction_torque", known(0.0), 0.001, 0.01) == pytest.approx(0.1)
    assert deviation("temperature", known(300.0), 301.5, 0.01) == pytest.approx(1.5)


def test_a_course_is_judged_by_its_largest_error_over_its_largest_value():
    expected = known([0.0, 10.0, 5.0])
    assert deviation("friction_torque", expected, [1.0, 10.0, 4.5], 0.0) == pytest.approx(0.1)


def pairs_over(case, n, answer_of):
    points = [case.point(k) for k in range(n)]
    return [(known(1.0, p), answer_of(k)) for k, p in enumerate(points)]


def test_tables_count_every_answer_once_and_only_those_that_count():
    case = DEFAULT["washer"]
    verdicts = [OK, OUTSIDE, FAILED, OK]
    pairs = pairs_over(case, 120, lambda k: said(1.1, verdicts[k % 4]))
    found, cells = error_tables(pairs, case.envelope)
    table = found["friction_torque"]
    assert sum(map(sum, table.n)) == 60
    assert sum(map(sum, cells.outside)) == 30
    assert table.worst[0][0] == 0.1
    assert cells.edges[0][0] == case.envelope["load"].min


def test_the_worst_is_the_worst_and_never_rounded_down():
    case = DEFAULT["washer"]
    pairs = pairs_over(case, 90, lambda k: said(1.0 + 1.0001e-3 * k))
    table = error_tables(pairs, case.envelope)[0]["friction_torque"]
    assert max(w for row in table.worst for w in row) >= 0.0891 > 89 * 1.0001e-3


def test_points_beside_a_fold_are_told_apart():
    case = DEFAULT["washer"]
    pairs = pairs_over(case, 60, lambda k: said(1.01))
    beside = [dataclasses.replace(t, beside_fold=True) for t, _ in pairs[:3]]
    answers = [said(1.5), said(9.0, OTHER_SIDE), said(1.2)]
    pairs = [*zip(beside, answers, strict=True), *pairs[3:]]
    table = error_tables(pairs, case.envelope)[0]["friction_torque"]
    assert max(w for row in table.worst for w in row) == pytest.approx(0.01, rel=1e-2)
    fold = fold_part(pairs)
    assert (fold.n, fold.other_side) == (3, 1)
    assert fold.worst["friction_torque"] == pytest.approx(0.5)
    assert fold_part(pairs[3:]) is None


def test_classes_of_film_ratio_hold_thirty_points_and_their_worst_error():
    points = [dataclasses.replace(known(1.0), values={**known(1.0).values, "film_ratio": 0.1 * k})
             for k in range(90)]  # fmt: skip
    found = by_film_ratio([(t, said(1.1 if 30 <= k < 60 else 1.001)) for k, t in enumerate(points)])
    assert found.n == (30, 30, 30) and found.edges == pytest.approx((3.0, 6.0), abs=0.1)
    assert found.worst["friction_torque"] == pytest.approx((1e-3, 0.1, 1e-3), rel=1e-2)
    course = dataclasses.replace(known(1.0), values={q: [1.0, 2.0] for q in QUANTITIES})
    assert by_film_ratio([(course, said([1.0, 2.0]))]) is None


def test_the_uncertainty_of_the_reference_counts_as_error():
    assert deviation("friction_torque", known(2.0, uncertainty=0.1), 2.2, 0.0) == pytest.approx(
        0.15
    )


def test_the_uncertainty_named_is_the_typical_one_away_from_folds():
    points = [known(2.0, uncertainty=u) for u in (1e-3, 1e-3, 1.0)]
    points.append(known(2.0, uncertainty=9.0, beside=True))
    assert uncertainties(points)["friction_torque"] == pytest.approx(5e-4)


@pytest.mark.parametrize("n", [10, 40, 100, 250, 600])
def test_each_cell_holds_enough_points_to_speak_for_itself(n):
    case = DEFAULT["washer"]
    table = error_tables(pairs_over(case, n, lambda k: said(1.0)), case.envelope)[0][
        "friction_torque"
    ]
    counts = [c for row in table.n for c in row]
    assert sum(counts) == n
    assert min(counts) >= 30 or len(counts) == 1
    assert len(counts) >= min(n // 75, 12)


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


# time, machine, files


def test_what_python_adds_to_a_call_is_taken_off():
    arrays = [np.zeros(6) for _ in range(5)]
    assert command_step.step(*arrays, np.zeros(3, np.int32), 0.0, 1.0) == 0
    timing = Timing(1.25, 0.5, 1.0, 9, 2.0).less(0.25)
    assert (timing.median, timing.iqr, timing.least) == (1.0, 0.5, 0.75)
    assert timing.less(5.0).median > 0.0


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


def test_the_machine_is_named():
    machine = this_machine()
    assert machine["cpu"] and machine["cores"] >= 1 and machine["numba"].count(".") == 2


def test_a_written_card_is_read_back(tmp_path):
    made = card(chart="film", errors={"friction_torque": errors([[1e-3, None], [2e-3, 3e-3]])})
    path = write_card(made, tmp_path / "new")
    assert path.name == "washer-field-film.json"
    assert read_card(path) == made
    assert [p.name for p in path.parent.iterdir()] == [path.name]
