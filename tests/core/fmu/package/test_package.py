"""What lies in the zip, and that building repeats to the byte."""

import shutil
import struct
import zipfile
from dataclasses import fields
from types import SimpleNamespace

import pytest
from fmpy import read_model_description
from lxml import etree
from toy.places import TOY_SLAVES
from toy.spec import SPEC as TOY

from thrustwasher import GearMeshParams, load_part
from thrustwasher.errors import ParameterError, SolveError, Status
from thrustwasher.fmu import build as module
from thrustwasher.fmu.build import build, validate
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.documentation.reference_results import FOLDER
from thrustwasher.fmu.package.model_sources import Order, identifier
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.units import exponents
from thrustwasher.washer.map.map_file import SHIPPED, own_folder


def test_building_in_another_process_gives_the_same_bytes(tmp_path, python_toy, run_child):
    code = (
        "import sys; from pathlib import Path; from thrustwasher.fmu.build import build;"
        "build([sys.argv[1]], target='python', out=Path(sys.argv[2]), sources=Path(sys.argv[3]))"
    )
    run_child(code, TOY.key, tmp_path, TOY_SLAVES)
    again = tmp_path / "python-fmi2" / "ToyClutch.fmu"
    assert again.read_bytes() == python_toy.read_bytes()


def test_the_guid_follows_the_content(tmp_path):
    folder, shell = tmp_path / "model", tmp_path / "shell"
    for name in (folder, shell):
        name.mkdir()
        (name / "text.c").write_text("one")

    def guid(target="native", fmi=2, tools="numba 1"):
        order = Order(target, fmi, (), print)
        return identifier(interface(TOY), folder, order, tools, tmp_path)

    first = guid()
    assert first == guid() and len(first) == 32
    found = {first, guid("python"), guid(fmi=3), guid(tools="numba 2")}
    for changed in (folder / "text.c", shell / "text.c", shell / "new.h"):
        changed.write_text("two")
        found.add(guid())
    (shell / "note.log").write_text("not compiled")
    assert guid() in found and len(found) == 7


def test_the_zip_is_sorted_undated_and_has_plain_names(python_toy):
    with zipfile.ZipFile(python_toy) as zipped:
        entries = zipped.infolist()
        assert zipped.testzip() is None
    names = [e.filename for e in entries]
    assert names[0] == "modelDescription.xml"
    assert names[1:] == sorted(names[1:])
    assert {e.date_time for e in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert {e.create_system for e in entries} == {3}
    assert {e.external_attr >> 16 for e in entries} == {0o100644}
    assert {e.compress_type for e in entries} == {zipfile.ZIP_DEFLATED}
    assert all(name.isascii() and "\\" not in name and not name.endswith("/") for name in names)


@pytest.mark.parametrize("name", [s.name for s in all_specs()])
def test_everything_a_user_looks_for_is_inside(name, fmus):
    with zipfile.ZipFile(fmus[name]) as zipped:
        files = {n: zipped.read(n) for n in zipped.namelist()}
    module = files["resources/slavemodule.txt"].decode()
    assert f"resources/{module}.py" in files
    guid = module.rpartition("_")[2]
    assert f'guid="{guid}' in files["modelDescription.xml"].decode()
    assert f"binaries/linux64/{name}.so" in files
    assert "MIT" in files["documentation/licenses/pythonfmu.txt"].decode()
    assert b"thrustwasher authors" in files["documentation/licenses/license.txt"]
    assert b"pip install thrustwasher==" in files["documentation/externalDependencies.txt"]
    page = files["documentation/index.html"].decode()
    assert "<script" not in page and "http" not in page and "Equations" in page
    assert "@" not in files[f"resources/{module}.py"].decode()
    size = struct.unpack(">II", files["model.png"][16:24])
    assert size == (200, 200)
    # FMI Library 3 reads terminals of FMI 2.0 FMUs too, and calls a file of FMI 3.0 fatal.
    assert not [n for n in files if n.startswith("terminalsAndIcons")]


def test_the_icons_of_the_models_differ(fmus):
    pictures = {zipfile.ZipFile(p).open("model.png").read() for p in fmus.values()}
    assert len(pictures) == len(fmus)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"target": "python", "fmi": 3}, "fmi = 3, allowed: 2 for target python; use --target nat"),
        ({"target": "python", "platforms": ["win64"]}, "use --target native"),
        ({"fmi": 1}, "fmi = 1, allowed: 2 or 3"),
        ({"target": "wasm"}, "native or python"),
        ({"models": ["Washer"]}, "allowed: ThrustWasher"),
    ],
)
def test_what_cannot_be_built_is_refused(options, message, tmp_path):
    with pytest.raises(ParameterError, match=message):
        build(out=tmp_path, **options)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_it_is_known_whether_a_model_is_compiled(run_child, tmp_path, monkeypatch):
    code = (
        "from thrustwasher.fmu.model_kernels import is_compiled;"
        "from thrustwasher.model.registry import all_specs;"
        "print([is_compiled(spec) for spec in all_specs()])"
    )
    assert run_child(code) == str([True] * len(all_specs()))  # shipped with the package
    stale = "from thrustwasher.native import shipped; shipped.index = lambda: {'kernels': {}};"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert run_child(stale + code) == str([False] * len(all_specs()))


# The list of variables says what the dataclass and the kernel say.

SPECS = [TOY, *all_specs()]
each_spec = pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.name)


@each_spec
def test_references_count_through_time_inputs_parameters_outputs_late_inputs(spec):
    found = interface(spec).variables
    first, late = ([s.name for s in spec.inputs if s.late == late] for late in (False, True))
    expected = ["time", *first, *(f.name for f in fields(spec.params))]
    expected += ["fidelity", *(s.name for s in spec.outputs), *late]
    assert [v.name for v in found] == expected
    assert [v.reference for v in found] == list(range(len(found)))
    assert len({v.name for v in found}) == len(found)


@each_spec
def test_every_variable_is_described_bounded_and_started_within_its_range(spec):
    for v in interface(spec).variables:
        assert len(v.help.split()) >= 4, v.name
        exponents(v.unit)
        if v.causality in ("input", "parameter"):
            low, high = v.bounds
            assert low <= v.start <= high, v.name


@each_spec
def test_inputs_that_a_host_leaves_open_are_allowed_to_be_zero(spec):
    for v in interface(spec).variables:
        if v.causality == "input" and v.unit != "K":
            assert v.low <= 0.0 <= v.high, v.name


@each_spec
def test_first_outputs_are_the_same_everywhere_and_status_is_complete(spec):
    items = interface(spec).enumerations["SolverStatus"]
    assert {i.name: i.value for i in items} == {s.name: int(s) for s in Status}
    assert all(i.help for i in items)


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("1", {}),
        ("1/m2", {"m": -2}),
        ("m3/s", {"m": 3, "s": -1}),
        ("J/(kg.K)", {"m": 2, "s": -2, "K": -1}),
        ("N.m", {"kg": 1, "m": 2, "s": -2}),
        ("kg.m2", {"kg": 1, "m": 2}),
        ("N.m.s/rad", {"kg": 1, "m": 2, "s": -1, "rad": -1}),
    ],
)
def test_units_in_base_units(unit, expected):
    assert exponents(unit) == expected


def test_an_unknown_unit_is_refused():
    with pytest.raises(ParameterError, match="furlong"):
        exponents("furlong/s")


# The FMU of your own part: its name, its values, its box; the model's libraries.

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
