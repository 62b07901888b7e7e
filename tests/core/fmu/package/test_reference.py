"""Reference results: FMPy with the files in the FMU gets what the files say."""

import zipfile

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.util import read_csv
from lxml import etree

from thrustwasher.errors import Status
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.documentation.reference_results import FOLDER
from thrustwasher.model.registry import all_specs, find_spec

NAMES = [spec.name for spec in all_specs()]
each_model = pytest.mark.parametrize("name", NAMES)


def unzipped(fmu, folder):
    with zipfile.ZipFile(fmu) as zipped:
        zipped.extractall(folder)
    return folder / FOLDER


def simulated(fmu, **options):
    names = [
        v.name for v in read_model_description(str(fmu)).modelVariables if v.causality == "output"
    ]
    return simulate_fmu(str(fmu), output=names, **options)


@each_model
def test_the_inputs_of_the_reference_run_move_and_no_status_warns(name, fmus, tmp_path):
    folder = unzipped(fmus[name], tmp_path)
    inputs, outputs = (read_csv(folder / f"{name}_{end}.csv") for end in ("in", "out"))
    stop, _ = interface(find_spec(name)).experiment
    assert inputs.dtype.names[1:] == tuple(s.name for s in find_spec(name).inputs)
    assert any(np.ptp(inputs[n]) > 0 for n in inputs.dtype.names[1:])
    assert (inputs["time"][0], inputs["time"][-1]) == (0.0, stop)
    assert (outputs["time"][0], outputs["time"][-1]) == (0.0, pytest.approx(stop))
    deaf = {Status.UNANSWERED} if name == "WetClutch" else set()  # its slip is prescribed
    assert set(outputs["solver_status"]) == {0, *deaf}


@each_model
def test_the_manifest_names_the_files(name, fmus, tmp_path):
    folder = unzipped(fmus[name], tmp_path)
    root = etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert root.tag == "fmiReferences"
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.get(f"{space}fmi-ls-name") == folder.name
    named = {e.get("source"): e.get("role") for e in root}
    assert named == {f"{name}_in.csv": "testcase", f"{name}_out.csv": "result"}
    assert {p.name for p in folder.iterdir()} == {*named, "fmi-ls-manifest.xml"}


@each_model
@pytest.mark.parametrize("step", [None, 1e-4, 0.1])
@pytest.mark.slow
def test_fmpy_simulates_with_any_step_and_gets_numbers(name, step, fmus, tmp_path):
    options = {} if step is None else {"output_interval": step, "stop_time": max(0.02, 3 * step)}
    if name not in ("ThrustWasher", "OilSump"):  # these cost little and end within seconds
        options.pop("stop_time", None)
    folder = unzipped(fmus[name], tmp_path)
    for driven in ({}, {"input": read_csv(folder / f"{name}_in.csv")}):
        found = simulated(fmus[name], **driven, **options)
        assert len(found) > 3
        for column in found.dtype.names:
            assert np.isfinite(found[column]).all(), column
        assert (found["solver_status"] < 10).all()
