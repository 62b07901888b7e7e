"""A card that was made for other kernels or other parameters.

Hazard: a promise outlives what it was made for. Numbers are still looked up, look as good as new,
    and speak for a solver that is gone.
Formula: a card holds if the digests of its kernels and parameters are those that run now.
Cure: a stale card is not taken: by the chooser it is refused in words, with the command that
    renews it; an error estimate falls back to the rung's general bound, which is larger.
"""

from dataclasses import replace

import pytest

from thrustwasher import SolveError, WasherParams, choose, solve_washer
from thrustwasher.ladder import card as cards
from thrustwasher.ladder.card import files_of
from thrustwasher.storage import digests

POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
BOX = {"load": (200.0, 400.0), "speed": (400.0, 600.0), "tilt": (2e-3, 2e-3),
       "oil_temperature": (300.0, 310.0)}  # fmt: skip
RENEW = "python -m thrustwasher.study.verify washer"


def here(card):
    """Return a card as if it had just been made, with the kernels and parameters that run now."""
    files = files_of("washer", card.fidelity)
    others = tuple(f for f in card.kernels.files if "/" in f)  # of data
    return replace(
        card, kernels=replace(card.kernels, files=(*files, *others),
                              sha256=digests.kernel_digest((*files, *others))),
        params=replace(card.params, sha256=digests.params_digest(WasherParams())),
    )  # fmt: skip


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with fresh cards of the default washer; the package's own are out of sight."""
    shipped = [c for c in cards.load_cards("washer") if c.params.name == "default"]
    for card in shipped:
        (tmp_path / f"{card.name}.json").write_text(here(card).as_json())
    monkeypatch.setattr(cards, "card_folders", lambda: [tmp_path])
    cards.forget()
    yield tmp_path
    cards.forget()


@pytest.fixture
def stale(folder):
    """The same cards, as if kernels had been edited since."""
    for card in cards.load_cards("washer"):
        old = replace(card, kernels=replace(card.kernels, sha256="0" * 64))
        (folder / f"{card.name}.json").write_text(old.as_json())
    cards.forget()


def test_fresh_cards_choose_and_estimate(folder):
    assert choose("washer", BOX, tol=0.01).error <= 0.01
    assert solve_washer(WasherParams(), **POINT).error_estimate < 0.01


def test_nothing_is_chosen_from_stale_cards_and_the_command_is_named(stale):
    with pytest.raises(SolveError, match=RENEW):
        choose("washer", BOX, tol=0.01)


def test_one_stale_rung_is_passed_over_and_the_next_one_serves(folder):
    first = choose("washer", BOX, tol=0.01).fidelity
    for card in cards.load_cards("washer"):
        if card.fidelity == first:
            old = replace(card, kernels=replace(card.kernels, sha256="0" * 64))
            (folder / f"{card.name}.json").write_text(old.as_json())
    cards.forget()
    second = choose("washer", BOX, tol=0.01)
    assert second.fidelity != first
    assert any(f"{RENEW} {first}" in why for why in second.reasons)


def test_estimates_do_not_come_from_stale_cards(stale):
    assert solve_washer(WasherParams(), **POINT).error_estimate is None


def test_a_card_of_other_parameters_is_not_stretched_over_these(folder):
    other = WasherParams(heat_split=0.3)
    assert solve_washer(other, **POINT).error_estimate is None
    with pytest.raises(SolveError, match="no card for these parameters"):
        choose("washer", BOX, tol=0.01, params=other)
