"""Inputs that move within a step, in the models' own FMUs, as hosts give them."""

import math

import pytest
from built import built_fmu
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec

H = 2e-3
STARTS = {
    "clutch": {"load": 3000.0, "speed": 80.0, "oil_temperature": 340.0, "drum_speed": 40.0},
    "transmission": {"clutch_torque": 60.0, "engine_torque_input": 150.0, "shift_command": 0.2},
    "gearmesh": {"load": 60.0, "speed": 200.0, "oil_temperature": 350.0},
}


def profile(model, t):
    """Return all inputs, smooth in time."""
    wave = 1.0 + 0.3 * math.sin(20.0 * t)
    names = [s.name for s in find_spec(model).inputs]
    return [STARTS[model].get(n, 0.0) * (1.0 if n == "oil_temperature" else wave) for n in names]


def rates(model, t):
    """Return the rates with which a step from ``t`` ends where the profile does."""
    pairs = zip(profile(model, t), profile(model, t + H), strict=True)
    return [(b - a) / H for a, b in pairs]


def run(instance, model):
    """Return the outputs after 20 steps with rates."""
    instance.initialize(0.0, dict(zip(instance.input_names, profile(model, 0.0), strict=True)))
    for i in range(20):
        instance.set_inputs(profile(model, i * H))
        instance.set_rates(rates(model, i * H))
        instance.step(i * H, H)
    return instance.outputs()


@pytest.mark.parametrize("model", STARTS)
def test_fmi_2_with_input_derivatives_is_the_kernels_to_the_bit(model):
    with Instance(built_fmu(model, local=True)) as fmu:
        assert run(fmu, model) == run(DirectInstance(find_spec(model)), model)


@pytest.mark.parametrize("model", STARTS)
def test_fmi_3_gets_the_inputs_at_the_end_of_a_step_in_a_callback(model, tmp_path):
    path = str(built_fmu(model, fmi=3, local=True))
    described = read_model_description(path)
    listed = described.modelVariables
    inputs, outputs = (
        [v for v in listed if v.causality == kind and v.type == "Float64"]
        for kind in ("input", "output")
    )
    wanted = [v.valueReference for v in inputs]
    fmu = FMU3Slave(
        guid=described.guid,
        unzipDirectory=extract(path, str(tmp_path)),
        modelIdentifier=described.coSimulation.modelIdentifier,
    )

    def at_time(_, time, *others):
        if others[0]:  # values are requested
            fmu.setFloat64(wanted, profile(model, time))

    fmu.instantiate(intermediateUpdate=at_time, requiredIntermediateVariables=wanted)
    fmu.enterInitializationMode(startTime=0.0)
    fmu.setFloat64(wanted, profile(model, 0.0))
    fmu.exitInitializationMode()
    for i in range(20):
        fmu.setFloat64(wanted, profile(model, i * H))
        fmu.doStep(i * H, H)
    found = fmu.getFloat64([v.valueReference for v in outputs])
    got = dict(zip([v.name for v in outputs], found, strict=True))
    fmu.freeInstance()
    direct = DirectInstance(find_spec(model))
    named = dict(zip(direct.output_names, run(direct, model), strict=True))
    assert got == pytest.approx({n: named[n] for n in got}, rel=1e-9, abs=1e-9)
