"""Bad values and failed steps: said in one sentence, nothing taken over, the instance lives on."""

import math
import zipfile

import pytest
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import EnvironmentProblem, ParameterError, SolveError, Status
from thrustwasher.fmu.model_kernels import package_version
from thrustwasher.fmu.python.slave import Slave
from thrustwasher.fmu.running.core import Core
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.native.files import zipped

H = 1e-3
GOOD = list(TOY_START.values())
BAD_INPUTS = [
    ([500.0, 20.0, 24.0], "oil_temperature = 24 K is outside 233.15 .. 473.15 K; .*297.15 K"),
    ([500.0, 20.0, 0.0], "not connected reads 0"),
    ([-1.0, 20.0, 300.0], "load = -1 N is outside 0 .. 10000 N"),
    ([500.0, math.nan, 300.0], "speed = nan rad/s is outside -1000 .. 1000 rad/s"),
    ([math.inf, 20.0, 300.0], "load = inf N"),
]


@pytest.fixture(params=["fmu", "direct"])
def instance(request, toy_fmu):
    made = Instance(toy_fmu) if request.param == "fmu" else DirectInstance(TOY)
    with made:
        made.initialize(inputs=TOY_START)
        yield made


@pytest.mark.parametrize(("values", "message"), BAD_INPUTS)
def test_a_bad_input_is_refused_and_no_value_of_the_call_taken_over(values, message, instance):
    with pytest.raises(ParameterError, match=message):
        instance.set_inputs(values)
    assert instance.get(list(TOY_START)) == GOOD


def test_no_step_runs_on_a_refused_input_and_a_good_one_cures_it(instance):
    with pytest.raises(ParameterError):
        instance.set_inputs([500.0, math.nan, 300.0])
    assert instance.get(["solver_status"]) == [Status.BAD_INPUT]
    with pytest.raises((SolveError, ParameterError), match="speed = nan"):
        instance.step(0.0, H)
    instance.set_inputs(GOOD)
    assert instance.get(["solver_status"]) == [Status.OK]
    instance.step(0.0, H)


@pytest.mark.parametrize(
    ("values", "status"),
    [([9500.0, 20.0, 310.0], Status.MAX_ITERATIONS), ([1.0, 777.0, 310.0], Status.NOT_FINITE)],
)
def test_a_failed_step_changes_nothing_but_the_status(values, status, instance):
    instance.step(0.0, H)
    before = instance.outputs()
    instance.set_inputs(values)
    with pytest.raises(SolveError, match=status.name):
        instance.step(H, H)
    assert instance.get(["solver_status"]) == [status]
    instance.set_inputs(GOOD)
    assert instance.outputs() == before
    instance.step(H, H)
    clean = DirectInstance(TOY)
    clean.initialize(inputs=TOY_START)
    clean.step(0.0, H)
    clean.step(H, H)
    assert instance.outputs() == clean.outputs()


def test_the_message_names_the_model_the_point_and_what_to_do(instance):
    instance.set_inputs([9500.0, 20.0, 310.0])
    with pytest.raises(SolveError) as raised:
        instance.step(0.0, H)
    for part in ("ToyClutch", "load = 9500 N", "speed = 20 rad/s", "t = 0 s", "not converged"):
        assert part in str(raised.value)
    assert "\n" not in str(raised.value)


def test_outputs_that_cannot_be_solved_are_an_error_not_a_number(instance):
    instance.set_inputs([9500.0, 20.0, 310.0])
    for _ in range(2):
        with pytest.raises(SolveError, match="MAX_ITERATIONS"):
            instance.outputs()


@pytest.mark.parametrize("h", [0.0, -1e-3, math.nan, math.inf])
def test_a_step_must_be_finite_and_forward(h, instance):
    with pytest.raises(ParameterError, match="allowed: finite, step > 0"):
        instance.step(0.0, h)
    instance.step(0.0, H)


def test_rules_between_parameters_are_checked_with_the_text_of_the_dataclass(toy_fmu):
    with pytest.raises(ParameterError) as said:
        TOY.params(inner_radius=0.2)
    for made in (Instance(toy_fmu, parameters={"inner_radius": 0.2}),
                 DirectInstance(TOY, parameters={"inner_radius": 0.2})):  # fmt: skip
        with made, pytest.raises(ParameterError) as raised:
            made.initialize(inputs=TOY_START)
        assert str(said.value) in str(raised.value)


def test_a_parameter_is_fixed_once_the_run_has_begun(toy):
    with pytest.raises(ParameterError, match="discs is a fixed parameter"):
        toy._put(toy._filled({"discs": 3}, "parameter"))
    assert toy.get(["discs"]) == [2.0]
    toy.step(0.0, H)


def test_advice_is_a_warning_given_once(toy_fmu):
    with Instance(toy_fmu, parameters={"heat_capacity": 1.0}) as fmu:
        fmu.initialize(inputs={"load": 8000.0, "speed": 900.0, "oil_temperature": 300.0})
        for i in range(3):
            fmu.step(i * H, H)
        assert fmu.get(["solver_status", "hot"]) == [Status.HOT, 1.0]
        assert len(fmu.warnings) == 1 and "250 degC" in fmu.warnings[0]


def test_an_fmu_of_another_version_is_refused_with_both_named(toy_fmu, tmp_path):
    with zipfile.ZipFile(toy_fmu) as made:
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
    from thrustwasher.fmu.model_kernels import content_digest

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
        lambda: slave.set_real([1], [1.0]), lambda: slave.set_integer([1], [1]),
        lambda: slave.set_boolean([1], [True]), lambda: slave.set_string([1], [""]),
        slave.exit_initialization_mode, slave._get_fmu_state,
        lambda: slave._set_fmu_state("no state"), lambda: slave.setup_experiment("x", None, None),
    ):  # fmt: skip
        assert call() in (False, None)
    assert slave.core.status.is_failure
    assert any("Ctrl-C" in m.msg for m in slave.log_queue)


def test_messages_have_no_character_that_fmi_gives_a_meaning(monkeypatch):
    slave = broken_slave(monkeypatch)
    slave.report(ParameterError("50 % of #3#"))
    assert not {"%", "#"} & set(slave.log_queue[-1].msg)
