"""A host that is no Python runs the Python FMUs as they are: same numbers, clean ends."""

import shutil
import signal

import pytest
from c_host import LIBPYTHON, load, needs_host, talk
from sampling import sizes
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.fmu.interface import all_specs, variables
from thrustwasher.fmu.stepper import DirectInstance, unpack

pytestmark = needs_host
SET = "set_real " + " ".join(f"{i} {value}" for i, value in enumerate(TOY_START.values(), 1))
BEGUN = ["instantiate", SET, "initialize"]


def clean(said):
    """Every call ended OK, and the process with 0."""
    return said.code == 0 and not said.messages and not any(rc for _, rc, _ in said.calls)


@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.name)
def test_every_fmu_runs_in_a_bare_host(spec, fmus):
    outputs = [v for v in variables(spec) if v.causality == "output" and v.type == "Real"]
    read = f"get_real {' '.join(str(v.reference) for v in outputs)}"
    said = talk(fmus[spec.name], "version", "instantiate", "initialize", read, "steps 0 3", read,
                "last", "release")  # fmt: skip
    assert said.code == 0 and not any(rc for _, rc, _ in said.calls), said
    direct = DirectInstance(spec)
    direct.initialize()
    start = direct.get([v.name for v in outputs])
    for i in range(3):
        direct.step(i * 1e-3, 1e-3)
    expected = [start, direct.get([v.name for v in outputs])]
    assert [list(map(float, values)) for values in said.values("get_real")] == expected
    assert said.values("last") == [["0.003", "0"]]


def test_the_library_of_python_can_be_named(toy_fmu):
    assert clean(talk(toy_fmu, *BEGUN, "steps 0 3", FMU_LIBPYTHON=str(LIBPYTHON)))


@pytest.mark.parametrize(
    ("environment", "part"),
    [
        ({"PATH": "/nowhere"}, "no python3 on PATH"),
        ({"FMU_LIBPYTHON": "/nowhere/libpython3.so"}, "/nowhere/libpython3.so"),
        ({"FMU_LIBPYTHON": "libm.so.6"}, "libm.so.6 is no library of Python 3"),
        ({"PYTHONHOME": "/nowhere"}, "python3 on PATH does not run"),
        ({"PYTHONHOME": "/nowhere", "FMU_LIBPYTHON": str(LIBPYTHON)}, "PYTHONHOME"),
        ({"PYTHONPATH": "/nowhere", "PATH": "/usr/bin:/bin"}, "FMU_LIBPYTHON"),
    ],
)
def test_without_its_python_there_is_no_instance_but_a_message(environment, part, toy_fmu):
    said = talk(toy_fmu, "version", "instantiate", "instantiate", **environment)
    assert said["version"] == [0] and said["instantiate"] == [1, 1] and said.code == 0
    assert part in said.messages[-1] and "ToyClutch cannot be instantiated" in said.messages[-1]
    assert "FMU_LIBPYTHON" in said.messages[-1] or "PYTHONHOME" in said.messages[-1]


@sizes(2, 4)
def test_processes_end_cleanly_whether_instances_are_freed_or_not(toy_fmu, n):
    for i in range(n):
        assert clean(talk(toy_fmu, *BEGUN, "steps 0 3", *["release"] * (i % 2)))


def test_a_library_can_be_unloaded_and_loaded_again(toy_fmu, tmp_path):
    copy = tmp_path / "copy"  # as tools do that unpack again for every run
    shutil.copytree(unpack(toy_fmu), copy)
    other = load(toy_fmu).replace(str(unpack(toy_fmu)), str(copy))
    life = [*BEGUN, "steps 0 3", "release", "unload"]
    said = talk(toy_fmu, *life, load(toy_fmu), *life, other, *life, load(toy_fmu), *life)
    assert clean(said) and said["unload"] == [0] * 4


def test_ctrl_c_still_ends_a_host_that_runs_an_fmu(toy_fmu):
    assert talk(toy_fmu, *BEGUN, "interrupt").code == -signal.SIGINT


def test_threads_live_side_by_side_also_from_the_first_call_on(toy_fmu, fmus):
    for _ in range(2):
        said = talk(toy_fmu, "threads 8", "threads 8", also=[fmus["WetClutch"]])
        assert said["threads"] == [0, 0] and said.code == 0


def test_two_models_in_one_process_do_not_meet(toy_fmu, fmus):
    both = [*BEGUN, "use 1", "instantiate", "initialize", "use 0", "step 0 1e-3", "get_real 11",
            "use 1", "step 0 1e-3", "release", "use 0", "step 1e-3 1e-3", "release"]  # fmt: skip
    alone = talk(toy_fmu, *BEGUN, "step 0 1e-3", "get_real 11").values("get_real")
    said = talk(toy_fmu, *both, *both, also=[fmus["WetClutch"]])
    assert clean(said) and said.values("get_real") == alone * 2


def test_a_state_that_is_set_again_gives_the_same_run_to_the_bit(toy_fmu):
    run = ["steps 5 10", "get_real 11 12 13 14"]
    again = ["to_bytes 0", "from_bytes 1", "free_state 0", "set_state 1", *run, "last"]
    said = talk(toy_fmu, *BEGUN, "steps 0 5", "get_state 0", *run, "set_state 0", *run, *again)
    first, *others = said.values("get_real")
    assert clean(said) and others == [first, first] and said.values("last") == [["0.015", "0"]]


def test_instances_come_and_go_without_eating_memory(toy_fmu):
    said = talk(toy_fmu, "cycles 300")
    assert clean(said) and int(said.errors) < 20_000  # bytes per instance


def test_a_host_that_says_nothing_of_logging_still_gets_errors_and_no_more(toy_fmu):
    for logging in (0, 1):
        said = talk(toy_fmu, f"instantiate {logging}", SET, "initialize", "set_real 1 9500",
                    "step 0 1e-3", "set_real 1 500", "step 0 1e-3")  # fmt: skip
        assert said["step"] == [3, 0]
        assert [m[0] for m in said.messages if "not converged" in m] == ["3"]
        assert logging or len(said.messages) == 1


def test_the_toy_has_the_references_used_here():
    names = [v.name for v in variables(TOY)]
    assert names[1:4] == list(TOY_START) and names[11:15] == [
        "friction_torque", "temperature", "temperature_rise", "energy"]  # fmt: skip
