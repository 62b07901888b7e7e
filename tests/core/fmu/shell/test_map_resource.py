"""A native washer reads its map from the folder resources, and says so when it cannot."""

import shutil
import tempfile
from pathlib import Path

import pytest
from built import built_fmu
from shell_runs import needs_linux, putting, run

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.build import build
from thrustwasher.fmu.running import loading
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.fmu.running.loading import unpack
from thrustwasher.fmu.stepper import Instance
from thrustwasher.washer.map.map_build import make_map
from thrustwasher.washer.map.map_file import VARIABLE
from thrustwasher.washer.parameters import SPEC, WasherParams

BOX = {
    "load": (100.0, 1200.0),
    "speed": (500.0, 600.0),
    "tilt": (0.002, 0.002),
    "oil_temperature": (297.15, 297.15),
}
POINT = {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}
MAP = {"fidelity": "map"}
NONE = "no map was made for these parameters"
DISTRESS = [signal.name for signal in SPEC.outputs].index("distress")
each_fmi = pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])


@pytest.fixture(scope="module")
def washer():
    """Return FMI version -> a washer that carries a small map, which this process finds too."""
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        make_map(WasherParams(), Path(folder, "small.twm"), box=BOX, fidelity="field", points=4)
        patch.setenv(VARIABLE, folder)
        yield lambda fmi: built_fmu("ThrustWasher", fmi=fmi, local=True)


def profile():
    """Return inputs up over the fold, back, and out of the box."""
    loads = [300.0 + 15.0 * k for k in range(55)] + [1125.0 - 15.0 * k for k in range(55)]
    return [
        [load, 545.0 + 0.1 * k, 0.002, 297.15, 0.0] for k, load in enumerate([*loads, 95.0, 300.0])
    ]


@each_fmi
def test_it_gives_the_bits_of_the_kernels_in_python(washer, fmi):
    ours = DirectInstance(SPEC, parameters=MAP)
    with Instance(washer(fmi), parameters=MAP) as theirs:
        for instance in (ours, theirs):
            instance.initialize(0.0, POINT)
        lost = 0.0
        for k, inputs in enumerate(profile()):
            for instance in (ours, theirs):
                instance.set_inputs(inputs)
                instance.step(1e-3 * k, 1e-3)
            assert ours.outputs() == theirs.outputs()
            lost += ours.outputs()[DISTRESS]
        assert 20 < lost < 80  # the fold was passed and passed back


@each_fmi
def test_its_derivatives_are_those_of_the_kernels(washer, fmi):
    ours = DirectInstance(SPEC, parameters=MAP)
    asked = ["friction_torque", "film_thickness"], ["load", "speed"], [1.0, 0.5]
    with Instance(washer(fmi), parameters=MAP) as theirs:
        for instance in (ours, theirs):
            instance.initialize(0.0, POINT)
        assert theirs.directional_derivative(*asked) == ours.directional_derivative(*asked)


def test_a_state_taken_to_another_instance_brings_the_map_with_it(washer):
    fmu = washer(2)
    with Instance(fmu, parameters=MAP) as first, Instance(fmu, parameters=MAP) as second:
        first.initialize(0.0, POINT)
        first.set_inputs([600.0, 545.0, 0.002, 297.15, 0.0])
        first.step(0.0, 1e-3)
        state = first.get_state()
        data = first.serialize(state)
        assert len(data) < 1_000_000  # the map is no part of it
        second.set_state(second.deserialize(data))
        for instance in (first, second):
            instance.set_inputs([610.0, 545.0, 0.002, 297.15, 0.0])
            instance.step(1e-3, 1e-3)
        assert first.outputs() == second.outputs()


def test_without_maps_the_fmu_is_small_and_refuses_the_fidelity(tmp_path):
    fmu = build(["ThrustWasher"], out=tmp_path, local=True, maps=False)[0]
    assert fmu.stat().st_size <= 600_000
    with pytest.raises((ParameterError, SolveError), match=NONE):
        with Instance(fmu, parameters=MAP) as instance:
            instance.initialize(0.0, POINT)
    with Instance(fmu) as instance:
        instance.initialize(0.0, POINT)
        assert instance.outputs()[0] > 0.0
    with pytest.raises(ParameterError, match="maps lie in native FMUs only"):
        build(["ThrustWasher"], out=tmp_path, target="python", maps=False)


@needs_linux
@each_fmi
def test_with_a_map_the_parameters_it_was_made_for_cannot_be_tuned(washer, fmi):
    folder = unpack(washer(fmi))
    guid = loading.description(folder).guid
    library = next((folder / "binaries").rglob("*.so"))
    level = 1 + list(SPEC.fidelities).index("map")
    for fidelity, refused in ((level, True), (level % len(SPEC.fidelities) + 1, False)):
        script = f"make tuned {guid} 1\n" + putting(SPEC, fidelity=fidelity)
        script += ("setup 0\n" if fmi == 2 else "") + "enter 0\n" + putting(SPEC, **POINT)
        script += "leave\nstep 0 1e-3\n" + putting(SPEC, heat_split=0.8) + "step 1e-3 1e-3\n"
        replies = run(fmi, library, script, resources=folder / "resources")
        problems = [m for r in replies if r.status for m in r.messages]
        assert bool(problems) == refused
        if refused:
            assert problems[0].endswith(
                "heat_split is a fixed parameter with fidelity 'map', made "
                "for one value; it can be set before the initialization "
                "ends"
            )


def moved(fmu, name, tmp_path):
    """Return the FMU packed anew from a folder with a name that needs care."""
    folder = tmp_path / name
    shutil.copytree(unpack(fmu), folder)
    return folder


@pytest.mark.parametrize("change", ["gone", "cut", "rubbish", "bit"])
@pytest.mark.slow
def test_a_map_that_is_gone_or_damaged_is_an_error_with_a_reason(washer, tmp_path, change):
    folder = moved(washer(2), "copy", tmp_path)
    file = folder / "resources" / "map-0.bin"
    gone = change == "gone"
    if gone:
        for map_file in file.parent.glob("map-*.bin"):
            map_file.unlink()
    else:
        raw = file.read_bytes()
        bit = bytes([raw[-400] ^ 1]) + raw[-399:]
        file.write_bytes(
            {"cut": raw[:-40], "rubbish": raw[:-4] + b"\xff\xff\xff\xff", "bit": raw[:-400] + bit}[
                change
            ]
        )
    packed = shutil.make_archive(str(tmp_path / "again"), "zip", folder)
    fmu = shutil.move(packed, tmp_path / "ThrustWasher.fmu")
    said = f"{NONE}.*looked in .*/resources" if gone else "damaged"
    with pytest.raises((ParameterError, SolveError), match=said):
        with Instance(fmu, parameters=MAP) as instance:
            instance.initialize(0.0, POINT)


@pytest.mark.parametrize("name", ["with space", "per%20cent", "mäp 測定", "plus+and#hash"])
def test_any_folder_name_will_do(washer, tmp_path, name):
    folder = moved(washer(2), name, tmp_path)
    told = loading.description(folder)
    place = {v.name: v.valueReference for v in told.modelVariables}
    fmu = loading.instantiate(folder, told, "washer", loading.Messages())
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.setInteger([place["fidelity"]], [1])
    fmu.setReal([place[n] for n in POINT], list(POINT.values()))
    fmu.exitInitializationMode()
    assert fmu.getReal([place["friction_torque"]])[0] == pytest.approx(0.2158, rel=2e-3)
    fmu.terminate()
    fmu.freeInstance()


def test_a_map_has_no_bodies_and_refuses_by_name(washer):
    wrong = {**MAP, "thermal_mode": "transient"}
    for make in (
        lambda: DirectInstance(SPEC, parameters=wrong),
        lambda: Instance(washer(2), parameters=wrong),
    ):
        with pytest.raises((ParameterError, SolveError), match="thermal_mode = transient, allowed"):
            make().initialize(0.0, POINT)
