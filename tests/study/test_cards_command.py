"""``thrustwasher cards`` and ``--fidelity auto:TOL`` as typed."""

import json

import pytest
from synthetic import card

from thrustwasher.cli import main
from thrustwasher.ladder import card as cards
from thrustwasher.storage.digests import sealed

WASHER = ["washer", "--load", "100", "--speed", "500"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(cards, "card_folders", lambda: [tmp_path])
    cards.forget()
    for made in (card("field", 5e-3, 2e-4), card("fine", 4e-4, 2e-3)):
        (tmp_path / f"{made.name}.json").write_text(made.as_json())
    yield tmp_path
    cards.forget()


def test_cards_lists_errors_costs_and_the_box(folder, capsys):
    assert main(["cards", "washer"]) == 0
    out = capsys.readouterr().out
    assert "load 20 .. 2000 N" in out
    assert "0.5 %" in out and "200 µs" in out and "fresh" in out


def test_cards_names_stale_and_broken_files(folder, capsys):
    raw = json.loads((folder / "washer-fine.json").read_text())
    raw["kernels"]["sha256"] = "0" * 64
    (folder / "washer-fine.json").write_text(json.dumps(sealed(raw)))
    (folder / "washer-coarse.json").write_text("{")
    assert main(["cards"]) == 0
    out = capsys.readouterr().out
    assert "python -m thrustwasher.study.verify washer fine" in out
    assert "washer-coarse.json: refused" in out
    assert "clutch: no cards; make them" in out


def test_cards_as_json(folder, capsys):
    assert main(["cards", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    names = {c["name"]: c for c in found["cards"]}
    assert set(names) == {"washer-field", "washer-fine"} and found["refused"] == {}
    field = names["washer-field"]
    assert field["stale"] is None
    assert field["worst"]["friction_torque"] == 5e-3
    assert field["envelope"]["load"] == [20.0, 2000.0, "N"]


def test_auto_takes_the_cheapest_rung_that_holds_and_says_why(folder, capsys):
    assert main([*WASHER, "--fidelity", "auto:0.01", "--json"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out)["fidelity"] == "field"
    assert "washer: field, friction_torque within 0.75 % (asked 1 %)" in said.err


def test_auto_goes_up_the_ladder_and_then_gives_up(folder, capsys):
    assert main([*WASHER, "--fidelity", "auto:0.001", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["fidelity"] == "fine"
    assert main([*WASHER, "--fidelity", "auto:0.0001"]) == 3
    assert "the best is fine" in capsys.readouterr().err


def test_auto_has_no_card_for_other_parameters(folder, capsys):
    assert main([*WASHER, "--fidelity", "auto", "--set", "dry_friction=0.2"]) == 3
    assert "no card for these parameters" in capsys.readouterr().err


@pytest.mark.parametrize("wish", ["auto:", "auto:much", "auto:-1", "best"])
def test_a_wrong_wish_is_refused(wish, folder, capsys):
    assert main([*WASHER, "--fidelity", wish]) == 2
    assert "fidelity" in capsys.readouterr().err
