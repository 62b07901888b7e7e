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


def test_no_exception_ever_leaves_a_callback(monkeypatch):
    slave = broken_slave(monkeypatch)
    assert slave.do_step(0.0, H) is False
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
