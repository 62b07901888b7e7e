"""A package from the command line, run by FMPy's own SSP simulator."""

import io
import json
import zipfile
from functools import cache

import pytest
from ssp_master import components, description, run

from thrustwasher.cli import main
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu.shell import platform_libraries
from thrustwasher.fmu.stepper import Instance
from thrustwasher.native import link
from thrustwasher.shift import load_scene

pytest.importorskip("lxml", reason="FMPy reads SSP with lxml")


@pytest.fixture(scope="module", autouse=True)
def no_compiler():
    """No package here needs one."""

    def missing():
        raise EnvironmentProblem("no compiler")

    with pytest.MonkeyPatch.context() as patch:
        for name in ("find_linker", "local_linker"):
            patch.setattr(link, name, missing)
            patch.setattr(platform_libraries, name, missing)
        yield


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """Export a scene by name, once."""

    @cache
    def export(name):
        path = tmp_path_factory.mktemp("ssp") / f"{name}.ssp"
        words = ["shift", "--scene", name, "--ssp", str(path), "--platforms", "local"]
        assert main(words) == 0
        return path

    return export


def simulated(path, scene):
    """Run with what FMPy does by itself: no values handed over, connectors start at zero."""
    from fmpy.ssp.simulation import simulate_ssp

    stop = scene.stop_time - 0.5 * scene.step  # FMPy adds up steps
    return simulate_ssp(
        str(path), start_time=scene.start_time, stop_time=stop, step_size=scene.step
    )


def own(name, tmp_path, capsys):
    capsys.readouterr()
    words = ["shift", "--scene", name, "--master", "jacobi", "--out", str(tmp_path / "r")]
    assert main([*words, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.slow
def test_a_shift_from_rest_is_the_same_in_fmpy(package, tmp_path, capsys):
    """What FMPy sends in its first step does nothing here, so all that follows is equal."""
    path, scene = package("msl"), load_scene("msl")
    assert capsys.readouterr().out == f"{path}\n"
    rows, told = simulated(path, scene), own("msl", tmp_path, capsys)
    assert len(rows) == 5000
    assert rows["lock_time"][-1] == pytest.approx(told["lock_time"], rel=1e-12)
    assert rows["lock_speed"][-1] == pytest.approx(told["lock_speed"], rel=1e-11)
    heat = rows["clutch_heat"][-1]
    assert heat == pytest.approx(told["energy"]["clutch"], rel=1e-11)
    peak = rows["clutch_temperature"].max()
    assert peak == pytest.approx(told["peak_clutch_temperature"], rel=1e-11)


@pytest.mark.slow
def test_a_part_of_ones_own_is_in_the_package_by_its_name_and_runs(tmp_path, capsys):
    (tmp_path / "pack.toml").write_text(
        'model = "clutch"\nname = "MyPack"\ndescription = "Worn pack"\nnotes = "drawing 12"\n'
        'fidelity = "closed"\n[parameters]\nconstant_friction = 0.5\nfriction_scale = 0.9\n'
        "faces = 1\neffective_radius = 2.0\nfilm_dynamics = false\nfriction_temperature_slope = 0\n"
    )
    scene, path = tmp_path / "scene.toml", tmp_path / "own.ssp"
    scene.write_text('base = "msl"\n[clutch]\npart = "pack.toml"\n')
    words = ["shift", "--scene", str(scene), "--ssp", str(path), "--platforms", "local"]
    assert main(words) == 0
    with zipfile.ZipFile(path) as archive:
        inside = zipfile.ZipFile(io.BytesIO(archive.read("resources/clutch.fmu")))
        assert 'description="Worn pack"' in archive.read("SystemStructure.ssd").decode()
        assert "<td>MyPack</td>" in archive.read("documentation/index.html").decode()
    told = inside.read("modelDescription.xml").decode()
    assert 'modelName="MyPack"' in told and 'modelIdentifier="MyPack"' in told
    assert "drawing 12" in inside.read("documentation/index.html").decode()
    rows, ours = simulated(path, load_scene(scene)), own(str(scene), tmp_path, capsys)
    assert rows["lock_time"][-1] == pytest.approx(ours["lock_time"], rel=1e-12)
    assert rows["lock_time"][-1] > 2.115  # 2.111 s with all of its friction
    assert rows["clutch_heat"][-1] == pytest.approx(ours["energy"]["clutch"], rel=1e-11)


@pytest.mark.slow
def test_a_package_of_fmi_3_runs_the_same_shift_as_one_of_fmi_2(tmp_path, capsys):
    scene = tmp_path / "short.toml"
    scene.write_text('base = "brake-test"\nstop_time = 0.3\n')
    ends = []
    for fmi in (2, 3):
        path = tmp_path / f"fmi{fmi}.ssp"
        words = ["shift", "--scene", str(scene), "--ssp", str(path), "--fmi", str(fmi)]
        assert main([*words, "--platforms", "local"]) == 0
        root, instances = description(path), {}
        with zipfile.ZipFile(path) as archive:
            archive.extractall(tmp_path / str(fmi))
            page = archive.read("documentation/index.html").decode()
        assert f"after FMI {fmi}.0" in page
        for name, component in components(root).items():
            instances[name] = Instance(tmp_path / str(fmi) / component.get("source"))
            assert instances[name].description.fmiVersion == f"{fmi}.0"
        ends.append(run(root, instances))
        for instance in instances.values():
            instance.close()
    assert ends[0] == ends[1] and ends[0]["brake.energy"] > 0.0


def test_json_names_the_files(tmp_path, capsys):
    path, cold = tmp_path / "x.ssp", tmp_path / "cold.toml"
    cold.write_text('base = "msl"\noil = "ISO VG 460"\noil_temperature = "-20 degC"\n')
    words = ["shift", "--scene", str(cold), "--ssp", str(path), "--platforms", "local", "--json"]
    assert main(words) == 0
    out, err = capsys.readouterr()
    told = json.loads(out)
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None and sorted(archive.namelist()) == sorted(told["files"])
    parts = [f"resources/{name}.fmu" for name in ("brake", "clutch", "command", "transmission")]
    assert told["ssp"] == str(path) and set(parts) < set(told["files"])
    assert "ISO VG 460 does not flow" in told["warnings"][0]
    assert all(f"warning: {text}" in err for text in told["warnings"])
