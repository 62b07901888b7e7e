"""What only Python FMUs have: pythonfmu's callbacks, the version they need, states in processes."""

import zipfile
from dataclasses import replace

import pytest
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import EnvironmentProblem, ParameterError
from thrustwasher.fmu.model_kernels import content_digest, package_version
from thrustwasher.fmu.python.slave import Slave
from thrustwasher.fmu.running.core import Core
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.native.files import zipped

H = 1e-3
CONTINUE = """
import sys
from thrustwasher.fmu.stepper import Instance
with Instance(sys.argv[1]) as fmu:
    fmu.initialize()
    state = fmu.deserialize(open(sys.argv[2], "rb").read())
    fmu.set_state(state)
    fmu.free_state(state)
    fmu.step(1e-3, 1e-3)
    print(fmu.outputs())
"""


def test_serialized_bytes_carry_the_run_to_another_process(python_toy, tmp_path, run_child):
    with Instance(python_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        fmu.step(0.0, H)
        state, file = fmu.get_state(), tmp_path / "state.bin"
        file.write_bytes(fmu.serialize(state))
        fmu.free_state(state)
        fmu.step(H, H)
        assert run_child(CONTINUE, python_toy, file) == str(fmu.outputs())


def test_a_state_of_another_model_is_refused():
    direct = DirectInstance(TOY)
    direct.initialize(inputs=TOY_START)
    with pytest.raises(ParameterError, match="another model or version"):
        direct.set_state(replace(direct.get_state(), identity="0" * 16))


def test_a_parameter_is_fixed_once_the_run_has_begun(python_toy):
    with Instance(python_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        with pytest.raises(ParameterError, match="discs is a fixed parameter"):
            fmu._put(fmu._filled({"discs": 3}, "parameter"))
        assert fmu.get(["discs"]) == [2.0]
        fmu.step(0.0, H)


def test_an_fmu_of_another_version_is_refused_with_both_named(python_toy, tmp_path):
    with zipfile.ZipFile(python_toy) as made:
        files = {n: made.read(n) for n in made.namelist()}
    module = files["resources/slavemodule.txt"].decode()
    slave = files.pop(f"resources/{module}.py").decode()
    digest = slave.split('"')[-4]
    files["resources/slavemodule.txt"] = b"thrustwasher_fmu_old"
    files["resources/thrustwasher_fmu_old.py"] = (
        slave.replace(digest, "0" * 16).replace(f'"{package_version()}"', '"0.0.9"').encode()
    )
    old = tmp_path / "ToyClutch.fmu"
    old.write_bytes(zipped(files))
    with pytest.raises(EnvironmentProblem, match=r"pip install thrustwasher==0\.0\.9") as refused:
        Instance(old)
    assert "0.0.9" in str(refused.value) and "EnvironmentProblem(" not in str(refused.value)


class Broken(Slave):
    model = TOY.key


def broken_slave(monkeypatch):
    """Return a slave whose core raises whatever it is asked."""
    monkeypatch.setattr(Broken, "digest", content_digest(TOY))
    slave = Broken(instance_name="broken", resources="/nowhere")

    def fail(*_):
        raise KeyboardInterrupt("Ctrl-C in the middle")

    for name in ("set", "get", "advance", "prepare", "snapshot", "restore"):
        monkeypatch.setattr(Core, name, fail)
    return slave


def test_no_exception_but_of_a_step_leaves_a_callback(monkeypatch):
    slave = broken_slave(monkeypatch)
    with pytest.raises(EnvironmentProblem, match="Ctrl-C in the middle"):
        slave.do_step(0.0, H)  # the only one that may
    assert slave.get_real([1]) == [100.0]
    assert slave.get_integer([9999]) == [0] and slave.get_boolean([-1]) == [False]
    assert slave.get_string([1, 2]) == ["", ""]
    for call in (
        lambda: slave.set_real([1], [1.0]),
        lambda: slave.set_integer([1], [1]),
        lambda: slave.set_boolean([1], [True]),
        lambda: slave.set_string([1], [""]),
        slave.exit_initialization_mode,
        slave._get_fmu_state,
        lambda: slave._set_fmu_state("no state"),
        lambda: slave.setup_experiment("x", None, None),
    ):
        assert call() in (False, None)
    assert slave.core.status.is_failure
    assert any("Ctrl-C" in m.msg for m in slave.log_queue)


def test_messages_have_no_character_that_fmi_gives_a_meaning(monkeypatch):
    slave = broken_slave(monkeypatch)
    slave.report(ParameterError("50 % of #3#"))
    assert not {"%", "#"} & set(slave.log_queue[-1].msg)


REFUSED = """
import sys
import numpy as np
from fmpy import simulate_fmu
rows = [(0.0, 500.0, 310.0), (0.4, 500.0, 310.0), (0.4, 500.0, 80.0), (1.0, 500.0, 80.0)]
names = ["time", "load", "oil_temperature"]
given = np.array(rows, dtype=[(n, float) for n in names])
said = []
for _ in range(3):
    try:
        simulate_fmu(sys.argv[1], input=given, stop_time=1.0, output_interval=0.1,
                     debug_logging=True, logger=lambda *words: said.append(str(words[-1])))
    except Exception as problem:
        print(problem)
print(sum("353.15 K (80 degC)" in text for text in said) >= 3)
"""


def test_a_refused_input_raises_in_fmpy_as_a_native_fmu_does(python_toy, fmi2_toy, run_child):
    """A step that is discarded ends its run in silence, at 0.4 of 1 s."""
    for fmu, status in ((python_toy, "fmi2DoStep failed with status 4"), (fmi2_toy, "status 3")):
        *raised, told = run_child(REFUSED, fmu).splitlines()
        assert sum(status in text for text in raised) == 3 and told == "True"


def test_steps_that_fail_leave_an_instance_of_the_same_references(python_toy):
    """pythonfmu drops three at an exception; without them the second failure ends the process."""
    with Instance(python_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        fmu.step(0.0, H)
        for _ in range(20):
            with pytest.raises(ParameterError):
                fmu.step(0.0, float("nan"))
        fmu.step(H, H)
        assert fmu.get(["steps"]) == [2.0]
