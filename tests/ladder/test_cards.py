"""Cards are read strictly, speak for their own kernels and parameters, and never stop a solve."""

import json
from dataclasses import replace

import pytest
from synthetic import BOX, ENVELOPE, card, errors

from thrustwasher import ParameterError, WasherParams, solve_washer
from thrustwasher.ladder import card as cards
from thrustwasher.ladder.card import files_of
from thrustwasher.ladder.card_parts import ByFilmRatio, Cells
from thrustwasher.storage import digests

POINT = {"load": 100.0, "speed": 500.0, "tilt": 2e-3, "oil_temperature": 300.0}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of own cards; the package's are out of sight."""
    monkeypatch.setattr(cards, "card_folders", lambda: [tmp_path])
    cards.forget()
    yield tmp_path
    cards.forget()


def test_a_card_comes_back_from_its_file_as_it_was(tmp_path):
    made = card(chart="film", branch="film")
    (tmp_path / "x.json").write_text(made.as_json())
    assert cards.read_card(tmp_path / "x.json") == made


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (lambda c: c.pop("cost"), "'cost'"),
        (lambda c: c.update(colour="red"), "'colour'"),
        (lambda c: c["cost"].pop("build_s"), "'build_s'"),
        (lambda c: c.update(errors=[1.0]), "no attribute"),
        (lambda c: c.update(schema=3), "schema = 3"),
    ],
)
def test_a_card_of_another_version_is_refused_with_file_and_key(tmp_path, edit, said):
    raw = json.loads(card().as_json())
    edit(raw)
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(digests.sealed(raw)))
    with pytest.raises(ParameterError, match=r"bad\.json") as refusal:
        cards.read_card(path)
    assert said in str(refusal.value)


def test_a_card_that_was_changed_since_it_was_written_is_refused(tmp_path):
    text = card().as_json()
    path = tmp_path / "bad.json"
    for before, after in (("0.005", "0.004"), ('"linear"', '"log"'), ('"check"', '"other"')):
        path.write_text(text.replace(before, after, 1))
        assert path.read_text() != text
        with pytest.raises(ParameterError, match=r"bad\.json: was changed since it was written"):
            cards.read_card(path)


def test_broken_files_are_refused_with_a_reason_and_the_others_are_read(folder):
    (folder / "washer-field.json").write_text(card().as_json())
    (folder / "washer-fine.json").write_text("{ not JSON")
    (folder / "washer-coarse.json").write_bytes(b"\xff\xfe\x00")
    assert [c.fidelity for c in cards.load_cards("washer")] == ["field"]
    assert set(cards.refused_files()) == {"washer-fine.json", "washer-coarse.json"}
    assert cards.error_estimate("washer", "field", WasherParams(), POINT) == 1.5 * 5e-3
    assert cards.error_estimate("washer", "fine", WasherParams(), POINT) is None


def test_a_card_for_other_parameters_does_not_speak(folder):
    (folder / "washer-field.json").write_text(card().as_json())
    other = replace(WasherParams(), dry_friction=0.2)
    assert cards.load_cards("washer", other) == []
    assert cards.error_estimate("washer", "field", other, POINT) is None
    assert "other parameters" in card().stale(other)


def test_a_card_for_other_kernels_is_stale_and_says_how_to_renew(folder):
    old = replace(card(), kernels=replace(card().kernels, sha256="0" * 64))
    assert "python -m thrustwasher.study.verify washer field" in old.stale(WasherParams())
    (folder / "washer-field.json").write_text(old.as_json())
    assert cards.error_estimate("washer", "field", WasherParams(), POINT) is None


def test_a_card_whose_list_of_files_is_not_the_closure_is_stale():
    files = card().kernels.files[1:]
    short = digests.kernel_digest(files)
    assert card(kernels=replace(card().kernels, files=files, sha256=short)).stale()


def test_a_card_whose_map_has_gone_is_stale():
    assert "maps/x.twm" in card(built=True).stale()


def test_a_fresh_card_is_not_stale():
    assert card().stale(WasherParams()) is None


def test_only_what_a_rung_imports_makes_its_card_stale():
    files = {f.removeprefix("thrustwasher.") for f in files_of("washer", "field")}
    wanted = {"washer.kernels.newton", "washer.kernels.step", "tribology.asperities"}
    assert wanted | {"numerics.banded"} <= files
    assert not {f for f in files if f.startswith(("clutch", "gearmesh", "transmission"))}


def test_equal_parameters_have_equal_digests():
    one, other = WasherParams(dry_friction=0.15), WasherParams()
    assert digests.params_digest(one) == digests.params_digest(other)
    assert digests.params_digest(replace(one, dry_friction=0.16)) != digests.params_digest(other)


def test_the_error_is_that_of_the_cell_and_none_outside():
    made = card(worst=[[1e-3, 2e-3], [3e-3, 4e-3]])
    assert made.error_of("friction_torque", POINT) == 2e-3
    assert made.error_of("friction_torque", {**POINT, "speed": -500.0}) == 2e-3
    assert made.error_of("friction_torque", {**POINT, "load": 2000.0}) == 4e-3
    assert made.error_of("friction_torque", {**POINT, "load": 19.0}) is None
    assert made.error_of("friction_torque", {**POINT, "tilt": 4e-3}) is None
    assert made.error_of("heat", POINT) is None


def test_the_film_ratio_of_a_result_narrows_its_cells_error_but_never_widens_it():
    alike = ByFilmRatio((3.0, 5.0), (30, 30, 30), {"friction_torque": (1e-4, 8e-3, 2e-4)})
    made = card(worst=2e-3, by_film_ratio=alike)
    expected = {1.0: 1e-4, 3.0: 2e-3, 4.9: 2e-3, 5.0: 2e-4, 1e9: 2e-4, None: 2e-3}
    for ratio, worst in expected.items():
        assert made.error_of("friction_torque", POINT, ratio) == worst
    assert made.error_of("temperature", POINT, 1.0) == 0.1
    assert made.error_of("friction_torque", {**POINT, "load": 19.0}, 1.0) is None


def test_a_cell_with_few_points_takes_the_worst_of_its_neighbours():
    few = errors([[1e-3, 2e-3], [3e-3, 9e-3]], n=[[29, 75], [75, 75]])
    made = card(errors={"friction_torque": few})
    assert made.error_of("friction_torque", {**POINT, "speed": 60.0}) == 9e-3
    assert made.error_of("friction_torque", POINT) == 2e-3


def test_a_cell_without_points_near_it_promises_nothing():
    made = card(worst=None, n=0)
    assert made.error_of("friction_torque", POINT) is None


def test_an_estimate_is_never_below_the_uncertainty_of_the_reference(folder):
    (folder / "washer-field.json").write_text(card(worst=1e-6, uncertainty=1e-4).as_json())
    found = cards.error_estimate("washer", "field", WasherParams(), POINT)
    assert found == pytest.approx(1.5e-4)


def test_a_branch_asks_its_own_card(folder):
    for branch, worst in (("film", 1e-3), ("contact", 4e-3)):
        made = card(chart=branch, branch=branch, worst=worst)
        (folder / f"{made.name}.json").write_text(made.as_json())
    params = WasherParams()
    assert cards.error_estimate("washer", "field", params, POINT, branch="film") == 1.5e-3
    assert cards.error_estimate("washer", "field", params, POINT, branch="contact") == 6e-3
    assert cards.error_estimate("washer", "field", params, POINT) == 6e-3


def test_cells_touched_by_an_interval():
    cells = Cells(("load", "speed"), ((1.0, 2.0, 4.0), (0.0, 1.0)), ((0,), (0,)))
    assert list(cells.touched(0, 1.0, 1.5)) == [0]
    assert list(cells.touched(0, 1.0, 2.0)) == [0]
    assert list(cells.touched(0, 2.0, 2.0)) == [0, 1]
    assert list(cells.touched(0, 1.9, 2.1)) == [0, 1]
    assert list(cells.touched(0, 5.0, 6.0)) == []


def test_the_box_of_the_other_tests_lies_inside_their_envelope():
    assert all(ENVELOPE[k].min <= lo <= hi <= ENVELOPE[k].max for k, (lo, hi) in BOX.items())


# what a washer's result says of its own error


@pytest.fixture
def branches(folder):
    for branch, worst in (("film", 1e-3), ("contact", 4e-2)):
        made = card("field", worst, chart=branch, branch=branch)
        (folder / f"{made.name}.json").write_text(made.as_json())


def estimate(**changed):
    at = {"load": 300.0, "speed": 953.0, "tilt": 2e-3, **changed}
    return solve_washer(WasherParams(), **at).error_estimate


def test_the_card_of_the_branch_speaks_whatever_the_sign_of_the_speed(branches):
    assert estimate() == estimate(speed=-953.0) == pytest.approx(1.5e-3)
    assert estimate(load=800.0, branch="contact") == pytest.approx(6e-2)


def test_where_no_card_speaks_the_general_bound_holds(branches):
    assert estimate(tilt=3.5e-3) is None
    assert estimate(load=19.0) is None
    assert estimate(fidelity="fine") is None


def test_a_mesh_of_ones_own_has_its_embedded_estimate(branches):
    assert estimate(grid=(9, 32)) not in (None, pytest.approx(1.5e-3))
    assert estimate(grid=(6, 12)) is None
