"""Table and map of a part of your own: made on request, kept by the digest of parameters."""

import pytest

from thrustwasher.cli import main
from thrustwasher.errors import ParameterError
from thrustwasher.ladder import error_table
from thrustwasher.ladder.choose import choose
from thrustwasher.model.registry import spec_of
from thrustwasher.studio.verification.cases import own_case
from thrustwasher.studio.verification.measure_errors import measure_part
from thrustwasher.washer.parameters import WasherParams

SPEC = spec_of("washer")
OWN = WasherParams(roughness=5.1e-7)
BOX = {
    "load": (200.0, 400.0),
    "speed": (520.0, 540.0),
    "tilt": (0.002, 0.002),
    "oil_temperature": (297.15, 297.15),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        error_table.forget()
        yield measure_part(SPEC, OWN, BOX, points=12, workers=1)
    error_table.forget()


@pytest.mark.slow
def test_every_level_is_measured_and_kept_in_the_users_cache(made):
    assert [level.fidelity for level in made.levels] == ["map", "field", "fine"]
    assert [made.stale(level) for level in made.levels] == [None] * 3
    (file,) = error_table.own_folder().iterdir()
    assert file.name == f"washer-{made.name}.json" and error_table.read_tables(file) == (made,)


@pytest.mark.slow
def test_choose_takes_the_map_with_its_measured_error(made):
    choice = choose("washer", BOX, tol=0.01, params=OWN, n_calls=1e6)
    assert choice.fidelity == "map" and choice.is_verified and 0.0 < choice.error <= 0.01


@pytest.mark.parametrize(
    ("box", "points", "said"),
    [
        ({"load": (1, 2.1e5)}, 60, "load"),
        ({"tilt": (0.002, 0.001)}, 60, "tilt"),
        ({}, 3, "points"),
    ],
)
def test_a_box_outside_the_models_range_is_refused(box, points, said):
    with pytest.raises(ParameterError, match=said):
        own_case(SPEC, OWN, box, points)


def test_a_box_of_light_loads_begins_where_the_model_does():
    assert own_case(SPEC, OWN, {"load": (0.0, 140.0)}, 60).box["load"].min == 1.0


def test_a_part_without_levels_to_choose_from_has_no_table(tmp_path, capsys):
    file = tmp_path / "sump.toml"
    file.write_text('model = "sump"\nname = "Sump"\n')
    assert main(["fidelity", str(file)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
