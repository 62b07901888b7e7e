"""``thrustwasher fidelity`` and ``--fidelity auto:TOL`` as typed."""

import json

import pytest
from synthetic import level, put

from thrustwasher.cli import main
from thrustwasher.ladder import error_table

WASHER = ["washer", "--load", "100", "--speed", "500"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    put(tmp_path, monkeypatch, level("field", 5e-3), level("fine", 4e-4))
    yield tmp_path
    error_table.forget()


def test_cards_lists_errors_costs_and_the_box(capsys):
    assert main(["fidelity", "washer"]) == 0
    out = capsys.readouterr().out
    assert "load 20 N .. 2 kN" in out
    assert "0.5 %" in out and "200 µs" in out and "of this version" in out


def test_cards_names_stale_levels_and_broken_files(folder, monkeypatch, capsys):
    put(folder, monkeypatch, level("fine", 4e-4, sources="0" * 64))
    (folder / "mesh.json").write_text("{")
    assert main(["fidelity"]) == 0
    out = capsys.readouterr().out
    assert "renew it: python -m lab.verify washer" in out
    assert "clutch: no verification tables; make them" in out and "mesh.json: refused" in out


def test_cards_as_json(capsys):
    assert main(["fidelity", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    names = {c["name"]: c for c in found["tables"]}
    assert set(names) == {"washer-field", "washer-fine"} and found["refused"] == {}
    field = names["washer-field"]
    assert field["stale"] is None
    assert field["worst"]["friction_torque"] == 5e-3
    assert field["envelope"]["load"] == [20.0, 2000.0, "N"]


def test_auto_takes_the_first_level_that_holds_says_why_and_gives_up_at_the_last(capsys):
    for wish, level_taken, said in (
        (
            "auto:0.01",
            "field",
            "field, friction_torque within 0.15 % at this point (requested 1 %)",
        ),
        ("auto:0.001", "fine", "too coarse: field, 0.15 %"),
    ):
        assert main([*WASHER, "--fidelity", wish, "--json"]) == 0
        seen = capsys.readouterr()
        assert json.loads(seen.out)["fidelity"] == level_taken and said in seen.err
    assert main([*WASHER, "--fidelity", "auto:0.0001"]) == 3
    assert "the best is fine" in capsys.readouterr().err


def test_auto_of_other_parameters_is_compared_with_the_level_above(capsys):
    own = ["--set", "dry_friction=0.2", "--json"]
    assert main([*WASHER, "--fidelity", "auto:0.05", *own]) == 0
    seen = capsys.readouterr()
    assert json.loads(seen.out)["fidelity"] == "field"
    assert "no table of errors speaks here; there it is" in seen.err


@pytest.mark.parametrize("wish", ["auto:", "auto:much", "auto:-1", "best"])
def test_a_wrong_wish_is_refused(wish, capsys):
    assert main([*WASHER, "--fidelity", wish]) == 2
    assert "fidelity" in capsys.readouterr().err
