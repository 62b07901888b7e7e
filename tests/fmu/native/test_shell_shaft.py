"""The transmission's elastic shaft in its own library: the core's bits, a swing that is kept."""

import random

import pytest
from shell_runs import GUID, model_library, needs_linux, run
from test_shell_models import H, jump
from twin import Twin

from thrustwasher.fmu.registry import find_spec
from thrustwasher.fmu.stepper import DirectInstance

pytestmark = needs_linux
SHAFT = {"shaft_stiffness": 1200.0, "shaft_damping": 2.0, "vehicle_inertia": 8.0,
         "carrier_inertia": 0.3, "initial_twist": 0.05}  # fmt: skip


@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
def test_a_swinging_shaft_is_the_cores_to_the_bit_and_its_state_is_whole(fmi):
    twin, rng = Twin(find_spec("transmission"), GUID), random.Random(5)
    twin.put(**SHAFT)
    twin.begin(0.0)
    twin.leave()
    for i in range(60):
        twin.put(**jump(twin.spec, rng))
        twin.step(i * H, H)
        twin.take()
        if i == 20:
            twin.save(0)
        if i == 40:
            twin.restore(0)
    twin.check(run(fmi, model_library("transmission", fmi), twin.script))


def test_a_core_that_takes_a_state_over_goes_on_with_the_swing():
    spec = find_spec("transmission")
    parameters = {**SHAFT, "fidelity": "rigid"}
    with DirectInstance(spec, parameters=parameters) as one:
        one.initialize(0.0, {"clutch_torque": 100.0})
        for i in range(50):
            one.step(i * H, H)
        kept = one.get_state()
        first = []
        for i in range(50, 60):
            one.step(i * H, H)
            first.append(one.outputs())
        one.set_state(kept)
        for i in range(50, 60):
            one.step(i * H, H)
            assert one.outputs() == first[i - 50]
    twist = [s.name for s in spec.outputs].index("shaft_twist")
    assert first[0][twist] != first[-1][twist] != 0.0
