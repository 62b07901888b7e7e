"""The real models through the same gate: FMU against kernels, contract, dependencies."""

import importlib.util
import random

import numpy as np
import pytest

from thrustwasher.fmu.interface import all_specs, find_spec, variables
from thrustwasher.fmu.registry import load_kernel
from thrustwasher.fmu.stepper import DirectInstance, Instance

H = 1e-3
NAMES = [
    spec.name
    for spec in all_specs()
    if importlib.util.find_spec(f"thrustwasher.kernels.{spec.kernel}")
]
STEPS = {"ThrustWasher": 20}  # a step of the others is a thousand times cheaper
# Where a model works in a shift: (low, high) per input; random points are drawn from it.
TYPICAL = {
    "load": (1e3, 8e3), "speed": (-100.0, 100.0), "oil_temperature": (290.0, 360.0),
    "shift_command": (0.0, 1.0), "clutch_torque": (0.0, 300.0), "brake_torque": (0.0, 300.0),
    "washer_torque": (0.0, 0.5), "mesh_torque": (0.0, 1.0),
}  # fmt: skip
WASHER = {"load": (100.0, 600.0), "speed": (100.0, 500.0), "tilt": (1e-3, 2e-3)}


def drawn(spec, rng):
    ranges = TYPICAL | (WASHER if spec.name == "ThrustWasher" else {})
    return [rng.uniform(*ranges[signal.name]) for signal in spec.inputs]


@pytest.mark.parametrize("name", NAMES)
def test_the_kernel_has_the_lengths_of_the_list(name):
    spec = find_spec(name)
    kernel, found = load_kernel(spec.kernel), variables(spec)
    held = {s: sum(v.store == s for v in found) for s in ("par", "inp", "out", "iout")}
    lengths = (kernel.n_param, kernel.n_inp, kernel.n_out, kernel.n_iout)
    assert tuple(held.values()) == lengths
    assert kernel.n_par >= kernel.n_param


@pytest.mark.parametrize("name", NAMES)
def test_the_fmu_and_the_kernels_agree_to_the_bit(name, fmus):
    spec, rng = find_spec(name), random.Random(1)
    start = dict(zip((s.name for s in spec.inputs), drawn(spec, rng), strict=True))
    with Instance(fmus[name]) as fmu, DirectInstance(spec) as direct:
        for instance in (fmu, direct):
            instance.initialize(inputs=start)
        for i in range(STEPS.get(name, 200)):
            point = drawn(spec, rng)
            for instance in (fmu, direct):
                instance.set_inputs(point)
                instance.step(i * H, H)
            assert fmu.outputs() == direct.outputs()


@pytest.mark.parametrize("name", NAMES)
def test_state_and_readings(name, fmus):
    spec = find_spec(name)
    results = []
    with Instance(fmus[name]) as fmu:
        fmu.initialize(inputs={})
        for i in range(20):
            fmu.step(i * H, H)
        state = fmu.get_state()
        for readings in (0, 2):
            fmu.set_state(state)
            rng = random.Random(2)
            for i in range(20, 40):
                fmu.set_inputs(drawn(spec, rng))
                for _ in range(readings):
                    fmu.outputs()
                fmu.step(i * H, H)
            results.append(fmu.outputs())
        fmu.free_state(state)
    assert results[0] == results[1]


@pytest.mark.parametrize("name", NAMES)
def test_whatever_work_holds_the_result_is_the_same(name):
    spec, results = find_spec(name), []
    for fill in (0.0, np.nan, 1e300):
        rng = random.Random(3)
        with DirectInstance(spec) as direct:
            direct.initialize()
            for i in range(20):
                direct.set_inputs(drawn(spec, rng))
                direct.core.work[:] = fill
                direct.step(i * H, H)
                results.append((i, direct.outputs()))
    assert results[:20] == results[20:40] == results[40:]


@pytest.mark.parametrize("name", NAMES)
def test_a_solution_without_a_step_leaves_the_memory_alone(name):
    spec, rng = find_spec(name), random.Random(4)
    with DirectInstance(spec) as direct:
        direct.initialize()
        for i in range(10):
            direct.step(i * H, H)
            before = direct.core.state.tobytes()
            direct.set_inputs(drawn(spec, rng))
            direct.outputs()
            assert direct.core.state.tobytes() == before


# Listed dependencies that the points drawn here do not show: a locked clutch feels every torque.
UNSEEN = {
    ("load", "friction_coefficient"), ("brake_torque", "drag_torque"),
    ("brake_torque", "clutch_reaction"), ("washer_torque", "clutch_reaction"),
    ("mesh_torque", "clutch_reaction"),
}  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_only_listed_inputs_move_an_output_at_once(name):
    spec, rng = find_spec(name), random.Random(5)
    seen = set()
    for case in range(20):
        with DirectInstance(spec) as direct:
            point = drawn(spec, rng)
            direct.initialize(inputs=dict(zip(direct.input_names, point, strict=True)))
            for i in range(5 * (case % 2)):  # at the start too
                direct.step(i * H, H)
            for i, signal in enumerate(spec.inputs):
                direct.set_inputs(point)
                before = direct.outputs()
                changed = list(point)
                changed[i] += 0.1 * (drawn(spec, rng)[i] - point[i])
                direct.set_inputs(changed)
                pairs = zip(spec.outputs, before, direct.outputs(), strict=True)
                seen |= {(signal.name, output.name) for output, a, b in pairs if a != b}
    listed = {(i, v.name) for v in variables(spec) for i in v.depends}
    discrete = {s.name for s in spec.outputs if s.kind != "real"}
    assert seen <= listed
    assert {pair for pair in listed - seen if pair[1] not in discrete} <= UNSEEN
