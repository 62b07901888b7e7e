"""Tables are read strictly, speak for their own kernels and parameters, and never stop a solve."""

import json
from dataclasses import replace

import pytest
from synthetic import film_ratios, level, put, table

from thrustwasher import ParameterError, WasherParams, solve_washer
from thrustwasher.ladder import error_table as home
from thrustwasher.ladder.error_table import error_estimate, read_tables, write_tables
from thrustwasher.storage import digests

POINT = {"load": 100.0, "speed": 500.0, "tilt": 2e-3, "oil_temperature": 300.0}
OLD = "0" * 64


@pytest.fixture
def given(tmp_path, monkeypatch):
    """Return a function that puts levels in the place of the shipped tables."""
    yield lambda *levels, **options: put(tmp_path, monkeypatch, *levels, **options)
    home.forget()


def estimate(fidelity="field", params=None, point=POINT, **options):
    return error_estimate("washer", fidelity, params or WasherParams(), point, **options)


def test_tables_come_back_from_their_file_as_they_were(tmp_path):
    made = (table(level(film=1e-3, contact=2e-3)), table(level("fine"), name="other"))
    write_tables(made, tmp_path / "x.json")
    assert read_tables(tmp_path / "x.json") == made


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (lambda r: r["tables"][0].pop("levels"), "'levels'"),
        (lambda r: r["tables"][0].update(colour="red"), "'colour'"),
        (lambda r: r["tables"][0]["levels"][0].pop("call"), "'call'"),
        (lambda r: r["tables"][0].update(levels=[1.0]), "no attribute"),
        (lambda r: r.update(schema=2), "schema = 2"),
    ],
)
def test_a_file_of_another_version_is_refused_with_file_and_key(given, edit, said):
    path = given(level())
    raw = json.loads(path.read_text())
    edit(raw)
    path.write_text(json.dumps(digests.sealed(raw)))
    with pytest.raises(ParameterError, match=r"washer\.json") as refusal:
        read_tables(path)
    assert said in str(refusal.value)


def test_a_file_that_was_changed_since_it_was_written_is_refused(given):
    path = given(level())
    text = path.read_text()
    for before, after in (("0.005", "0.004"), ('"linear"', '"log"'), ('"check"', '"other"')):
        path.write_text(text.replace(before, after, 1))
        assert path.read_text() != text
        with pytest.raises(ParameterError, match=r"was changed since it was written"):
            read_tables(path)


def test_broken_files_are_refused_with_a_reason_and_the_others_are_read(given, tmp_path):
    given(level())
    (tmp_path / "broken.json").write_text("{ not JSON")
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
    assert set(home.refused_files()) == {"broken.json", "bytes.json"}
    assert estimate() == 1.5 * 5e-3
    assert estimate("fine") is None


def test_a_table_speaks_for_its_own_parameters_only(given):
    given(level())
    other = replace(WasherParams(), dry_friction=0.2)
    assert home.load_tables("washer", other) == []
    assert estimate(params=other) is None
    assert digests.params_digest(replace(other, dry_friction=0.15)) == digests.params_digest(
        WasherParams()
    )


@pytest.mark.parametrize(
    ("stale", "said"),
    [({"sources": OLD}, "kernels have changed"), ({"files": ("maps/x.twm",)}, "maps/x.twm")],
)
def test_a_level_for_other_kernels_or_files_is_stale_and_says_how_to_renew(given, stale, said):
    given(level(**stale), level("fine", 1e-3))
    (made,) = home.load_tables("washer")
    assert said in made.stale(made.levels[0]) and made.stale(made.levels[1]) is None
    assert "python -m lab.verify washer" in made.stale(made.levels[0])
    assert estimate() is None and estimate("fine") == 1.5e-3


def test_the_error_is_that_of_the_region_and_none_outside(given):
    given(level("field", [[1e-3, 2e-3], [3e-3, 4e-3]]))
    expected = {
        (100.0, 500.0): 2e-3, (100.0, -500.0): 2e-3, (2000.0, 500.0): 4e-3, (200.0, 60.0): 3e-3,
        (19.0, 500.0): None, (100.0, 1500.0): None,
    }  # fmt: skip
    for (load, speed), worst in expected.items():
        found = estimate(point={**POINT, "load": load, "speed": speed})
        assert found == (worst and pytest.approx(1.5 * worst)), (load, speed)
    assert estimate(point={**POINT, "tilt": 4e-3}) is None
    assert estimate(quantity="temperature") == pytest.approx(0.15)


def test_the_film_ratio_of_a_result_narrows_its_regions_error_but_never_widens_it(given):
    given(level("field", 2e-3, film_ratios(1e-4, 8e-3, 2e-4)))
    expected = {1.0: 1e-4, 3.5: 2e-3, 4.9: 2e-3, 5.1: 2e-4, 1e8: 2e-4, None: 2e-3}
    for ratio, worst in expected.items():
        assert estimate(film_ratio=ratio) == pytest.approx(1.5 * worst)
    assert estimate(film_ratio=1.0, point={**POINT, "load": 19.0}) is None


def test_a_branch_has_its_own_chart_and_a_mesh_asks_its_solution_whatever_the_speeds_sign(given):
    given(level(film=1e-3, contact=4e-2))
    for options, worst in (({"branch": "film"}, 1e-3), ({"branch": "contact"}, 4e-2), ({}, 4e-2)):
        assert estimate(**options) == pytest.approx(1.5 * worst)
    at = {"load": 300.0, "tilt": 2e-3}
    here, back = (solve_washer(WasherParams(), **at, speed=v) for v in (953.0, -953.0))
    assert here.error_estimate == pytest.approx(back.error_estimate)
    assert 0.0 < here.error_estimate != pytest.approx(1.5e-3)  # a mesh knows by itself
    own = solve_washer(WasherParams(), **at, speed=953.0, grid=(9, 32))
    assert own.error_estimate not in (None, pytest.approx(1.5e-3))
    assert solve_washer(WasherParams(), **at, speed=953.0, fidelity="fine").error_estimate is None


def test_what_a_level_imports_makes_it_stale_and_nothing_else():
    from thrustwasher.model.registry import find_model

    files = digests.closure(*find_model("washer").ladder.kernels["field"])
    names = {name.removeprefix("thrustwasher.") for name in files}
    assert {"washer.kernels.newton", "tribology.asperities", "numerics.banded"} <= names
    assert not [n for n in names if n.startswith(("clutch", "gearmesh", "transmission"))]
