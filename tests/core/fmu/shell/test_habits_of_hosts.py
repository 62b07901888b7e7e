"""What hosts do that no standard foresees, played call by call: the run goes on, and it is told."""

import shutil
from math import isfinite

import pytest
from shell_runs import (
    BEGUN,
    GUID,
    MADE,
    last,
    model_library,
    needs_gcc,
    putting,
    run,
    taking,
    toy_library,
)
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.fmu.shell import c_tables
from thrustwasher.model.registry import all_specs, find_spec

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
TORQUE = taking(["friction_torque", "temperature"])
OIL = taking(["oil_temperature"])
KEPT = (
    "1 toy logStatusWarning ToyClutch at t = {t:g} s: oil_temperature = 0 K, as some hosts set an "
    "input that is not connected: {kept:g} K, its last value, stays; connect it to a constant; "
    "this is said once"
)


@both
def test_zero_kelvin_at_an_open_input_keeps_the_start_value_and_is_told_once(fmi):
    """Zeros to all inputs before the initialization and before each step, as Simulink's import."""
    zeros = putting(load=0.0, speed=0.0, oil_temperature=0.0)
    script = MADE + zeros + "enter 0\n" + zeros + "leave\n"
    script += "".join(f"{zeros}step {i} 1\n" for i in range(3)) + OIL + TORQUE + "end\n"
    replies = run(fmi, toy_library(), script)
    assert {r.status for r in replies} == {0}
    told = [m for r in replies for m in r.messages if "Warning" in m]
    assert told == [KEPT.format(t=0, kept=300)]
    assert replies[-3].values == [300.0] and replies[-2].values[1] == 300.0


@both
def test_zero_kelvin_keeps_the_last_valid_value(fmi):
    at = putting(load=500.0, speed=20.0, oil_temperature=310.0)
    wire, zero = putting(oil_temperature=350.0), putting(oil_temperature=0.0)
    lost = run(fmi, toy_library(), BEGUN + at + wire + f"{zero}step 0 1\n{OIL}{TORQUE}")
    held = run(fmi, toy_library(), BEGUN + at + wire + f"step 0 1\n{OIL}{TORQUE}")
    assert [r.values for r in lost[-2:]] == [r.values for r in held[-2:]]
    assert lost[-2].values == [350.0] and lost[-4].messages == [KEPT.format(t=0, kept=350)]
    after = run(fmi, toy_library(), BEGUN + at + zero + "step 0 1\n" + wire + OIL)
    assert after[-1].values == [350.0]  # and takes the next value


@both
def test_a_call_with_zero_kelvin_and_a_bad_value_takes_over_none(fmi):
    script = BEGUN + putting(load=-1.0, oil_temperature=0.0, speed=5.0) + taking(["load", "speed"])
    *_, put, got = run(fmi, toy_library(), script)
    assert put.status == 3 and got.values == [100.0, 10.0]
    assert not any("0 K" in m for m in put.messages)


def test_every_temperature_that_is_an_input_keeps_its_value_at_zero_kelvin():
    found = 0
    for spec in all_specs():
        direct = DirectInstance(spec)
        direct.initialize()
        for v in interface(spec).inputs:
            if v.unit != "K" or v.relative or v.bounds[0] <= 0.0:
                continue
            found += 1
            direct.core.set([v.reference], [0.0], "Real")
            assert direct.get([v.name]) == [v.start]
            (text,) = direct.core.zeros()
            assert f"{v.name} = 0 K" in text and f"{v.start:g} K, its last value, stays" in text
            direct.core.set([v.reference], [0.0], "Real")
            assert direct.core.zeros() == []
        direct.step(0.0, 1e-3)
    assert found == 7


@both
@pytest.mark.parametrize("spec", all_specs(helpers=True), ids=lambda spec: spec.name)
def test_every_unit_runs_on_zeros_from_any_start_and_mends_each_bad_input(spec, fmi):
    """All inputs at 0 before the initialization and each step; NaN at one after another."""
    shown = interface(spec)
    zero = putting(spec, **{v.name: 0.0 for v in shown.inputs})
    good = putting(spec, **{v.name: v.start for v in shown.inputs})
    read = taking([v.name for v in shown.outputs if v.type == "Real"], spec)
    script = f"make toy {GUID} 1\n{zero}setup -2\nenter -2\n{zero}leave\n"
    script += "".join(f"{zero}step {-2.0 + i * 1e-3!r} 1e-3\n{read}" for i in range(5)) + good
    t = -2.0 + 5e-3
    fine = run(fmi, model_library(spec.key), script)
    for v in shown.inputs:
        script += putting(spec, **{v.name: float("nan")}) + f"step {t!r} 1e-3\n"
        script += putting(spec, **{v.name: v.start})
    replies = run(fmi, model_library(spec.key), script + f"step {t!r} 1e-3\n{read}")
    n = len(shown.inputs)
    assert [r.status for r in replies] == [0] * len(fine) + [3, 3, 0] * n + [0, 0]
    assert all(isfinite(x) for r in replies for x in r.values)


# How a folder of resources goes wrong: FMUSDK's simulator names the folder of the FMU, others none.
def unpacked(tmp_path):
    """Return the toy as hosts unpack FMUs: binaries/linux64/toy.so and resources/part.bin."""
    library = tmp_path / "fmu" / "binaries" / "linux64" / "toy.so"
    resources = tmp_path / "fmu" / "resources"
    library.parent.mkdir(parents=True)
    resources.mkdir()
    shutil.copy(toy_library(), library)
    shutil.copy(toy_library().parent / c_tables.PART, resources)
    return library


WRONG = ["", "-", "file://", "{fmu}", "file://{fmu}/", "{fmu}/binaries", "/nowhere", "%00"]


@both
@pytest.mark.parametrize("folder", WRONG)
def test_a_wrong_folder_of_resources_is_looked_for_beside_the_library_and_told(
    fmi, folder, tmp_path
):
    library = unpacked(tmp_path)
    where = folder.format(fmu=tmp_path / "fmu")
    script = f"make toy {GUID} 0\nenter 0\nleave\n{TORQUE}"
    made, *_, found = run(fmi, library, script, resources=where or "''")
    assert made.status == found.status == 0
    (told,) = made.messages
    assert told.startswith("1 toy logStatusWarning part.bin of ToyClutch is not in the folder")
    assert str(library.parent) in told
    right = run(fmi, library, script, resources=tmp_path / "fmu" / "resources")
    assert right[0].messages == [] and found.values == right[-1].values


@both
def test_another_units_folder_of_resources_is_a_wrong_one(fmi, tmp_path):
    library, other = unpacked(tmp_path), tmp_path / "other"
    other.mkdir()
    (other / c_tables.PART).write_bytes(c_tables.part_file(interface(TOY), "f" * 32))
    (made,) = run(fmi, library, f"make toy {GUID} 0\n", resources=other)
    assert made.status == 0 and len(made.messages) == 1
    (made,) = run(fmi, library, f"make toy {'e' * 32} 0\n", resources=other)
    assert made.status == 3 and "f" * 32 in made.messages[0]  # of the folder that the host named


@both
def test_a_damaged_part_is_not_hidden_by_the_search(fmi, tmp_path):
    library = unpacked(tmp_path)
    part = tmp_path / "fmu" / "resources" / c_tables.PART
    part.write_bytes(part.read_bytes()[:-1])
    (made,) = run(fmi, library, f"make toy {GUID} 0\n", resources=part.parent)
    assert made.status == 3 and "is damaged" in made.messages[0]


@both
def test_a_fixed_parameter_may_be_set_to_the_value_that_it_has_whenever(fmi):
    """As hosts that write all parameters before each run, or each step."""
    own = {"inner_radius": 0.06, "discs": 3, "dry": 1, "law": 2}
    script = MADE + putting(**own) + "enter 0\nleave\n" + putting(**own)
    script += "step 0 1e-3\n" + putting(**own) + "step 1e-3 1e-3\n" + TORQUE
    replies = run(fmi, toy_library(), script)
    assert {r.status for r in replies} == {0}
    reply = last(fmi, BEGUN + putting(discs=3))
    assert reply.status == 3 and "is a fixed parameter" in reply.messages[0]


@pytest.mark.parametrize("spec", all_specs(helpers=True), ids=lambda spec: spec.name)
def test_no_parameter_of_any_unit_complains_of_its_own_value(spec):
    direct = DirectInstance(spec)
    direct.initialize()
    for v in interface(spec).parameters:
        (value,) = direct.get([v.name])
        direct.core.set([v.reference], [value], v.type)
        assert direct.get([v.name]) == [value]


def engaged(step, n=40):
    """Return what a pack is warned of whose load rises in 0.1 s, at equal steps [s]."""
    pack, told = DirectInstance(find_spec("clutch")), []
    pack.initialize(0.0, {"load": 0.0, "speed": 200.0, "oil_temperature": 353.15})
    for i in range(n):
        pack.set_inputs([5000.0 * min(1.0, i * step / 0.1), 180.0, 353.15, 0.0])
        pack.step(i * step, step)
        told += [text for kind, text in pack.core.messages() if kind == "logStatusWarning"]
    return [text for text in told if "advised_step" in text]


def test_steps_that_are_longer_than_advised_are_told_once():
    """FMPy without an output interval makes 8 ms of 1 ms over 5 s."""
    assert engaged(1e-3) == []  # the description's
    (text,) = engaged(8e-3)
    assert text.startswith("WetClutch at t = 0.016 s: the step of 0.008 s is longer than advised_")
    assert text.endswith("of the description, 0.001 s; shorten the host's step; this is said once")
