"""The cards in the package: all there, fresh, plausible, and true at points solved again."""

import itertools

import pytest

from thrustwasher import choose
from thrustwasher.ladder.card import fresh_cards, load_cards, refused_files
from thrustwasher.model.registry import ladder_of
from thrustwasher.storage.digests import DATA
from thrustwasher.study.card_cases import cases
from thrustwasher.study.error_tables import deviation
from thrustwasher.study.reference_cache import answer, source_of
from thrustwasher.study.reference_values import OK
from thrustwasher.study.verify import holds

MODELS = ("washer", "clutch", "gearmesh")
CASES = [case for model in MODELS for case in cases(model)]
CARDS = [card for model in MODELS for card in load_cards(model)]
AGAIN = (3, 211)  # points solved again, of every card
SEVERAL = "thrustwasher cards are made by: python -m thrustwasher.study.verify"


def label(item):
    return f"{item.spec.key}-{item.name}"


@pytest.mark.parametrize("case", CASES, ids=label)
def test_every_rung_has_cards(case):
    carded = {c.fidelity for c in load_cards(case.spec.key, case.params)}
    usable = {r for r in ladder_of(case.spec.key).kernels if holds(case.spec, r, case.params)}
    assert carded == usable, SEVERAL


@pytest.mark.parametrize("card", CARDS, ids=lambda c: c.name)
def test_every_card_is_fresh(card):
    assert card.stale() is None


def test_no_file_is_refused_and_each_is_named_as_its_card():
    assert refused_files() == {}
    assert sorted(p.stem for p in (DATA / "cards").rglob("*.json")) == sorted(c.name for c in CARDS)


@pytest.mark.parametrize("case", CASES, ids=label)
def test_every_rung_was_tried_at_three_hundred_points_or_more(case):
    for rung in ladder_of(case.spec.key).kernels:
        mine = fresh_cards(case.spec.key, rung, case.params)
        tried = sum(c.held_out.n + c.held_out.failed + c.held_out.outside for c in mine)
        assert tried >= 300 or not mine, rung


@pytest.mark.parametrize("card", CARDS, ids=lambda c: c.name)
def test_a_card_says_what_it_was_made_with(card):
    assert card.cost.call_median_s > 0.0 and card.cost.first_call_s > 0.0
    assert card.reference.routes and card.reference.uncertainty.keys() == card.errors.keys()
    for e in card.errors.values():
        for worst, n in zip(itertools.chain(*e.worst), itertools.chain(*e.n), strict=True):
            assert (worst is None) == (n == 0)


@pytest.mark.parametrize("case", CASES, ids=label)
def test_points_solved_again_err_as_their_card_says(case):
    known = [t for k in AGAIN for t in source_of(case.spec.key).solve(case.params, case.point(k))]
    assert known
    for rung in ladder_of(case.spec.key).kernels:
        cards = {c.chart: c for c in fresh_cards(case.spec.key, rung, case.params)}
        for t in (t for t in known if t.chart in cards and not t.beside_fold):
            card, found = cards[t.chart], answer(case.spec.key, case.params, rung, t)
            if not card.covers(t.point):
                continue  # a map of a part of the box
            for q, e in card.errors.items() if found.verdict == OK else ():
                error = deviation(q, t, found.values[q], e.floor or 0.0)
                assert error <= 1.02 * card.error_of(q, t.point) + 1e-12, (card.name, q, t.point)


@pytest.mark.parametrize("case", CASES, ids=label)
def test_a_coarse_tolerance_can_be_had_over_the_whole_box(case):
    box = {name: (axis.min, axis.max) for name, axis in case.envelope.items()}
    choice = choose(case.spec.key, box, tol=0.1, n_calls=1000, params=case.params)
    assert choice.is_verified and choice.error <= 0.1
