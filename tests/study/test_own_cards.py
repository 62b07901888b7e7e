"""Cards and maps of one's own parts: made on request or where that pays, kept by digest."""

import pytest

from thrustwasher.cli import main
from thrustwasher.errors import ParameterError
from thrustwasher.ladder import card as cards
from thrustwasher.ladder import own_tables
from thrustwasher.ladder.choose import choose
from thrustwasher.model.registry import spec_of
from thrustwasher.study.own_cards import make_own_cards, own_case
from thrustwasher.washer.parameters import WasherParams

SPEC = spec_of("washer")
OWN = WasherParams(roughness=5.1e-7)
BOX = {"load": (200.0, 400.0), "speed": (520.0, 540.0), "tilt": (0.002, 0.002),
       "oil_temperature": (297.15, 297.15)}  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        cards.forget()
        yield make_own_cards(SPEC, OWN, BOX, points=12, workers=1)
    cards.forget()


def test_every_rung_has_a_fresh_card_in_the_users_cache(made):
    assert {card.fidelity for card in made} == {"map", "field", "fine"}
    for card in made:
        assert card.stale(OWN) is None
        assert (cards.own_folder() / f"washer-{card.params.name}" / f"{card.name}.json").is_file()


def test_choose_takes_the_map_with_its_verified_error(made):
    choice = choose("washer", BOX, tol=0.01, params=OWN, n_calls=1e6)
    assert choice.fidelity == "map" and choice.is_verified and 0.0 < choice.error <= 0.01


def test_a_kept_map_that_covers_the_box_is_not_built_again(made, monkeypatch):
    monkeypatch.setattr(own_tables, "resolve", lambda _: pytest.fail("it went to work"))
    assert own_tables.build_where_it_pays(SPEC, OWN, BOX, tol=0.01, calls=1e9) == ""


def test_for_a_single_point_nothing_is_built(monkeypatch):
    monkeypatch.setattr(own_tables, "resolve", lambda _: pytest.fail("it went to work"))
    other = WasherParams(roughness=5.2e-7)
    assert own_tables.build_where_it_pays(SPEC, other, BOX, tol=0.01, calls=1) == ""


def test_many_calls_are_worth_a_map_and_it_is_said(monkeypatch):
    asked, said = [], []
    monkeypatch.setattr(
        own_tables, "resolve", lambda _: lambda *place, **more: asked.append((place, more))
    )
    other = WasherParams(roughness=5.2e-7)
    words = own_tables.build_where_it_pays(SPEC, other, BOX, tol=0.01, calls=1e6, say=said.append)
    assert len(asked) == 1 and "builds a map" in said[0] and "30 held-out points" in words


@pytest.mark.parametrize(
    ("box", "points", "said"),
    [({"load": (1.0, 2e4)}, 60, "load"), ({"tilt": (0.002, 0.001)}, 60, "tilt"),
     ({}, 3, "points")],
)  # fmt: skip
def test_a_box_outside_the_models_range_is_refused(box, points, said):
    with pytest.raises(ParameterError, match=said):
        own_case(SPEC, OWN, box, points)


def test_a_box_of_light_loads_begins_where_the_model_does():
    assert own_case(SPEC, OWN, {"load": (0.0, 140.0)}, 60).envelope["load"].min == 1.0


def test_a_part_without_rungs_has_no_cards(tmp_path, capsys):
    file = tmp_path / "sump.toml"
    file.write_text('model = "sump"\nname = "Sump"\n')
    assert main(["cards", str(file)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
