"""One face for every FMU of ours: native or Python, FMI 2 or 3; and the derivatives it gives."""

import random

import needed
import pytest
from built import built_fmu
from toy.places import TOY_SOURCES, TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec

H = 1e-3
SETTINGS = {"discs": 4, "law": "dry", "fidelity": "fine", "dry": True, "inner_radius": 0.04}
GEAR_POINT = [60.0, -300.0, 340.0]


@pytest.fixture(scope="module")
def linker():
    return needed.linker()


@pytest.fixture(scope="module", params=[2, 3], ids=["fmi2", "fmi3"])
def native_toy(request, linker):
    return built_fmu(TOY.key, fmi=request.param, sources=TOY_SOURCES, local=True)


@pytest.fixture(
    scope="module", params=[2, pytest.param(3, marks=pytest.mark.fmi3)], ids=["fmi2", "fmi3"]
)
def native_gear(request, linker):
    return built_fmu("GearMesh", fmi=request.param, local=True)


def drawn(rng):
    return [rng.uniform(0, 8000), rng.uniform(-900, 900), rng.uniform(240, 470)]


def test_a_native_fmu_steps_like_the_kernels_to_the_bit(native_toy):
    rng = random.Random(1)
    with (
        Instance(native_toy, parameters=SETTINGS) as fmu,
        DirectInstance(TOY, parameters=SETTINGS) as direct,
    ):
        assert fmu.input_names == direct.input_names and fmu.output_names == direct.output_names
        for instance in (fmu, direct):
            instance.initialize(0.5, TOY_START)
        assert fmu.outputs() == direct.outputs()
        for i in range(100):
            point = drawn(rng)
            for instance in (fmu, direct):
                instance.set_inputs(point)
                instance.step(0.5 + i * H, H)
            assert fmu.outputs() == direct.outputs()
        names = [*SETTINGS, "time", "regime", "hot", "energy"]
        assert fmu.get(names) == direct.get(names)


def test_a_failed_step_says_why_and_leaves_everything(native_toy):
    with Instance(native_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        fmu.step(0.0, H)
        before = fmu.outputs()
        fmu.set_inputs([9500.0, 20.0, 310.0])
        with pytest.raises(SolveError, match=r"t = 0.001 s, step 0.001 s.*MAX_ITERATIONS"):
            fmu.step(H, H)
        fmu.set_inputs(list(TOY_START.values()))
        assert fmu.outputs()[:-1] == before[:-1]
        fmu.step(H, H)
        assert fmu.outputs()[3] > before[3]


def test_a_refused_value_is_a_parameter_error(native_toy):
    with pytest.raises(ParameterError, match=r"discs = 50 is outside 1 .. 20"):
        Instance(native_toy, parameters={"discs": 50})
    with Instance(native_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        with pytest.raises(ParameterError, match=r"load = -1 N is outside 0 .. 10000 N"):
            fmu.set_inputs([-1.0, 20.0, 310.0])
        with pytest.raises(ParameterError, match="inputs = 1 values, allowed: 3"):
            fmu.set_inputs([1.0])


def test_states_travel_as_bytes(native_toy):
    with Instance(native_toy) as fmu, Instance(native_toy) as other:
        fmu.initialize(inputs=TOY_START)
        fmu.step(0.0, H)
        state = fmu.get_state()
        data = fmu.serialize(state)
        fmu.step(H, H)
        after = fmu.outputs()
        for instance in (fmu, other):
            again = instance.deserialize(data)
            instance.set_state(again)
            instance.step(H, H)
            instance.free_state(again)
            assert instance.outputs() == after
        fmu.free_state(state)


def test_reset_keeps_the_parameters(native_toy):
    with Instance(native_toy, parameters=SETTINGS) as fmu:
        fmu.initialize(inputs=TOY_START)
        first = fmu.outputs()
        fmu.step(0.0, 0.5)
        fmu.reset()
        fmu.initialize(inputs=TOY_START)
        assert fmu.outputs() == first


def test_warnings_are_kept_and_notes_when_asked_for(native_toy):
    with Instance(native_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        fmu.set_inputs([8000.0, 900.0, 310.0])
        fmu.step(0.0, 1.0)
        assert fmu.notes == [] and any("HOT" in text for text in fmu.warnings)
        with pytest.raises(ParameterError, match="logStatusWarning"):
            fmu.log(categories=["logChatter"])


def test_without_derivatives_the_fmu_says_so(native_toy):
    with Instance(native_toy) as fmu:
        fmu.initialize(inputs=TOY_START)
        with pytest.raises(SolveError, match="no derivatives"):
            fmu.directional_derivative(["temperature"], ["speed"], [1.0])


def test_derivatives_are_those_of_the_kernels_to_the_bit(native_gear):
    spec = find_spec("GearMesh")
    unknowns, knowns = ["friction_torque", "temperature", "contact_stress"], ["speed", "load"]
    with Instance(native_gear) as fmu, DirectInstance(spec) as direct:
        for instance in (fmu, direct):
            instance.initialize()
            instance.set_inputs(GEAR_POINT)
            instance.step(0.0, H)
        for seed in ([1.0, 0.0], [-3.0, 2.5]):
            slopes = fmu.directional_derivative(unknowns, knowns, seed)
            assert slopes == direct.directional_derivative(unknowns, knowns, seed)
            assert all(slope != 0.0 for slope in slopes[:2])
        before = fmu.outputs()
        for names in (["speed"], ["friction_torque"]):  # an input is no unknown, nor the reverse
            with pytest.raises(ParameterError, match=names[0]):
                fmu.directional_derivative(names, names, [1.0])
        with pytest.raises(ParameterError, match="seed = 1 values, allowed: 2"):
            fmu.directional_derivative(unknowns, knowns, [1.0])
        assert fmu.outputs() == before
