"""The guard of Python FMUs: every call looked at before Python sees it, every failure an error."""

import shutil
import subprocess
import zipfile
from urllib.parse import quote

import pytest
from c_host import load, needs_host, talk
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu import archive, guard, identity
from thrustwasher.fmu.build import source_folder
from thrustwasher.fmu.native import calls, library, tables
from thrustwasher.fmu.python_contents import python_contents
from thrustwasher.fmu.stepper import unpack
from thrustwasher.native import link

OK, ERROR = 0, 3
GUID = "0123456789abcdef" * 2
SHELL = source_folder() / "shell"
SET = "set_real " + " ".join(f"{i} {value}" for i, value in enumerate(TOY_START.values(), 1))
MADE = ["instantiate", SET, "setup 0"]
BEGUN = [*MADE, "enter", "leave"]
WAYS = {
    calls.INSTANTIATED: [],
    calls.INITIALIZING: ["setup 0", "enter"],
    calls.STEPPING: ["setup 0", "enter", "leave"],
    calls.TERMINATED: ["setup 0", "enter", "leave", "terminate"],
}
# command of the host -> function of the standard
CALLS = {
    "setup 0": "SetupExperiment", "enter": "EnterInitializationMode", "reset": "Reset",
    "leave": "ExitInitializationMode", "step 0 1e-3": "DoStep", "terminate": "Terminate",
    "set_real 1 400": "SetReal", "get_real 1": "GetReal", "get_state 0": "GetFMUstate",
    "last": "GetRealStatus",
}  # fmt: skip


@pytest.fixture(scope="module")
def made():
    found = guard.guard_library(TOY, guid=GUID)
    if not found:
        pytest.skip("needs a C compiler")
    return found


@needs_host
def test_calls_are_allowed_in_the_modes_of_the_table_and_in_no_other(toy_fmu):
    tried = [(mode, call) for mode in WAYS for call in CALLS]
    script = [
        line for mode, call in tried for line in ["instantiate", *WAYS[mode], call, "release"]
    ]
    said = talk(toy_fmu, *script)
    lives = " ".join(f"{name}:{rc}" for name, rc, _ in said.calls).split("release:0")
    found = {pair: life.split()[-1][-1] == "0" for pair, life in zip(tried, lives, strict=False)}
    assert said.code == 0
    assert found == {
        (mode, call): bool(calls.CALLS[2][name] & mode)
        for mode in WAYS for call, name in CALLS.items()
    }  # fmt: skip
    assert "3 fmi2DoStep is not allowed in state instantiated; " \
           "call fmi2EnterInitializationMode first" in said.messages  # fmt: skip


@needs_host
def test_outputs_have_no_value_before_the_initialization(toy_fmu):
    said = talk(toy_fmu, "instantiate", "get_real 11", "get_real 0 1 4", *WAYS[2], "get_real 11")
    assert said["get_real"] == [ERROR, OK, OK]


BAD = {
    "set_real 1 500 2 nan": "speed = nan rad/s is outside -1000 .. 1000 rad/s",
    "set_real 3 24": "Did you mean 297.15 K (24 degC)?",
    "set_real 1 500 4294967295 1": "value reference 4294967295 is unknown in ToyClutch",
    "set_integer 1 5": "load is of type Real, not Integer",
    "set_real 11 5": "friction_torque is an output variable",
    "set_real 4 0.04": "inner_radius is a fixed parameter",
    "get_real 1 999": "value reference 999 is unknown",
    "get_boolean 1": "load is of type Real, not Boolean",
    "step 0 -1e-3": "allowed: finite, step > 0",
    "step nan 1e-3": "allowed: finite, step > 0",
    "derivative 11": "no directional derivatives",
    "cancel": "canRunAsynchronuously is false",
    "set_state 3": "no FMU state of this instance",
    "setup 0": "fmi2SetupExperiment is not allowed in state step mode",
}


@needs_host
def test_a_bad_call_is_an_error_with_a_reason_and_harms_nothing(toy_fmu):
    look = "get_real 0 1 2 3 4"
    tried = [line for call in BAD for line in (call, SET, look)]
    said = talk(toy_fmu, *BEGUN, look, *tried, "step 0 1e-3", "get_real 11")
    good, bad = said.calls[5:-2:3], said.calls[6:-2:3]
    assert [rc for _, rc, _ in bad] == [ERROR] * len(BAD) and good == good[:1] * (len(BAD) + 1)
    missing = zip(said.messages, BAD.values(), strict=True)
    assert [message for message, part in missing if part not in message] == []
    untouched = talk(toy_fmu, *BEGUN, "step 0 1e-3", "get_real 11")
    assert said.calls[-2:] == untouched.calls[-2:] and said.code == 0


@needs_host
def test_a_failed_step_is_an_error_not_the_end(toy_fmu):
    said = talk(toy_fmu, *BEGUN, "step 0 1e-3", "set_real 1 9500", "step 1e-3 1e-3",
                "get_integer 17", "last", "get_real 11", SET, "get_real 11", "step 1e-3 1e-3",
                "get_integer 17", "last")  # fmt: skip
    assert said["step"] == [OK, ERROR, OK] and said["get_real"] == [ERROR, OK]
    assert said.values("get_integer") == [["10"], ["0"]]
    assert said.values("last") == [["0.001", "0"], ["0.002", "0"]]  # never "terminated"


@needs_host
def test_parameters_can_be_mended_where_the_initialization_failed(toy_fmu):
    said = talk(toy_fmu, *MADE, "set_real 4 0.2", "enter", "leave", "step 0 1e-3",
                "set_real 4 0.05", "leave", "step 0 1e-3")  # fmt: skip
    assert said["leave"] == [ERROR, OK] and said["step"] == [ERROR, OK]
    assert "allowed: below outer_radius" in said.messages[0]


@needs_host
def test_null_pointers_are_errors(toy_fmu):
    said = talk(toy_fmu, *BEGUN, "nulls", "step 0 1e-3")
    assert said.values("nulls") == [["3"] * 4] and said["nulls"] == [0] and said["step"] == [OK]


@needs_host
def test_what_is_no_instance_of_this_fmu_is_refused(toy_fmu):
    _, _, guid, resources = load(toy_fmu).split()
    said = talk(
        toy_fmu, f"odd {GUID} {resources} 1", f"odd - {resources} 1", f"odd {guid} - 1",
        f"odd {guid} {resources} 0", f"odd {guid} file:///nowhere 1", f"odd {guid} http://x/y 1",
        f"odd {guid} file:///%zz 1", "instantiate",
    )  # fmt: skip
    assert said["odd"] == [0] * 7 and len(said.messages) == 7 and said["instantiate"] == [0]
    assert all("ToyClutch cannot be instantiated" in message for message in said.messages)


@needs_host
def test_any_form_of_the_resource_location_is_understood(toy_fmu, tmp_path):
    guid = load(toy_fmu).split()[2]
    script = []
    for name in ("a b", "üöß", "100%", "x#y"):
        shutil.copytree(unpack(toy_fmu) / "resources", tmp_path / name)
        path = quote(str(tmp_path / name))
        forms = [f"file://{path}", f"file:{path}", f"FILE://localhost{path}", f"file://{path}/"]
        script += [f"odd {guid} {form} 1" for form in forms]
    said = talk(toy_fmu, *script)
    assert said["odd"] == [1] * 16 and not said.messages and said.code == 0


@needs_host
def test_damaged_states_never_reach_python(toy_fmu):
    places = [0, 9, 45, 55, 61, 70, 150]  # magic, GUID, length, time, check, what Python wrote
    flips = [
        line for place in places for line in (f"flip {place}", "from_bytes 2", f"flip {place}")
    ]
    said = talk(toy_fmu, *BEGUN, "step 0 1e-3", "get_state 0", "to_bytes 0", "from_bytes 1 1",
                *flips, "from_bytes 1", "set_state 1", "get_state 1", "free_state 1",
                "free_state 1", "set_state 1", "step 1e-3 1e-3")  # fmt: skip
    assert said["from_bytes"] == [ERROR] * (1 + len(places)) + [OK]
    assert said["set_state"] == [OK, ERROR] and said["free_state"] == [OK, OK]
    assert said["get_state"] == [OK, OK] and said["step"] == [OK, OK]


RAISING = """
    def do_step(self, current_time, step_size):
        if current_time > 0.5:
            raise KeyboardInterrupt("out of the callback")
        return super().do_step(current_time, step_size)
"""


@needs_host
def test_exceptions_that_leave_a_callback_do_not_end_the_process(toy_fmu, tmp_path):
    with zipfile.ZipFile(toy_fmu) as zipped:
        files = {n: zipped.read(n) for n in zipped.namelist()}
    slave = f"resources/{files['resources/slavemodule.txt'].decode()}.py"
    files[slave] += RAISING.encode()
    raising = tmp_path / "ToyClutch.fmu"
    raising.write_bytes(archive.pack(files))
    said = talk(raising, *BEGUN, "get_state 0", "step 0 1e-3", "step 1 1e-3", "step 1 1e-3",
                "get_real 11", "reset", *BEGUN[1:], "step 0 1e-3", "step 1 1e-3", "release",
                *BEGUN, "step 1 1e-3", "reset", "release")  # fmt: skip
    assert said["step"] == [OK, ERROR, ERROR, OK, ERROR, ERROR] and said["reset"] == [OK, OK]
    assert "out of the callback" in said.messages[0] and "call fmi2Reset" in said.messages[1]
    assert said["get_real"] == [ERROR] and said.code == 0


def test_the_guard_exports_the_functions_of_the_standard(made, tmp_path):
    file = tmp_path / "guard.so"
    file.write_bytes(made)
    shown = subprocess.run(["nm", "-D", "--defined-only", file], capture_output=True, text=True)
    names = {line.split()[-1] for line in shown.stdout.splitlines()}
    assert names == {*calls.functions(2), "thrustwasher_shared"}


def test_the_same_guard_is_the_same_bytes(made):
    assert guard.guard_library(TOY, guid=GUID) == made
    assert guard.guard_library(TOY, guid=GUID[::-1]) != made


@needs_host
def test_the_guard_compiles_without_a_warning(tmp_path):
    for name, text in tables.sources(TOY, fmi=2, guid=GUID).items():
        (tmp_path / name).write_text(text)
    for name, content in library.headers(2).items():
        (tmp_path / name).write_bytes(content)
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-O2", "-fPIC", "-shared", "-I",
               tmp_path, "-I", SHELL, *SHELL.glob("guard*.c"), "-o", "guard.so"]  # fmt: skip
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr


def test_without_a_compiler_the_fmu_is_bare_and_says_so(monkeypatch):
    def none():
        raise EnvironmentProblem("no compiler")

    folder = identity.model_folder(TOY, source_folder().parent / "tests" / "fmu" / "toy" / "slaves")
    monkeypatch.setattr(link, "find_linker", none)
    files = python_contents(TOY, folder, guid=GUID)
    assert guard.compiler() == "" and "binaries/linux64/impl.so" not in files
    assert b"finalizePythonInterpreter" in files["binaries/linux64/ToyClutch.so"]
    needs = files["documentation/externalDependencies.txt"].decode()
    assert "lacks the guard" in needs and "FMU_LIBPYTHON" not in needs


def test_another_guard_is_another_guid(tmp_path):
    shell = tmp_path / "shell"
    shutil.copytree(SHELL, shell)
    folder = identity.model_folder(TOY, tmp_path)
    first = identity.identifier(TOY, folder, shell=shell, target="python", fmi=2)
    assert first == identity.identifier(TOY, folder, shell=SHELL, target="python", fmi=2)
    (shell / "guard.c").write_text("/* another */")
    assert first != identity.identifier(TOY, folder, shell=shell, target="python", fmi=2)
