"""What lies in the zip, and that building repeats to the byte."""

import struct
import zipfile

import pytest
from toy.places import TOY_SLAVES
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.build import build
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.package.model_sources import Order, identifier
from thrustwasher.model.registry import all_specs


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
