"""A native washer whose bodies store heat: bits of the kernels, rollback, and what is refused."""

import pytest
from built import built_fmu

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.fmu.stepper import Instance
from thrustwasher.washer.parameters import SPEC

POINT = {"load": 650.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}
IN_TIME = {"thermal_mode": "transient"}
TORQUE, MEAN = 0, 1


def washer(fmi):
    return built_fmu("ThrustWasher", fmi=fmi, local=True)


def course():
    """Return durations and inputs: beyond the fold, and back to light load in warmer oil."""
    rows = [(0.2, [650.0 + 40.0 * k, 545.0, 0.002, 297.15, 0.0]) for k in range(10)]
    rows += [(1.0, [1050.0, 545.0, 0.002, 297.15, 0.0])] * 5
    return rows + [(0.5, [200.0, -545.0, 0.002, 310.0, 0.0])] * 5


@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
def test_it_gives_the_bits_of_the_kernels_in_python(fmi):
    ours = DirectInstance(SPEC, parameters=IN_TIME)
    with Instance(washer(fmi), parameters=IN_TIME) as theirs:
        for instance in (ours, theirs):
            instance.initialize(0.0, POINT)
        time, warmest = 0.0, 0.0
        for h, inputs in course():
            for instance in (ours, theirs):
                instance.set_inputs(inputs)
                instance.step(time, h)
            time += h
            assert ours.outputs() == theirs.outputs()
            warmest = max(warmest, ours.outputs()[MEAN])
        assert warmest > 330.0 and ours.outputs()[MEAN] < warmest - 5.0


def test_setting_inputs_warms_nothing():
    washer = DirectInstance(SPEC, parameters=IN_TIME)
    washer.initialize(0.0, POINT)
    washer.step(0.0, 0.1)
    before = washer.outputs()
    washer.set_inputs([900.0, 545.0, 0.002, 297.15, 0.0])
    after = washer.outputs()
    assert abs(after[MEAN] - before[MEAN]) < 0.02
    assert after[TORQUE] > 1.05 * before[TORQUE]  # the film follows at once


def test_a_map_has_no_bodies_and_refuses_by_name():
    wrong = {"thermal_mode": "transient", "fidelity": "map"}
    for make in (
        lambda: DirectInstance(SPEC, parameters=wrong),
        lambda: Instance(washer(2), parameters=wrong),
    ):
        with pytest.raises((ParameterError, SolveError), match="thermal_mode = transient, allowed"):
            make().initialize(0.0, POINT)
