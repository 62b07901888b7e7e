"""A washer's error_estimate comes from the card of its rung where a fresh one speaks."""

from dataclasses import replace

import pytest
from synthetic import card

from thrustwasher import WasherParams, solve_washer
from thrustwasher.models.washer import ERRORS
from thrustwasher.store import cards

POINT = {"load": 300.0, "speed": 953.0, "tilt": 2e-3}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(cards, "card_folders", lambda: [tmp_path])
    cards.forget()
    for branch, worst in (("film", 1e-3), ("contact", 4e-2)):
        made = card("field", worst, chart=branch, branch=branch)
        (tmp_path / f"{made.name}.json").write_text(made.as_json())
    yield tmp_path
    cards.forget()


def estimate(params=None, **changed):
    return solve_washer(params or WasherParams(), **{**POINT, **changed}).error_estimate


def test_the_card_of_the_branch_speaks(folder):
    assert estimate() == pytest.approx(1.5e-3)
    assert estimate(load=700.0, branch="contact") == pytest.approx(6e-2)


def test_the_sign_of_the_speed_does_not_matter(folder):
    assert estimate(speed=-953.0) == estimate()


def test_outside_the_box_the_general_bound_holds(folder):
    assert estimate(tilt=3.5e-3) == ERRORS["field"]
    assert estimate(load=19.0) == ERRORS["field"]


def test_other_parameters_and_rungs_have_the_general_bound(folder):
    assert estimate(replace(WasherParams(), dry_friction=0.2)) == ERRORS["field"]
    assert estimate(fidelity="fine") == ERRORS["fine"]


def test_a_mesh_of_ones_own_has_its_embedded_estimate(folder):
    assert estimate(grid=(9, 32)) not in (ERRORS["field"], pytest.approx(1.5e-3))


def test_a_stale_or_broken_card_does_not_stop_a_solve(folder):
    for path in folder.iterdir():
        path.write_text("{")
    cards.forget()
    assert estimate() == ERRORS["field"]
