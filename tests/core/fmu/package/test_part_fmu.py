"""The FMU of your own part: its name, its values, its box; the model's libraries."""

import shutil
import zipfile
from types import SimpleNamespace

import pytest
from fmpy import read_model_description
from lxml import etree

from thrustwasher import GearMeshParams, load_part
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu import build as module
from thrustwasher.fmu.build import build, validate
from thrustwasher.fmu.documentation.reference_results import FOLDER
from thrustwasher.model.registry import find_spec
from thrustwasher.washer.map.map_file import SHIPPED, own_folder

TEXT = """
model = "gearmesh"
name = "MyMesh"
description = "First reduction, ground flanks."
notes = "drawing 4711"
fidelity = "{fidelity}"
[parameters]
face_width = "60 mm"
[box]
load = ["40 N.m", "55 N.m"]
oil_temperature = "80 degC"
"""
LINUX = {"platforms": ["linux64"]}


def file_in(folder, text, name="mine.toml"):
    (folder / name).write_text(text)
    return str(folder / name)


@pytest.fixture(scope="module", params=[2, pytest.param(3, marks=pytest.mark.fmi3)])
def mine(request, tmp_path_factory):
    """FMI version, part, FMU and what lies in it."""
    folder = tmp_path_factory.mktemp("part")
    level = "fine"
    path = file_in(folder, TEXT.format(fidelity=level))
    (fmu,) = build([path], fmi=request.param, out=folder, **LINUX)
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    return SimpleNamespace(
        fmi=request.param, part=load_part(path), fmu=fmu, files=files, level=level
    )


def test_everything_has_the_parts_name(mine):
    told = read_model_description(str(mine.fmu))
    names = told.modelName, told.coSimulation.modelIdentifier, mine.fmu.stem
    assert set(names) == {"MyMesh"}
    assert told.description == "First reduction, ground flanks"
    assert [n for n in mine.files if n.endswith("/MyMesh.so")]
    assert f"{FOLDER}/MyMesh_out.csv" in mine.files
    assert validate(mine.fmu) == []


def test_parameters_start_at_the_parts_values_and_inputs_inside_its_box(mine):
    told = {v.name: v for v in read_model_description(str(mine.fmu)).modelVariables}
    assert float(told["face_width"].start) == 0.06
    assert float(told["oil_temperature"].start) == 353.15
    assert 40.0 <= float(told["load"].start) <= 55.0
    assert float(told["density"].start) == GearMeshParams().density
    items = list(find_spec("gearmesh").fidelities)
    assert items[int(told["fidelity"].start) - 1] == mine.level


def test_the_page_shows_box_notes_and_own_parameters(mine):
    page = mine.files["documentation/index.html"].decode()
    assert "drawing 4711" in page and "A part of the model GearMesh" in page
    assert "<td>load</td><td>40 .. 55 N.m</td>" in page
    assert "<td>oil_temperature</td><td>353.15 .. 353.15 K</td>" in page
    assert f"<td>face_width</td><td>0.06 m</td><td>{GearMeshParams().face_width:g}</td>" in page


def test_the_profile_of_the_reference_run_stays_in_the_box(tmp_path):
    path = file_in(tmp_path, 'model = "washer"\nname = "W"\n[box]\nload = ["400 N", "500 N"]\n')
    model = load_part(path).model
    place = [s.name for s in model.inputs].index("load")
    assert {400.0 <= row[1 + place] <= 500.0 for row in model.profile} == {True}


def test_several_parts_and_models_are_built_at_once(tmp_path):
    files = [
        file_in(tmp_path, f'model = "{m}"\nname = "{n}"\n', f"{n}.toml")
        for m, n in (("sump", "MySump"), ("gearmesh", "Mesh1"), ("gearmesh", "Mesh2"))
    ]
    paths = build([files[0], "CommandSource", *files[1:]], out=tmp_path / "dist", **LINUX)
    assert [p.stem for p in paths] == ["MySump", "CommandSource", "Mesh1", "Mesh2"]
    guids = {
        etree.fromstring(zipfile.ZipFile(p).read("modelDescription.xml")).get("guid") for p in paths
    }
    assert len(guids) == 4


MESH = 'model = "gearmesh"\nname = "{}"\n'
UNMAPPED = 'model = "washer"\nname = "A"\nfidelity = "map"\n[parameters]\nroughness = "0.4 um"\n'


@pytest.mark.parametrize(
    ("texts", "models", "options", "said"),
    [
        ([MESH.format("2nd")], [], {}, "name = '2nd', allowed: letters, digits"),
        ([MESH.format("A") + '[parameters]\nface_width = "3 N"\n'], [], {}, "face_width = '3 N'"),
        ([MESH.format("A"), MESH.format("A")], [], {}, "part1.toml have one name, A"),
        ([MESH.format("GearMesh")], ["GearMesh"], {}, "have one name, GearMesh"),
        ([MESH.format("WetClutch")], [], {}, "name = 'WetClutch' is that of the model 'clutch'"),
        ([MESH.format("A")], [], {"target": "python"}, "for native FMUs only"),
        ([], ["nowhere.toml"], {}, "part = 'nowhere.toml': cannot be read"),
        ([UNMAPPED], [], {}, "fidelity = 'map'"),
    ],
)
def test_what_cannot_be_built_is_one_line_and_writes_nothing(
    texts, models, options, said, tmp_path, monkeypatch
):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))  # no map of an earlier run
    files = [file_in(tmp_path, text, f"part{k}.toml") for k, text in enumerate(texts)]
    with pytest.raises(ParameterError) as caught:
        build([*files, *models], out=tmp_path / "dist", **options)
    assert said in str(caught.value) and "\n" not in str(caught.value)
    assert not (tmp_path / "dist").exists()


def maps_in(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return [name for name in archive.namelist() if name.startswith("resources/map-")]


@pytest.mark.slow
def test_a_model_carries_the_maps_of_the_package_whatever_this_machine_has(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    before = build(["ThrustWasher"], out=tmp_path / "before", **LINUX)[0].read_bytes()
    for folder in (own_folder(), tmp_path / "named"):
        folder.mkdir(parents=True)
        shutil.copy(SHIPPED / "washer-planetary.twm", folder / "another.twm")
    monkeypatch.setenv("THRUSTWASHER_MAPS", str(tmp_path / "named"))
    after = build(["ThrustWasher"], out=tmp_path / "after", **LINUX)[0]
    assert after.read_bytes() == before
    assert len(maps_in(after)) == len(list(SHIPPED.glob("*.twm")))


@pytest.mark.slow
def test_a_part_carries_the_map_of_its_parameters_and_no_other(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    if not maps_in(build(["ThrustWasher"], out=tmp_path, **LINUX)[0]):
        pytest.skip("no map of the default washer is shipped")
    same = file_in(tmp_path, 'model = "washer"\nname = "Same"\n', "same.toml")
    text = 'model = "washer"\nname = "Other"\n[parameters]\nroughness = "0.43 um"\n'
    other = file_in(tmp_path, text, "other.toml")
    carried = [len(maps_in(p)) for p in build([same, other], out=tmp_path, **LINUX)]
    assert carried == [1, 0]


def test_a_part_without_a_solution_on_the_usual_profile_is_built_without_reference_results(
    tmp_path, monkeypatch
):
    def fails(spec):
        raise SolveError("not converged")

    monkeypatch.setattr(module, "reference_files", fails)
    said = []
    path = file_in(tmp_path, MESH.format("Hard"))
    (fmu,) = build([path], out=tmp_path, note=said.append, **LINUX)
    assert said[-1] == "Hard: without reference results: not converged"
    with zipfile.ZipFile(fmu) as archive:
        assert not [name for name in archive.namelist() if name.startswith(FOLDER)]
