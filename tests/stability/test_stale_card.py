"""A card that was made for other kernels or other parameters.

Hazard: a promise outlives what it was made for. Numbers are still looked up, look as good as new,
    and speak for a solver that is gone.
Formula: a card holds if the digests of its kernels and parameters are those that run now.
Cure: a stale card is not taken: by the chooser it is refused in words, with the command that
    renews it; an error estimate falls back to the rung's general bound, which is larger.
"""

from dataclasses import replace

import pytest

from thrustwasher import ParameterError, SolveError, WasherParams, choose, solve_washer
from thrustwasher.models.washer import ERRORS
from thrustwasher.store import cards

POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
BOX = {"load": (200.0, 400.0), "speed": (400.0, 600.0), "tilt": (2e-3, 2e-3),
       "oil_temperature": (300.0, 310.0)}  # fmt: skip
RENEW = "python -m thrustwasher.fidelity.verify washer"


@pytest.fixture
def all_stale(tmp_path, monkeypatch):
    """The package's own cards, as if its kernels had been edited since."""
    for old in cards.load_cards("washer"):
        stale = replace(old, kernels=replace(old.kernels, sha256="0" * 64))
        (tmp_path / f"{old.name}.json").write_text(stale.as_json())
    monkeypatch.setattr(cards, "card_folders", lambda: [tmp_path])
    cards.forget()
    yield tmp_path
    cards.forget()


def test_fresh_cards_choose(capsys):
    assert choose("washer", BOX, tol=0.01).fidelity in ("map", "field", "coarse")


def test_nothing_is_chosen_from_stale_cards_and_the_command_is_named(all_stale):
    with pytest.raises(SolveError, match=RENEW) as refusal:
        choose("washer", BOX, tol=0.01)
    assert "0" * 64 not in str(refusal.value)


def test_estimates_do_not_come_from_stale_cards(all_stale):
    r = solve_washer(WasherParams(), **POINT)
    assert r.error_estimate == ERRORS["field"]
    cards.forget()


def test_estimates_come_from_fresh_ones():
    assert solve_washer(WasherParams(), **POINT).error_estimate < ERRORS["field"]


def test_a_card_of_other_parameters_is_not_stretched_over_these():
    other = WasherParams(heat_split=0.3)
    assert solve_washer(other, **POINT).error_estimate == ERRORS["field"]
    with pytest.raises((SolveError, ParameterError), match="card"):
        choose("washer", BOX, tol=0.01, params=other)
