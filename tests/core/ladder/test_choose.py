"""A choice is the first level that holds by its table, or by the level above where there is
none.
"""

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from synthetic import BOX, WHOLE, level, put

import thrustwasher
from thrustwasher import GearMeshParams, ParameterError, SolveError, WasherParams
from thrustwasher.ladder import choose as home
from thrustwasher.ladder import error_table
from thrustwasher.ladder.choose import choose, levels_of
from thrustwasher.ladder.compare_levels import Comparison, points_of, rows_to_compare
from thrustwasher.ladder.error_table import Axis
from thrustwasher.ladder.own_tables import ensure, serves
from thrustwasher.model.registry import spec_of
from thrustwasher.native.files import user_cache
from thrustwasher.storage import journal
from thrustwasher.storage.digests import params_digest
from thrustwasher.storage.journal import Journal

LADDER = (level("map", 2e-2), level("field", 5e-3), level("fine", 4e-4))
OWN = WasherParams(roughness=5.1e-7)


@pytest.fixture(autouse=True)
def given(tmp_path, monkeypatch):
    """Return a function that puts levels in the place of the shipped tables."""

    def give(*levels, **options):
        put(tmp_path, monkeypatch, *levels, **options)

    give(*LADDER)
    yield give
    error_table.forget()


def taken(tol, box=BOX, **options):
    return choose("washer", box, tol=tol, **options).fidelity


def test_the_first_that_holds_is_taken_with_its_error_and_the_reasons():
    found = [taken(tol) for tol in (0.0301, 0.0299, 0.0076, 0.0074, 6.1e-4)]
    assert found == ["map", "field", "field", "fine", "fine"]
    choice = choose("washer", BOX, tol=0.02, n_calls=1000)
    assert choice.is_verified and choice.error == pytest.approx(7.5e-3)
    assert choice.seconds == pytest.approx(0.2)
    assert str(choice).splitlines() == [
        "washer: field, friction_torque within 0.75 % (requested 2 %), 200 µs per call",
        "  too coarse: map, 3 % in 2 µs",
        "  would hold too: fine, 0.06 % in 2 ms",
    ]


def test_a_larger_tolerance_never_takes_a_dearer_level(given):
    """Errors need not fall from level to level: a map may err less than the mesh after it."""
    given(level("map", 6e-3), level("field", 0.1), level("fine", 5e-3))
    order = ["map", "field", "fine"]
    found = [order.index(taken(tol)) for tol in (7.6e-3, 9.1e-3, 0.05, 0.2)]
    assert found == sorted(found, reverse=True) == [2, 0, 0, 0]


def test_only_regions_that_the_box_touches_count(given):
    given(level("field", [[1e-3, 0.5], [0.5, 0.5]]), level("fine", 1e-4))
    light = {**BOX, "load": (30.0, 150.0), "speed": (-200.0, -100.0)}
    assert taken(0.01, light) == "field"
    assert taken(0.01, {**light, "speed": (-600.0, -100.0)}) == "fine"
    assert taken(0.01, {**light, "load": (30.0, 250.0)}) == "fine"


def test_nothing_holds_names_the_best():
    with pytest.raises(SolveError) as refusal:
        choose("washer", BOX, tol=1e-6)
    assert str(refusal.value) == (
        "washer: no fidelity level reaches 0.0001 % in friction_torque; the best is fine "
        "with 0.06 %. Ask "
        "for less, or name a fidelity level"
    )


def test_a_temperature_is_chosen_for_in_kelvin_and_safety_is_a_factor():
    assert choose("washer", BOX, quantity="temperature", tol=0.2).error == pytest.approx(0.15)
    assert "within 0.15 K (requested 0.2 K)" in str(
        choose("washer", BOX, quantity="temperature", tol=0.2)
    )
    assert taken(0.02, safety=5.0) == "fine"
    assert taken(0.5, among=["field", "fine"]) == "field"


def test_beside_a_fold_its_own_error_is_told(given):
    given(level("field", 1e-3, beside_fold=0.02))
    assert "within 5 % of a fold's load: 3 %" in str(choose("washer", BOX, tol=0.01))


def test_a_stale_level_is_passed_over_and_named(given):
    given(level("map", 1e-3, sources="0" * 64), level("field", 5e-3))
    choice = choose("washer", BOX, tol=0.01)
    assert choice.fidelity == "field" and "not counted: map: the kernels have changed" in str(
        choice
    )


def test_a_level_whose_box_is_left_is_passed_over(given):
    small = {**WHOLE, "load": Axis(20.0, 200.0, "N", "log")}
    given(level("map", 1e-3, box=small), level("field", 5e-3))
    assert taken(0.01) == "field"
    assert taken(0.01, {**BOX, "load": (30.0, 200.0)}) == "map"


# where no table speaks


def compared(monkeypatch, differences):
    """Let levels differ from those above by what is given; return what was asked."""
    asked = []

    def difference(self, one, above):
        asked.append((one, above, len(self.points)))
        return differences[one]

    monkeypatch.setattr(Comparison, "difference", difference)
    monkeypatch.setattr(home, "levels_of", lambda *_: ["map", "field", "fine"])
    return asked


@pytest.mark.parametrize(
    ("tol", "level", "error"),
    [(0.041, "map", 0.04), (0.021, "field", 0.02), (0.019, "fine", math.inf)],
)
def test_the_first_that_the_one_above_confirms_is_taken(monkeypatch, tol, level, error):
    asked = compared(monkeypatch, {"map": 0.02, "field": 0.01})
    choice = choose("washer", BOX, tol=tol, params=OWN)
    assert (choice.fidelity, choice.is_verified) == (level, False)
    assert choice.error == pytest.approx(error) and asked[0] == ("map", "field", 30)
    assert "no table of errors speaks here" in choice.reasons[0]


def test_a_single_point_is_solved_once_with_each_level(monkeypatch):
    point = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
    solved = []
    value = Comparison._value
    monkeypatch.setattr(
        Comparison, "_value", lambda self, *at: solved.append(at) or value(self, *at)
    )
    choice = choose("washer", point, tol=0.05, params=OWN)
    assert choice.fidelity == "field" and 0.0 < choice.error < 0.05
    assert [level for level, _ in solved] == ["field", "fine"]
    assert choose("washer", point, tol=0.05, params=OWN) == choice


def test_a_box_that_leaves_the_table_is_compared(monkeypatch):
    asked = compared(monkeypatch, {"map": 0.0})
    choice = choose("washer", {**BOX, "load": (10.0, 1000.0)}, tol=0.02)
    assert asked and not choice.is_verified


def test_points_fill_a_box_and_are_the_same_each_time():
    points = points_of(BOX)
    assert len(points) == 30 and points == points_of(BOX)
    for name, low, high in (("load", 30.0, 1000.0), ("speed", 100.0, 1000.0)):
        values = sorted(p[name] for p in points)
        assert (values[0], values[-1]) == (pytest.approx(low), pytest.approx(high))
        assert max(b / a for a, b in pairwise(values)) < (high / low) ** 0.15
    assert {p["tilt"] for p in points} == {2e-3}
    assert points_of({"load": (3.0, 3.0)}) == [{"load": 3.0}]


def test_rows_to_compare_hold_the_extremes_of_every_input():
    rows = np.random.default_rng(1).random((500, 4))
    some = rows_to_compare(rows)
    assert 25 <= len(some) <= 30
    assert (some.min(0) == rows.min(0)).all() and (some.max(0) == rows.max(0)).all()
    assert len(rows_to_compare(rows[:3])) == 3


def test_a_level_that_differs_with_some_parameters_only_is_asked_then():
    mesh = spec_of("gearmesh")
    assert levels_of(mesh, GearMeshParams()) == ["field"]
    assert levels_of(mesh, GearMeshParams.preset("paper")) == ["field", "fine"]
    assert levels_of(spec_of("washer"), WasherParams()) == ["map", "field", "fine"]
    assert levels_of(spec_of("washer"), OWN) == ["field", "fine"], "it has no map"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"model": "gearbox"}, "'washer' or 'clutch' or 'gearmesh'"),
        ({"box": {**BOX, "heat": 1.0}}, "'heat' is no input"),
        ({"box": {"load": (1.0, 2.0)}}, "speed .* is missing"),
        ({"box": {**BOX, "load": (5.0, 1.0)}}, "load = .* low <= high"),
        ({"box": {**BOX, "load": "much"}}, "a number or"),
        ({"box": {**BOX, "load": (1.0, 1e9)}}, "allowed: 0 .. 200000"),
        ({"quantity": "noise"}, "'friction_torque' or 'temperature'|friction_torque or temp"),
        ({"tol": 0.0}, "tol = 0.0, allowed: above 0"),
        ({"tol": math.nan}, "tol = nan"),
        ({"n_calls": 0}, "n_calls = 0, allowed: 1 or more"),
        ({"safety": 0.5}, "safety = 0.5, allowed: 1 or more"),
        ({"among": ["best"]}, "among: 'best', allowed: 'map'"),
        ({"among": []}, "among: no fidelity level"),
    ],
)
def test_what_is_wrong_is_named_with_what_is_allowed(changes, said):
    given = {"model": "washer", "box": BOX, "tol": 0.01, **changes}
    with pytest.raises(ParameterError, match=said):
        thrustwasher.choose(given.pop("model"), given.pop("box"), **given)


def test_at_a_point_the_error_is_that_which_the_solution_estimates():
    """The fixture's tables promise 0.75 % in the box; what a finer mesh shows is far less."""
    at = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
    choice = choose("washer", at, tol=0.01)
    solved = thrustwasher.solve_washer(WasherParams(), **at, fidelity=choice.fidelity)
    assert choice.error == solved.error_estimate and "at this point" in str(choice)
    finest = thrustwasher.solve_washer(WasherParams(), **at, grid=(41, 128))
    true = abs(solved.friction_torque / finest.friction_torque - 1.0)
    assert true <= choice.error <= 20.0 * true


def test_equal_choices_without_a_time_are_equal():
    one, other = (home.Choice("map", 0.01, float("nan"), ("map: cheapest",)) for _ in "ab")
    assert one == other


# A part's map is built once, whoever else builds it; only one within its tolerance serves.

PARAMS, OWN_BOX = WasherParams(), {"load": (20.0, 100.0)}


class Tables:
    """A map that is built by a call; ``metadata`` is what it says of itself."""

    def __init__(self, **metadata):
        self.metadata, self.built = metadata, 0

    def box(self, params):
        from thrustwasher.errors import ParameterError

        if not self.metadata:
            raise ParameterError("there is no map")
        return OWN_BOX

    def find(self, params):
        return SimpleNamespace(metadata=self.metadata)

    def least(self, name, ends):
        return ends[0]

    def build(self, params, box, tol, workers, progress):
        self.built += 1
        self.metadata = {"tolerance": tol}


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(journal, "LOOK", 0.01)


def lock():
    return Journal(user_cache() / "maps" / f"{params_digest(PARAMS)[:16]}.lock", {}, "map")


def test_a_map_that_serves_is_not_built_again():
    tables, said = Tables(), []
    for _ in range(2):
        ensure(tables, PARAMS, OWN_BOX, 0.01, None, begin=lambda: said.append("begins"))
    assert tables.built == 1 and said == ["begins"]


def test_one_that_another_run_built_meanwhile_is_taken():
    tables, said, held = Tables(), [], lock()

    def other_ends(text):
        said.append(text)
        tables.metadata = {"tolerance": 0.01}
        held.close()

    ensure(tables, PARAMS, OWN_BOX, 0.01, None, begin=lambda: said.append("begins"), say=other_ends)
    assert tables.built == 0 and len(said) == 1 and said[0].startswith("waits for another run: ")


def test_a_run_whose_forerunner_failed_builds():
    tables, said, held = Tables(), [], lock()
    ensure(
        tables, PARAMS, OWN_BOX, 0.01, None,
        begin=lambda: said.append("begins"), say=lambda _: held.close(),
    )  # fmt: skip
    assert tables.built == 1 and said == ["begins"]


@pytest.mark.parametrize(("held_out", "does"), [(0.009, True), (0.011, False)])
def test_a_map_that_misses_its_tolerance_does_not_serve(held_out, does):
    tables = Tables(tolerance=0.01, held_out={"torque": held_out})
    assert serves(tables, PARAMS, OWN_BOX, 0.01) == does


def test_a_map_whose_errors_are_not_known_yet_does_not_serve():
    """As the draft of another run, which lies there while its errors are measured."""
    assert not serves(Tables(tolerance=0.01, held_out=None), PARAMS, OWN_BOX, 0.01)
