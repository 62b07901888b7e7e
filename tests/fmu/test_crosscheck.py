"""The cross-check folder, line by line of its rules; FMUs in it are for Linux and Windows."""

import csv

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.util import read_csv

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.crosscheck import reference, write_cross_check
from thrustwasher.fmu.interface import find_spec
from thrustwasher.fmu.registry import package_version
from thrustwasher.fmu.xml_parts import default_experiment

NAME = "WetClutch"
OTHERS = ["GearMesh", "ShiftTransmission"]
platforms = pytest.mark.platforms


@pytest.fixture(scope="module", params=[2, 3])
def written(request, tmp_path_factory):
    pytest.importorskip("ziglang", reason="pip install ziglang to link for Windows")
    out = tmp_path_factory.mktemp("crosscheck")
    return request.param, out, write_cross_check([NAME], out, request.param)


@platforms
def test_the_folders_are_those_of_the_rules(written):
    fmi, out, places = written
    platforms = ["linux64", "win64"] if fmi == 2 else ["x86_64-linux", "x86_64-windows"]
    assert places == [
        out / "fmus" / f"{fmi}.0" / "cs" / p / "thrustwasher" / package_version() / NAME
        for p in platforms
    ]
    assert [p.name for p in out.iterdir()] == ["fmus"]
    for place in places:
        names = {f"{NAME}{end}" for end in (".fmu", "_ref.csv", "_ref.opt", "_in.csv")}
        assert {p.name for p in place.iterdir()} == {*names, "README.md"}
        text = (place / "README.md").read_text()
        assert package_version() in text and ("wine" in text) == ("win" in place.parts[-4])


@platforms
def test_fmpy_gets_the_reference_within_the_tolerance(written):
    _, _, places = written
    folder = places[0]
    options = dict(csv.reader((folder / f"{NAME}_ref.opt").read_text().splitlines()))
    expected = read_csv(folder / f"{NAME}_ref.csv")
    messages = []
    found = simulate_fmu(
        str(folder / f"{NAME}.fmu"), input=read_csv(folder / f"{NAME}_in.csv"),
        start_time=float(options["StartTime"]), stop_time=float(options["StopTime"]),
        output_interval=float(options["StepSize"]), output=expected.dtype.names[1:],
        logger=lambda *given: messages.append(given),
    )  # fmt: skip
    assert messages == []
    assert found["time"] == pytest.approx(expected["time"], abs=1e-9)
    for name in expected.dtype.names[1:]:
        size = np.abs(expected[name]).max()
        error = np.abs(found[name] - expected[name]).max()
        assert error <= float(options["RelTol"]) * size, name


@platforms
def test_the_options_are_those_of_the_default_experiment(written):
    _, _, places = written
    options = dict(csv.reader((places[0] / f"{NAME}_ref.opt").read_text().splitlines()))
    experiment = read_model_description(str(places[0] / f"{NAME}.fmu")).defaultExperiment
    assert {k: float(v) for k, v in options.items()} == {
        "StartTime": float(experiment.startTime), "StopTime": float(experiment.stopTime),
        "StepSize": float(experiment.stepSize), "RelTol": 1e-6,
    }  # fmt: skip


@pytest.mark.parametrize("name", [NAME, *OTHERS])
def test_the_tables_keep_to_the_rules(name):
    spec = find_spec(name)
    files = reference(spec)
    stop, _ = default_experiment(spec)
    allowed = {s.name for s in spec.outputs}
    for end, names in (("ref", allowed), ("in", {s.name for s in spec.inputs})):
        content = files[f"{name}_{end}.csv"].decode()
        assert len(content) < 1_000_000
        head, *lines = content.splitlines()
        columns = [column.strip('"') for column in head.split(",")]
        assert head.startswith('"time","') and head.count('"') == 2 * len(columns)
        assert len(columns) <= 10 and set(columns[1:]) <= names
        rows = np.array([[float(x) for x in line.split(",")] for line in lines])
        assert (np.diff(rows[:, 0]) > 0).all()
        assert (rows[0, 0], rows[-1, 0]) == (0.0, pytest.approx(stop))
    assert set(files) == {f"{name}{end}" for end in ("_ref.csv", "_ref.opt", "_in.csv")}


def test_an_unknown_version_of_fmi_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="fmi = 1, allowed: 2 or 3"):
        write_cross_check([NAME], tmp_path, 1)
