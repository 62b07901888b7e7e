"""One FMU from a part or a model: where it lies, and what is refused."""

from zipfile import ZipFile

import needed
import pytest

from thrustwasher import ParameterError, build_fmu, load_part

PART = 'model = "gearmesh"\nname = "MyPair"\n[parameters]\npinion_teeth = 23\n'


@pytest.fixture
def part(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(PART)
    return file


def named(path):
    with ZipFile(path) as fmu:
        return f'modelName="{path.stem}"' in fmu.read("modelDescription.xml").decode()


def test_a_model_goes_to_a_folder_under_its_name(tmp_path):
    needed.linker()
    path = build_fmu("gearmesh", tmp_path / "new", platforms=["linux64"])
    assert path == tmp_path / "new" / "GearMesh.fmu" and named(path)
    assert build_fmu("GearMesh", str(tmp_path / "new"), platforms=["linux64"]) == path


def test_a_part_is_built_from_its_file_or_itself_the_same(part, tmp_path):
    needed.linker()
    made = (part, str(part), load_part(part))
    paths = [build_fmu(one, tmp_path / str(i), platforms=["linux64"]) for i, one in enumerate(made)]
    assert [path.name for path in paths] == 3 * ["MyPair.fmu"] and all(map(named, paths))
    assert len({path.read_bytes() for path in paths}) == 1


def test_the_file_may_be_named(part, tmp_path):
    needed.linker()
    path = build_fmu(part, tmp_path / "other.fmu", fmi=3, platforms=["linux64"])
    with ZipFile(path) as fmu:
        assert 'fmiVersion="3.0"' in fmu.read("modelDescription.xml").decode()
    assert [p.name for p in tmp_path.iterdir() if p != part] == ["other.fmu"]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("washr", "."), "model = 'washr', allowed: ThrustWasher.*did you mean 'washer'"),
        (("none.toml", "."), "part = 'none.toml': cannot be read"),
        ((3, "."), "part_or_model = 3, allowed: the path of a part file"),
        (("washer", ""), "out = '', allowed: the path of an FMU"),
        (("washer", 3), "out = 3, allowed: the path of an FMU"),
        (("washer", __file__), "allowed: the path of an FMU .* or a folder"),
    ],
)
def test_what_is_not_allowed_is_named(given, said):
    with pytest.raises(ParameterError, match=said):
        build_fmu(*given)


def test_versions_and_platforms_are_those_of_build(tmp_path):
    with pytest.raises(ParameterError, match="fmi = 4, allowed: 2 or 3"):
        build_fmu("washer", tmp_path, fmi=4)
    with pytest.raises(ParameterError, match="'amiga'"):
        build_fmu("washer", tmp_path, platforms=["amiga"])
