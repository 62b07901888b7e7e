"""The chooser decides as its cards say: cheapest that holds, nothing stale, nothing unsaid."""

import math
from dataclasses import replace

import pytest
from synthetic import BOX, ENVELOPE, RUNGS, card

import thrustwasher
from thrustwasher import ParameterError, SolveError
from thrustwasher.ladder import candidates as home
from thrustwasher.ladder.card_parts import Axis, Fold
from thrustwasher.ladder.choose import choose
from thrustwasher.model.registry import find_model
from thrustwasher.washer.parameters import SPEC

LADDER = (
    card("coarse", 1.0, 1e-6, first=0.0),
    card("fine", 4e-4, 2e-3, first=0.0),
    card("field", 5e-3, 2e-4, first=0.0),
)


@pytest.fixture
def ladder(monkeypatch):
    """Return a function that puts cards in place of the shipped ones."""
    washer, kernels = (
        replace(SPEC, fidelities=dict.fromkeys(RUNGS, "")),
        find_model("washer").ladder.kernels,
    )
    monkeypatch.setitem(kernels, "coarse", kernels["field"])
    monkeypatch.setattr("thrustwasher.washer.parameters.SPEC", washer)

    def put(*cards, refused=None):
        monkeypatch.setattr(home, "load_cards", lambda model: list(cards))
        monkeypatch.setattr(home, "refused_files", lambda: refused or {})

    put(*LADDER)
    return put


def test_the_cheapest_that_holds_is_taken(ladder):
    assert choose("washer", BOX, tol=2.0).fidelity == "coarse"
    assert choose("washer", BOX, tol=0.02).fidelity == "field"
    assert choose("washer", BOX, tol=0.005).fidelity == "fine"


def test_the_promise_is_the_worst_error_with_safety(ladder):
    choice = choose("washer", BOX, tol=0.02)
    assert choice.error == pytest.approx(7.5e-3)
    assert choose("washer", BOX, tol=0.02, safety=3.0).error == pytest.approx(1.5e-2)
    assert choose("washer", BOX, tol=7.5e-3).fidelity == "field"
    assert choose("washer", BOX, tol=7.4e-3).fidelity == "fine"


def test_the_uncertainty_of_the_reference_is_a_floor(ladder):
    ladder(card("field", 1e-6, uncertainty=2e-3))
    assert choose("washer", BOX, tol=0.02).error == pytest.approx(3e-3)


def test_only_cells_that_the_box_touches_count(ladder):
    ladder(card("field", [[1e-3, 1e-3], [0.5, 0.5]]), card("fine", 1e-4, 2e-3))
    light = {**BOX, "load": (30.0, 150.0)}
    assert choose("washer", light, tol=0.01).fidelity == "field"
    assert choose("washer", BOX, tol=0.01).fidelity == "fine"


def test_a_negative_speed_counts_by_its_size(ladder):
    ladder(card("field", [[1e-3, 0.5], [1e-3, 0.5]]), card("fine", 1e-4, 2e-3))
    slow = {**BOX, "speed": (-200.0, -100.0)}
    assert choose("washer", slow, tol=0.01).fidelity == "field"
    assert choose("washer", {**BOX, "speed": (-600.0, -100.0)}, tol=0.01).fidelity == "fine"


def test_nothing_fits_names_the_best_and_what_to_do(ladder):
    with pytest.raises(SolveError) as refusal:
        choose("washer", BOX, tol=1e-6)
    assert str(refusal.value) == (
        "washer: no rung reaches 1e-06 in friction_torque; the best is fine with 0.0006. Ask for "
        "less, or verify a finer one: python -m thrustwasher.study.verify washer fine"
    )


def test_one_stale_chart_takes_the_whole_rung_out(ladder):
    old = replace(card("field", chart="film"), kernels=replace(LADDER[2].kernels, sha256="0" * 64))
    ladder(LADDER[1], old, card("field", chart="contact"))
    assert choose("washer", BOX, tol=0.02).fidelity == "fine"


def test_a_broken_card_is_named(ladder):
    ladder(LADDER[1], refused={"washer-field.json": "washer-field.json: key 'cost' is missing"})
    assert "field: its card is broken: washer-field.json: key 'cost'" in str(
        choose("washer", BOX, tol=0.02)
    )


def test_building_pays_with_enough_calls(ladder):
    ladder(LADDER[2], card("map", 1e-3, 2e-6, first=0.0, build=10.0))
    assert choose("washer", BOX, tol=0.02, n_calls=1).fidelity == "field"
    assert choose("washer", BOX, tol=0.02, n_calls=1e6).fidelity == "map"
    choice = choose("washer", BOX, tol=0.02, n_calls=1e6)
    assert choice.seconds == pytest.approx(10.0 + 2.0)


def test_compiling_counts_as_time(ladder):
    ladder(card("field", first=5.0), card("fine", 4e-4, 2e-3, first=0.0))
    assert choose("washer", BOX, tol=0.02).fidelity == "fine"
    assert choose("washer", BOX, tol=0.02, n_calls=1e5).fidelity == "field"


def test_within_their_spreads_the_more_accurate_wins(ladder):
    ladder(
        card("coarse", 9e-3, 1.0e-4, iqr=2e-5, first=0.0),
        card("field", 5e-3, 1.1e-4, iqr=2e-5, first=0.0),
    )
    assert choose("washer", BOX, tol=0.02).fidelity == "field"
    ladder(
        card("coarse", 9e-3, 1.0e-4, iqr=1e-6, first=0.0),
        card("field", 5e-3, 1.1e-4, iqr=9e-4, first=0.0),
    )
    assert choose("washer", BOX, tol=0.02).fidelity == "coarse"
    ladder(
        card("coarse", 9e-3, 1.0e-4, iqr=5e-6, first=0.0),
        card("field", 5e-3, 1.1e-4, iqr=5e-6, first=0.0),
    )
    assert choose("washer", BOX, tol=0.02).fidelity == "coarse"


def test_a_box_partly_outside_gets_two_rungs_and_the_share(ladder):
    small = {**ENVELOPE, "load": Axis(20.0, 200.0, "N", "log")}
    ladder(
        card("map", 1e-3, 2e-6, first=0.0, envelope=small, edges=((20.0, 200.0), (50.0, 1400.0))),
        LADDER[2],
    )
    box = {**BOX, "load": (20.0, 2000.0)}
    choice = choose("washer", box, tol=0.02)
    assert (choice.fidelity, choice.outside.fidelity) == ("map", "field")
    assert choice.outside.share == pytest.approx(0.5)
    assert choice.outside.error == pytest.approx(7.5e-3)
    assert choice.is_verified
    assert "outside it (50 % of the box, load above 200 N): field, within 0.75 %" in str(choice)


def test_points_that_a_rung_refuses_go_to_the_next_one(ladder):
    ladder(card("map", 1e-3, 2e-6, first=0.0, outside=25), LADDER[2])
    choice = choose("washer", BOX, tol=0.02)
    assert (choice.fidelity, choice.outside.fidelity) == ("map", "field")
    assert choice.outside.share == pytest.approx(0.25)
    assert "where map itself says it is outside" in str(choice)


def test_the_second_rung_holds_the_tolerance_too(ladder):
    ladder(card("map", 1e-4, 2e-6, first=0.0, outside=25), *LADDER)
    assert choose("washer", BOX, tol=1e-3).outside.fidelity == "fine"
    assert choose("washer", BOX, tol=2.0).fidelity == "coarse"


def test_where_no_card_speaks_there_is_no_promise(ladder):
    choice = choose("washer", {**BOX, "load": (10.0, 1000.0)}, tol=0.02)
    assert choice.fidelity == "field"
    assert math.isinf(choice.outside.error)
    assert not choice.is_verified
    assert "no card speaks there" in str(choice)


def test_where_no_card_speaks_the_default_serves_or_a_finer_rung(ladder):
    box = {**BOX, "load": (10.0, 1000.0)}
    for tol, inside, outside in ((2.0, "coarse", "field"), (0.02, "field", "field"),
                                 (1e-3, "fine", "fine")):  # fmt: skip
        choice = choose("washer", box, tol=tol)
        assert (choice.fidelity, choice.outside.fidelity) == (inside, outside)


def test_a_rung_verified_everywhere_comes_before_a_cheaper_one_that_is_not(ladder):
    small = {**ENVELOPE, "tilt": Axis(1.9e-3, 2.1e-3, "rad", "log")}
    ladder(card("coarse", 1e-3, 1e-5, first=0.0, envelope=small, outside=25), LADDER[1])
    wide = {**BOX, "tilt": (1e-3, 3e-3)}
    assert choose("washer", wide, tol=0.02).is_verified


def test_a_box_outside_every_card_is_refused_with_the_envelope(ladder):
    with pytest.raises(SolveError, match=r"load 20 .. 2000 N"):
        choose("washer", {**BOX, "load": (5000.0, 6000.0)}, tol=0.02)


def test_a_box_that_touches_with_its_face_is_outside(ladder):
    with pytest.raises(SolveError, match="outside what was verified"):
        choose("washer", {**BOX, "load": (2000.0, 3000.0)}, tol=0.02)


def test_a_point_on_the_border_is_inside(ladder):
    assert choose("washer", {**BOX, "load": 2000.0}, tol=0.02).is_verified


def test_an_empty_cell_is_not_verified(ladder):
    ladder(card("coarse", None, 1e-6, n=0), LADDER[2])
    choice = choose("washer", BOX, tol=0.02)
    assert choice.fidelity == "field"
    assert "not verified in this box: coarse" in str(choice)


def test_the_worst_chart_speaks_for_the_rung(ladder):
    ladder(
        card("coarse", 1e-3, 1e-6, first=0.0, chart="film", branch="film"),
        card("coarse", 0.2, 1e-6, first=0.0, chart="contact", branch="contact"),
        LADDER[2],
    )
    assert choose("washer", BOX, tol=0.02).fidelity == "field"
    assert choose("washer", BOX, tol=0.4).fidelity == "coarse"
    assert "coarse (contact and film charts)" in str(choose("washer", BOX, tol=0.4))


def test_an_absolute_quantity_has_its_unit(ladder):
    choice = choose("washer", BOX, quantity="temperature", tol=0.5)
    assert choice.error == pytest.approx(0.15)
    assert "temperature within 0.15 K (asked 0.5 K)" in str(choice)
    with pytest.raises(SolveError, match=r"reaches 0.001 K .* with 0.15 K"):
        choose("washer", BOX, quantity="temperature", tol=1e-3)


def test_errors_beside_folds_are_said(ladder):
    beside = Fold(0.05, 12, 3, {"friction_torque": 0.04})
    ladder(replace(LADDER[2], fold=beside))
    assert "within 5 % of a fold's load: 6 %" in str(choose("washer", BOX, tol=0.02))


def test_reasons_name_every_rung(ladder):
    lines = str(choose("washer", BOX, tol=0.02)).splitlines()
    assert lines[0] == "washer: field, friction_torque within 0.75 % (asked 2 %), 200 µs per call"
    assert "  cheaper but too coarse: coarse 150 %" in lines
    assert "  would hold too: fine 0.06 % in 2 ms" in lines


def test_among_limits_the_choice(ladder):
    assert choose("washer", BOX, tol=2.0, among=["field", "fine"]).fidelity == "field"
    with pytest.raises(ParameterError, match="among: 'finest', allowed"):
        choose("washer", BOX, tol=2.0, among=["finest"])
    with pytest.raises(ParameterError, match="among: no rung"):
        choose("washer", BOX, tol=2.0, among=[])


def test_the_same_cards_give_the_same_answer_in_any_order(ladder):
    first = choose("washer", BOX, tol=0.02)
    ladder(*reversed(LADDER))
    assert choose("washer", BOX, tol=0.02) == first


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"tol": 0.0}, "tol = 0.0, allowed: above 0"),
        ({"tol": math.nan}, "tol = nan"),
        ({"tol": "1 %"}, "tol = '1 %'"),
        ({"n_calls": 0}, "n_calls = 0, allowed: 1 or more"),
        ({"safety": 0.5}, "safety = 0.5, allowed: 1 or more"),
        ({"quantity": "noise"}, "quantity = 'noise', allowed: friction_torque"),
        ({"box": {**BOX, "load": (2.0, 1.0)}}, "load = .2.0, 1.0. N, allowed: low <= high"),
        ({"box": {**BOX, "load": (1.0, math.inf)}}, "both finite"),
        ({"box": {**BOX, "load": (1.0, 1e9)}}, "load = 1 .. 1e.09 N, allowed: 0 .. 10000 N"),
        ({"box": {**BOX, "load": "much"}}, "load = 'much'"),
        ({"box": {**BOX, "colour": (0, 1)}}, "'colour' is no input"),
        ({"box": {"load": (1, 2)}}, "speed .rad/s. is missing"),
        ({"model": "wheel"}, "model = 'wheel', allowed: 'washer'"),
        ({"params": object()}, "params: object, allowed: .*Params"),
    ],
)
def test_wrong_requests_are_named(ladder, changed, said):
    request = {"model": "washer", "box": BOX, "tol": 0.02, **changed}
    with pytest.raises(ParameterError, match=said):
        choose(request.pop("model"), request.pop("box"), **request)


def test_it_is_a_public_name():
    assert thrustwasher.choose is choose
